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

// Solves y = 10 L^11 + 1.8 L for L: from the lesser of what either term alone would give, pulled down where both count, one
// step of Halley's. At most 0.04 / 255 off.
vec3 displayFromRadiance(vec3 radiance) {
    float y = max(thesisLuminance(radiance), 1e-6);
    float logY = log2(y);
    float logLinear = logY - 0.847997;                // log2 1.8
    float logPower = (logY - 3.321928) * (1.0 / 11.0); // log2 10
    float l = exp2(min(logLinear, logPower)) * (1.0 - 0.14 * exp2(-2.0 * abs(logLinear - logPower)));
    float l2 = l * l;
    float l4 = l2 * l2;
    float l9 = l4 * l4 * l;
    float value = (10.0 * l9 * l + 1.8) * l - y;
    float slope = 110.0 * l9 * l + 1.8;
    l -= 2.0 * value * slope / (2.0 * slope * slope - value * 1100.0 * l9);
    return radiance * (l / y);
}
