// Computes the light that a body's own surface blocks and reflects, by rays through its layered fragment buffers. LAYERS_THESIS:
// the thesis' method, one bounce of mirrored light; else engine/occlusion/Ollfb.h. Needs GLSL 4.30, envFromWorld,
// light/Environment.glsl and light/Surface.glsl.
#ifdef LAYERS_THESIS
#include "occlusion/ThesisTrace.glsl"
const int kBounces = 1;
#else
#include "occlusion/Ollfb.glsl"
const int kBounces = 4;
#endif
uniform float layersNearest; // metres; hits nearer to a ray's origin are ignored
uniform vec3 bodyAlbedo;     // mean base colour of the body, used wherever a ray hits it

const int kDiffuseRays = 32, kGlossyRays = 8;
const float kSharp = 0.1;            // roughness below which one ray stands for the lobe
const float kDirectionalRough = 0.5; // its lobe is about as wide as a diffuse ray's share of the hemisphere

// Returns the angle by which a pixel turns the ray directions, so that few rays leave noise and no contours. Jimenez 2014, "Next
// Generation Post Processing in Call of Duty: Advanced Warfare".
float turnOfPixel() {
    return 2.0 * kPi * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
}

// Returns the direction of a point of Vogel's spiral and its squared radius (i + 1/2) / count; its angle is i golden angles.
vec2 spiral(int i, int count, float turn, out float square) {
    square = (float(i) + 0.5) / float(count);
    float angle = turn + 2.39996323 * float(i);
    return vec2(cos(angle), sin(angle));
}

// Follows a ray from its origin on the body until it leaves the body, for at most kBounces bounces. Returns the radiance from the
// body, and in w 1 if the ray meets the body; else all 0.
vec4 reflectedByBody(vec3 origin, vec3 direction, float metal, float rough) {
    vec4 met = vec4(0.0);
    vec3 throughput = vec3(1.0);
    for (int bounce = 0; bounce < kBounces; ++bounce) {
        vec4 hit = traceLayers(origin, direction, layersNearest);
        if (hit.x < 0.0) break;
        met.w = 1.0;
        vec3 normal = hit.yzw;
        Reflectance at = reflectanceOf(bodyAlbedo, metal, rough, clamp(-dot(normal, direction), 1e-3, 1.0));
        met.rgb += throughput * at.around * diffuseRadiance(envFromWorld * normal);
        throughput *= at.mirrored;
        origin += hit.x * direction;
        direction = reflect(direction, normal);
    }
    if (met.w > 0.0) met.rgb += throughput * glossyRadiance(envFromWorld * direction, rough);
    return met;
}

// place, normal: world frame; geometric: without the normal map. around: the unoccluded diffuse radiance.
vec3 diffuseWithLayers(vec3 place, vec3 normal, vec3 geometric, vec3 around) {
    mat3 frame = frameAround(normal);
    float turn = turnOfPixel(), square;
    vec3 all = vec3(1e-6), open = vec3(1e-6), reflected = vec3(0.0);
    for (int i = 0; i < kDiffuseRays; ++i) {
        vec2 across = spiral(i, kDiffuseRays, turn, square);
        vec3 direction = frame * vec3(sqrt(square) * across, sqrt(1.0 - square));
        vec3 arrives = glossyRadiance(envFromWorld * direction, kDirectionalRough);
        all += arrives;
        vec4 hit = dot(direction, geometric) > 0.0 ? traceLayers(place, direction, layersNearest) : vec4(-1.0);
        if (hit.x < 0.0)
            open += arrives;
        else
            reflected += bodyAlbedo * diffuseRadiance(envFromWorld * hit.yzw);
    }
    return around * open / all + reflected / float(kDiffuseRays);
}

// mirror: world frame. mirrored: the unoccluded glossy radiance.
vec3 glossyWithLayers(vec3 place, vec3 mirror, vec3 geometric, vec3 mirrored, float metal, float rough) {
    int count = rough < kSharp ? 1 : kGlossyRays;
    mat3 frame = frameAround(mirror);
    float alpha = rough * rough, turn = turnOfPixel(), square;
    vec4 met = vec4(0.0); // sums over the rays
    for (int i = 0; i < count; ++i) {
        // Half vectors distributed by GGX: Karis 2013, "Real Shading in Unreal Engine 4".
        vec2 across = spiral(i, count, turn, square);
        float cosine = count == 1 ? 1.0 : sqrt((1.0 - square) / (1.0 + (alpha * alpha - 1.0) * square));
        vec3 half_ = vec3(sqrt(1.0 - cosine * cosine) * across, cosine);
        vec3 direction = frame * (2.0 * half_.z * half_ - vec3(0.0, 0.0, 1.0));
        if (dot(direction, geometric) > 0.0) met += reflectedByBody(place, direction, metal, rough);
    }
    return (mirrored * (float(count) - met.w) + met.rgb) / float(count);
}
