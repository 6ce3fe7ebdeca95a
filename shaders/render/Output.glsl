// The last step of every draw: linear radiance to display values, so that no pass over the whole picture is needed.
#include "light/ToneCurve.glsl"

uniform int toneCurve;        // 0 inverse of the video's inverse tone mapping, 1 ACES filmic, 2 clip; 1 and 2 with sRGB coding
uniform float exposureScale;  // 2^EV, on objects and backdrop alike

vec3 srgbFromLinear(vec3 lin) {
    lin = clamp(lin, 0.0, 1.0);
    return mix(12.92 * lin, 1.055 * pow(lin, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, lin));
}

// Fit of the ACES reference rendering and output transforms by S. Hill (MIT), with the usual 1 / 0.6 exposure.
vec3 acesFilmic(vec3 lin) {
    const mat3 acesIn = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 acesOut = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    vec3 v = acesIn * (lin / 0.6);
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return acesOut * v;
}

vec3 displayValue(vec3 radiance) {
    radiance *= exposureScale;
    if (toneCurve == 0) return clamp(displayFromRadiance(radiance), 0.0, 1.0);
    if (toneCurve == 1) return srgbFromLinear(acesFilmic(radiance));
    return srgbFromLinear(radiance);
}
