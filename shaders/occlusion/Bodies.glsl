// Light beneath the bodies around: twin of engine/occlusion/Ellipsoid.h and Shade.h, which say why. World frame. Needs no
// more than OpenGL 3.3: no atomics, no buffers that a shader writes.
layout(std140) uniform OccluderBlock {
    // Each: three rows that take a point of the world to the ellipsoid's axes; semi-axes, strength; albedo.
    vec4 occluders[5 * MAX_OCCLUDERS];
};
uniform int occluderCount, ownCount; // the first of them are the surface's own body's, which its folds complete
uniform vec3 foldAlbedo;             // of the surface's own body
uniform vec3 smoothAround[9]; // factors of 1, x, y, z, xy, yz, xz, y^2 - 1/3, x^2 - z^2
uniform vec3 lampTowards, lampRadiance;
uniform float lampShare;

struct Shaded {
    vec3 taken;     // out of the diffuse radiance
    float openLobe; // what is left of the glossy lobe
    vec3 seenInLobe; // what it sees of the bodies instead
};

float clippedShare(float share, float cosine) {
    float s = sqrt(share), k = sqrt(1.0 - share);
    float t = clamp(cosine / max(s, 1e-6), -1.0, 1.0);
    float sunk = 0.5 + k * (-0.60262 + k * (0.49891 - k * 0.18620));
    return cosine >= s ? share * cosine : s * share * (t * 0.5 + sunk + (0.5 - sunk) * t * t);
}

// m, d: point and direction in the ellipsoid's axes, divided by them.
float coverage(vec3 m, vec3 d, vec3 semiAxes, float lampSine, float capShare) {
    float along = -dot(m, d) / dot(d, d), ahead = max(along, 0.0);
    vec3 nearest = m + ahead * d;
    float aside = length(nearest * semiAxes) * (1.0 - 1.0 / max(length(nearest), 1e-3)) + (ahead - along);
    float sine = aside * inversesqrt(aside * aside + ahead * ahead + 1e-12);
    float x = clamp(0.5 - 0.5 * sine / lampSine, 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x) * min(1.0, capShare / (lampSine * lampSine));
}

// What is taken, by the powers of its direction.
struct Moments {
    float sum;
    vec3 first, second;
    vec2 third;
};

// Of a share in this mean direction, what is not taken yet.
float leftOf(Moments taken, float share, vec3 mean, vec3 normal) {
    vec3 middle = (2.0 / 3.0) * normal;
    float density = taken.sum + 4.0 * dot(taken.first - taken.sum * middle, mean - middle);
    return min(share * (1.0 - clamp(density, 0.0, 1.0)), 1.0 - taken.sum);
}

void addSecond(float share, vec3 mean, inout Moments taken) {
    float mean2 = max(dot(mean, mean), 1e-6), meanLength = sqrt(mean2);
    float f = share * max(2.0 * meanLength - 1.0, 0.0) * meanLength;
    vec3 q = f / mean2 * mean;
    taken.second += q.xyx * mean.yzz;
    taken.third += vec2(q.y * mean.y - f / 3.0, q.x * mean.x - q.z * mean.z);
}

// The light around on the side of a white body that is seen in this direction.
vec3 lightOnBody(vec3 towards) {
    vec3 back = (-2.0 / 3.0) * towards;
    return max(smoothAround[0] + smoothAround[1] * back.x + smoothAround[2] * back.y + smoothAround[3] * back.z, 0.0) +
           lampShare * max(-dot(towards, lampTowards), 0.0) * lampRadiance;
}

// Of a lamp, by a cap of this mean direction, as dense as its share of the hemisphere says.
float foldCoverage(float share, vec3 mean, vec3 normal, vec3 lamp, float lampSine) {
    float meanLength = max(length(mean), 1e-6), edge = max(2.0 * meanLength - 1.0, 0.0), soft = 0.2 + lampSine;
    vec3 towards = mean / meanLength;
    float density = min(1.0, share / max(clippedShare(1.0 - edge * edge, dot(towards, normal)), 1e-3));
    return density * smoothstep(edge - soft, edge + soft, dot(towards, lamp));
}

// Of a point, while one body after another takes its light.
struct SoFar {
    Moments taken;
    vec3 bounced, seen; // what they send: to the surface, into the lobe
    float lampOpen, lobeOpen, lobeSum;
};

void takeByFold(vec4 fold, vec3 normal, vec3 reflected, float lampSine, float lobeSine, inout SoFar so) {
    float share = max(fold.w, 0.0);
    vec3 mean = fold.xyz / max(max(share, length(fold.xyz)), 1e-6);
    float before = so.taken.sum;
    so.taken.sum = clamp(before + fold.w, 0.0, 1.0);
    float kept = min(so.taken.sum / max(before, 1e-6), 1.0);
    so.taken.second *= kept;
    so.taken.third *= kept;
    so.lampOpen = 1.0 - kept * (1.0 - so.lampOpen);
    so.bounced *= kept;
    so.lobeOpen = 1.0 - kept * (1.0 - so.lobeOpen);
    so.lobeSum *= kept;
    so.seen *= kept;
    so.taken.first += fold.xyz;
    addSecond(share, mean, so.taken);
    so.lampOpen *= 1.0 - foldCoverage(share, mean, normal, lampTowards, lampSine);
    vec3 sent = foldAlbedo * lightOnBody(mean / max(length(mean), 1e-6));
    so.bounced += share * sent;
    float hidden = foldCoverage(share, mean, normal, reflected, lobeSine);
    so.lobeOpen *= 1.0 - hidden;
    so.lobeSum += hidden;
    so.seen += hidden * sent;
}

