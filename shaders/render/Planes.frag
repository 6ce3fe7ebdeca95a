// Converts a film's codes to the colours that are shown. Twin of convertRow() in engine/media/FrameConverter.cpp. Pairs with
// PlanesPass in engine/render/EnvironmentGpu.
#include "light/ToneCurve.glsl"

uniform highp usampler2D luma, blueDifference, redDifference;
uniform ivec2 first, chromaShift;
uniform mat4x3 rgbFromCodes, toRec709;
uniform sampler2D lightByCode; // in rows of 128
uniform bool isCoded, isHlg;
out vec4 colour;

float lightOf(float code) {
    int i = int(clamp(code, 0.0, 1.0) * 16383.0 + 0.5);
    return texelFetch(lightByCode, ivec2(i & 127, i >> 7), 0).r;
}

void main() {
    ivec2 at = first + ivec2(gl_FragCoord.xy), chromaAt = at >> chromaShift;
    vec3 codes = vec3(texelFetch(luma, at, 0).r, texelFetch(blueDifference, chromaAt, 0).r,
                      texelFetch(redDifference, chromaAt, 0).r);
    colour = vec4(rgbFromCodes * vec4(codes, 1.0), 1.0);
    if (isCoded) return;
    vec3 light = vec3(lightOf(colour.r), lightOf(colour.g), lightOf(colour.b));
    if (isHlg) light *= 1000.0 / 203.0 * pow(dot(light, vec3(0.2627, 0.6780, 0.0593)), 0.2); // BT.2100
    light = max(toRec709 * vec4(light, 0.0), 0.0);
    colour.rgb = srgbFromLinear(light / max(max(light.r, light.g), max(light.b, 1.0)));
}
