// Converts display values to light and back.

// The sRGB transfer curve, IEC 61966-2-1:1999.
vec3 linearFromSrgb(vec3 coded) {
    return mix(coded / 12.92, pow((coded + 0.055) / 1.055, vec3(2.4)), step(0.04045, coded));
}

// Clips at black and white. A minimax fit of a fraction in the square root, which costs less than a power: within 0.18 / 255.
vec3 srgbFromLinear(vec3 lin) {
    vec3 s = sqrt(clamp(lin, 0.0, 1.0));
    return s * (0.0327055681 + s * (3.14826007 + s * 363.2628457)) /
           (1.0 + s * (-2.942794804 + s * (323.9342325 + s * 44.69971514)));
}

// The thesis' inverse tone mapping, eq. 4.1 to 4.3, and its exact inverse. Twin of engine/light/InverseToneMap.h.
float thesisLuminance(vec3 c) { return dot(c, vec3(0.30, 0.59, 0.11)); }

// colour: the video's coded values, 0 to 1.
vec3 radianceFromDisplay(vec3 colour) {
    float l = thesisLuminance(colour);
    float l2 = l * l;
    float l4 = l2 * l2;
    return (10.0 * l4 * l4 * l2 + 1.8) * colour;
}

// Returns L / y where y = 10 L^11 + 1.8 L: a fraction in y and in a root s. Next to the real axis the true solution has branch
// points where dy / dL = 0, at y = 1.03 +- 0.34 i; s has them too, so few terms serve. Minimax fit of the relative error: display
// values are at most 0.05 / 255 off up to white (y = 11.8), 0.25 / 255 up to y = 100, and rise with y without end.
float displayPerRadiance(float y) {
    float s = sqrt((y - 1.04316) * (y - 1.04316) + 0.1033758);
    return (0.6029734 - 0.4352197 * y + (0.4496425 + 7.709187e-5 * y) * s) /
           (1.0 - (0.7191263 + 7.722074e-4 * y) * y + (0.8873055 + (0.01338982 + 4.883849e-5 * y) * y) * s);
}

vec3 displayFromRadiance(vec3 radiance) { return radiance * displayPerRadiance(thesisLuminance(radiance)); }
