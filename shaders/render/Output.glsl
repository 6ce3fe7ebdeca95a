// The last step of every draw: linear radiance to display values, so that no pass over the whole picture is needed.
#include "light/ToneCurve.glsl"

// Each curve has its own program, since software renderers run all branches. TONE_ACES and TONE_LINEAR (which
// clips) code as sRGB, otherwise the curve inverts the thesis' inverse tone mapping. FRAME_SRGB: the
// video's values are decoded as sRGB, otherwise by the thesis' inverse tone mapping.
uniform float exposureScale; // 2^EV, on objects and background alike

vec3 radianceOfFrame(vec3 coded) {
#ifdef FRAME_SRGB
    return linearFromSrgb(coded);
#else
    return radianceFromDisplay(coded);
#endif
}

// Fit of the ACES reference rendering and output transforms by S. Hill (MIT), with the usual 1 / 0.6 exposure.
vec3 acesFilmic(vec3 lin) {
    const mat3 acesIn = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 acesOut = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    vec3 v = acesIn * (lin / 0.6);
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return acesOut * v;
}

vec3 displayOfExposed(vec3 exposed) { // exposed: radiance times exposureScale
#if defined(TONE_ACES)
    return srgbFromLinear(acesFilmic(exposed));
#elif defined(TONE_LINEAR)
    return srgbFromLinear(exposed);
#else
    return clamp(displayFromRadiance(exposed), 0.0, 1.0);
#endif
}

vec3 displayValue(vec3 radiance) { return displayOfExposed(radiance * exposureScale); }
