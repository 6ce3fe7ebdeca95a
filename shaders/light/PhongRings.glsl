// The thesis' glossy lookup (its section 4.1): 36 samples of the radiance pyramid around the mirror direction, three rings
// of six inside the cone where the Phong lobe falls to half its peak and three outside, each ring from the level whose
// texels match the distance between its samples. Twin of engine/light/Lookup.h. Needs light/Environment.glsl.
uniform sampler2D radianceMap; // the radiance pyramid, level 0 its widest
uniform float radianceWidth;   // texels around level 0
uniform vec2 phongRings_angleWeight[6]; // for the material's exponent: a ring's angle, radians, and its weight; weights sum to 1

vec3 phongRings(vec3 mirror, float roughness) {
    vec3 side = normalize(abs(mirror.y) < 0.9 ? cross(mirror, vec3(0.0, 1.0, 0.0)) : cross(mirror, vec3(1.0, 0.0, 0.0)));
    vec3 up = cross(side, mirror);
    vec3 sum = vec3(0.0);
    for (int ring = 0; ring < 6; ++ring) {
        float angle = phongRings_angleWeight[ring].x;
        float spacing = max(2.0 * kPi * sin(angle) / 6.0, 1e-4);
        float lod = max(0.0, log2(spacing * radianceWidth / (2.0 * kPi)));
        vec3 ringSum = vec3(0.0);
        for (int i = 0; i < 6; ++i) {
            float turn = (float(i) + 0.5 * float(ring & 1)) * (2.0 * kPi / 6.0);
            vec3 dir = mirror * cos(angle) + (side * cos(turn) + up * sin(turn)) * sin(angle);
            ringSum += textureLod(radianceMap, latLongFromDirection(dir), lod).rgb;
        }
        sum += ringSum * (phongRings_angleWeight[ring].y / 6.0);
    }
    return lightScale * sum;
}
