// From display to light and back: the thesis' inverse tone mapping, eq. 4.1 to 4.3, and its exact inverse.
// Twin of engine/light/InverseToneMap.h.
float thesisLuminance(vec3 c) { return dot(c, vec3(0.30, 0.59, 0.11)); }

// colour: the video's coded values as they come, 0 to 1.
vec3 radianceFromDisplay(vec3 colour) {
    float l = thesisLuminance(colour);
    float l2 = l * l;
    float l4 = l2 * l2;
    return (10.0 * l4 * l4 * l2 + 1.8) * colour;
}

// Solves y = 10 L^11 + 1.8 L for L. The function is convex and rising and the start lies at or above the root, so Newton
// falls onto it from above; after four steps it is at most 0.002 / 255 off.
vec3 displayFromRadiance(vec3 radiance) {
    float y = thesisLuminance(radiance);
    if (y <= 1e-6) return radiance / 1.8;
    float l = min(y / 1.8, pow(y * 0.1, 1.0 / 11.0));
    for (int i = 0; i < 4; ++i) {
        float l2 = l * l;
        float l4 = l2 * l2;
        float l10 = l4 * l4 * l2;
        l -= (10.0 * l10 * l + 1.8 * l - y) / (110.0 * l10 + 1.8);
    }
    return radiance * (l / y);
}
