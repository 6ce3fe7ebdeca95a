// Diffuse and glossy light that ellipsoids block at a surface point, and the light that they reflect back. Twin of
// content/make/models/occlusion/Silhouettes.h, which has the derivation. All in the light's frame. OpenGL 3.3.
#define AXIS_ROWS 6
layout(std140) uniform OccluderBlock {
    // For each occluder: centre, strength; the diagonal of Q, where x Q x = 1 on the ellipsoid, and the product of its semi-axes;
    // yz, zx, xy of Q; albedo.
    vec4 occluders[4 * MAX_OCCLUDERS];
};
uniform int occluderCount, ownCount; // the first ownCount belong to the surface's own body and complete its self-occlusion
uniform vec3 selfOcclusionAlbedo;             // of the surface's own body
uniform vec3 radianceAhead[4 * AXIS_ROWS], radianceBehind[4 * AXIS_ROWS]; // along the axes, and in the opposite directions
uniform vec3 evenLight[4];                                                // factors of 1, x, y, z
uniform mat4x3 dominantTowards;
uniform vec3 dominantRadiance;
uniform float dominantShare;

const float kEndShare = 1.0 / float(8 * AXIS_ROWS); // axis end's share of the sphere; next: its cap's sine
const float kCellSine = 2.0 * sqrt(kEndShare * (1.0 - kEndShare));

struct Shaded {
    vec3 taken;           // diffuse radiance lost, less what the ellipsoids reflect
    float lobeVisibility; // share of the glossy lobe that is free, 0 to 1
    vec3 seenInLobe;      // radiance of the ellipsoids in the rest of the lobe
};

// Shares of a point's light that the ellipsoids so far leave free: of the axis ends above its surface, of the
// dominant light and of the lobe.
struct OpenShares {
    vec4 side[AXIS_ROWS]; // signs of these ends
    vec4 open[AXIS_ROWS];
    vec4 dominantOpen;
    float lobeOpen;
    vec4 albedo; // sum over the ellipsoids, weighted by the share that they cover; w: sum of the weights
};

// Returns the dot products with a row's four axes.
vec4 along(vec3 v, vec3 axis) {
    vec3 p = v * axis;
    float same = p.x + p.y, turned = p.x - p.y;
    return vec4(same + p.z, same - p.z, turned + p.z, turned - p.z);
}

// Returns axis . matrix . axis of a symmetric matrix for a row's four axes.
vec4 squares(vec3 diagonal, vec3 mixed, vec3 axis) {
    vec3 m = mixed * (2.0 * axis.yzx * axis.zxy);
    float d = dot(diagonal, axis * axis), same = d + m.z, turned = d - m.z, plus = m.x + m.y, minus = m.y - m.x;
    return vec4(same + plus, same - plus, turned + minus, turned - minus);
}

void blockByOccluders(int first, int end, vec3 p, vec3 reflected, float lobeSine, inout OpenShares so) {
    float dominantSine = 0.5 * sqrt(dominantShare);
    for (int i = first; i < end; ++i) {
        vec4 place = occluders[4 * i], solid = occluders[4 * i + 1];
        vec3 diagonal = solid.xyz, mixed = occluders[4 * i + 2].xyz;
        vec3 m = p - place.xyz;
        vec3 slope = diagonal * m + mixed.zxy * m.yzx + mixed.yzx * m.zxy;
        float square = max(dot(m, slope), 1e-6), far2 = max(dot(m, m), 1e-12), outside = max(square, 1.0);
        float disc2 = solid.w * sqrt(square / far2), part = 1.0 / outside, near2 = part * part;
        float width = sqrt(part / max(dot(slope, slope), 1e-12) + (1.0 - part) * disc2);
        float cap = 0.5 - 0.5 * sqrt(1.0 - min(max(disc2 / far2, near2 * near2), 1.0));
        slope *= 0.5 * width;
        float edge = 0.5 * width * sqrt(outside - 1.0);

        vec3 s = slope / kCellSine;
        float e = edge / kCellSine, minimum = 1.0 - place.w * min(cap / kEndShare, 1.0);
#define AXES(k, a, b, c)                                                                                        \
    so.open[k] *= clamp(so.side[k] * along(s, vec3(a, b, c)) +                                                  \
                            (e * sqrt(squares(diagonal, mixed, vec3(a, b, c))) + 0.5),                          \
                        minimum, 1.0);
#include "occlusion/Axes.glsl"
#undef AXES
        float dominantMin = 1.0 - place.w * min(16.0 * cap / dominantShare, 1.0);
        for (int k = 0; k < 4; ++k) {
            vec3 d = dominantTowards[k];
            float extent = sqrt(dot(diagonal, d * d) + 2.0 * dot(mixed, d.yzx * d.zxy));
            so.dominantOpen[k] *= clamp((dot(slope, d) + edge * extent) / dominantSine + 0.5, dominantMin, 1.0);
        }
        vec3 d = reflected;
        float extent = sqrt(dot(diagonal, d * d) + 2.0 * dot(mixed, d.yzx * d.zxy));
        so.lobeOpen *= clamp((dot(slope, d) + edge * extent) / lobeSine + 0.5,
                             1.0 - place.w * min(4.0 * cap / (lobeSine * lobeSine), 1.0), 1.0);
        so.albedo += vec4(occluders[4 * i + 3].rgb, 1.0) * (cap * place.w);
    }
}