void takeByOccluders(int first, int end, vec3 p, vec3 normal, vec3 reflected, float lampSine, float lobeSine, inout SoFar so) {
    for (int i = first; i < end; ++i) {
        vec4 rx = occluders[5 * i], ry = occluders[5 * i + 1], rz = occluders[5 * i + 2];
        vec4 shape = occluders[5 * i + 3];
        vec3 albedo = occluders[5 * i + 4].rgb;
        vec3 b = shape.xyz * shape.xyz;
        vec3 m = vec3(dot(rx.xyz, p) + rx.w, dot(ry.xyz, p) + ry.w, dot(rz.xyz, p) + rz.w);
        vec3 m2 = max(m * m, 1e-6 * b);
        float outside = dot(m2, 1.0 / b) - 1.0;
        float square = m2.x + m2.y + m2.z;
        float d = max(square - dot(m2, b) / square, 0.0);
        for (int k = 0; k < 3; ++k) {
            vec3 r = 1.0 / (b + d);
            float s = dot(m2, r);
            d = max(d + s * (s - 1.0) / dot(m2, r * r), 0.0);
        }
        vec3 c = 1.0 / (b + d), n = m * c, bc = b * c;
        float length2 = dot(m2, c * c);
        float capShare = outside > 1e-4 ? min(sqrt(outside * bc.x * bc.y * bc.z / max(d * length2, 1e-30)), 0.9999) : 0.9999;
        n *= -inversesqrt(max(dot(n, n), 1e-30));
        vec3 towards = n.x * rx.xyz + n.y * ry.xyz + n.z * rz.xyz;

        float cosine = dot(towards, normal);
        float k = sqrt(1.0 - capShare);
        float lift = (1.0 - k) * (2.0 + k) / (3.0 * (1.0 + k));
        vec3 mean = k * towards + lift / max(max(cosine, sqrt(capShare)), 1e-6) * normal;
        float share = leftOf(so.taken, clippedShare(capShare, cosine) * shape.w, mean, normal);
        so.taken.sum += share;
        so.taken.first += share * mean;
        addSecond(share, mean, so.taken);
        vec3 sent = albedo * lightOnBody(towards);
        so.bounced += share * sent;
        vec3 mUnit = m / shape.xyz;
        vec3 lamp = vec3(dot(rx.xyz, lampTowards), dot(ry.xyz, lampTowards), dot(rz.xyz, lampTowards)) / shape.xyz;
        so.lampOpen *= 1.0 - shape.w * coverage(mUnit, lamp, shape.xyz, lampSine, capShare);
        vec3 lobe = vec3(dot(rx.xyz, reflected), dot(ry.xyz, reflected), dot(rz.xyz, reflected)) / shape.xyz;
        float hidden = shape.w * coverage(mUnit, lobe, shape.xyz, lobeSine, capShare);
        so.lobeOpen *= 1.0 - hidden;
        so.lobeSum += hidden;
        so.seen += hidden * sent;
    }
}

// fold: what the occluders that are the body's own leave of occlusion::Folds::hidden, world.
Shaded shadeByBodies(vec3 p, vec3 normal, vec3 reflected, float roughness, vec4 fold) {
    float alpha = max(roughness * roughness, 0.02), lobeSine = 2.0 * alpha / (1.0 + alpha * alpha);
    float lampSine = sqrt(lampShare);
    SoFar so = SoFar(Moments(0.0, vec3(0.0), vec3(0.0), vec2(0.0)), vec3(0.0), vec3(0.0), 1.0, 1.0, 0.0);
    takeByOccluders(0, ownCount, p, normal, reflected, lampSine, lobeSine, so);
    // Outside of the loop: what is in it llvmpipe does each time round, whatever the condition.
    if (dot(fold, fold) > 0.0) takeByFold(fold, normal, reflected, lampSine, lobeSine, so);
    takeByOccluders(ownCount, occluderCount, p, normal, reflected, lampSine, lobeSine, so);
    vec3 lost = smoothAround[0] * so.taken.sum + smoothAround[1] * so.taken.first.x + smoothAround[2] * so.taken.first.y +
                smoothAround[3] * so.taken.first.z + smoothAround[4] * so.taken.second.x + smoothAround[5] * so.taken.second.y +
                smoothAround[6] * so.taken.second.z + smoothAround[7] * so.taken.third.x + smoothAround[8] * so.taken.third.y;
    float open = 1.0 - so.taken.sum;
    Shaded shaded;
    shaded.taken = lost - open * so.bounced +
                   lampRadiance * (clippedShare(lampShare, dot(normal, lampTowards)) * (1.0 - so.lampOpen));
    shaded.openLobe = so.lobeOpen;
    shaded.seenInLobe = so.seen * ((1.0 - so.lobeOpen) / max(so.lobeSum, 1e-6)) * open;
    return shaded;
}