// selfOcclusion: the body itself hides a share of w plus the dot product with xyz in each direction.
Shaded occludeByEllipsoids(vec3 p, vec3 normal, vec3 reflected, float roughness, vec4 selfOcclusion) {
    float alpha = max(roughness * roughness, 0.02), lobeSine = 2.0 * alpha / (1.0 + alpha * alpha);
    OpenShares so;
    so.dominantOpen = vec4(1.0);
    so.lobeOpen = 1.0;
    so.albedo = vec4(selfOcclusionAlbedo, 1.0) * 1e-4;
#define AXES(k, a, b, c)                                                                                        \
    so.open[k] = vec4(1.0);                                                                                     \
    so.side[k] = sign(along(normal, vec3(a, b, c)));
#include "occlusion/Axes.glsl"
#undef AXES
    blockByOccluders(0, ownCount, p, reflected, lobeSine, so);
#define AXES(k, a, b, c)                                                                                        \
    so.open[k] = clamp(so.open[k] - selfOcclusion.w - so.side[k] * along(selfOcclusion.xyz, vec3(a, b, c)), 0.0, 1.0);
#include "occlusion/Axes.glsl"
#undef AXES
    so.dominantOpen = clamp(so.dominantOpen - selfOcclusion.w - selfOcclusion.xyz * dominantTowards, 0.0, 1.0);
    so.lobeOpen = clamp(so.lobeOpen - selfOcclusion.w - dot(selfOcclusion.xyz, reflected), 0.0, 1.0);
    blockByOccluders(ownCount, occluderCount, p, reflected, lobeSine, so);

    vec3 lost = vec3(0.0), first = vec3(0.0);
    float share = 0.0;
#define LOST(k, j) lost += hidden[j] * (so.side[k][j] > 0.0 ? radianceAhead[4 * k + j] : radianceBehind[4 * k + j]);
#define AXES(k, a, b, c)                                                                                        \
    {                                                                                                           \
        vec4 cosines = along(normal, vec3(a, b, c)) * (4.0 * kEndShare);                                        \
        vec4 towards = cosines * (1.0 - so.open[k]), hidden = abs(towards);                                     \
        share += hidden[0] + hidden[1] + hidden[2] + hidden[3];                                                 \
        vec2 same = towards.xz + towards.yw, turned = towards.xz - towards.yw;                                  \
        first += vec3(same.x + same.y, same.x - same.y, turned.x + turned.y) * vec3(a, b, c);                   \
        LOST(k, 0) LOST(k, 1) LOST(k, 2) LOST(k, 3)                                                             \
    }
#include "occlusion/Axes.glsl"
#undef AXES
    share = min(share, 1.0);
    const float back = -2.0 / 3.0;
    first *= back;
    vec3 r = back * reflected;
    vec3 sent = evenLight[0] * share + evenLight[1] * first.x + evenLight[2] * first.y + evenLight[3] * first.z;
    vec3 inLobe = evenLight[0] + evenLight[1] * r.x + evenLight[2] * r.y + evenLight[3] * r.z;
    vec3 albedo = so.albedo.rgb / so.albedo.w * (1.0 - share); // the surface hides that share of their light
    Shaded shaded;
    shaded.taken = lost - albedo * max(sent, 0.0) +
                   dominantRadiance * (0.25 * dominantShare * dot(max(normal * dominantTowards, 0.0), 1.0 - so.dominantOpen));
    shaded.lobeVisibility = so.lobeOpen;
    shaded.seenInLobe = (1.0 - so.lobeOpen) * albedo * max(inLobe, 0.0);
    return shaded;
}
