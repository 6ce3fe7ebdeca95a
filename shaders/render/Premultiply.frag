// Converts display values times coverage to coded light times coverage: a compositor that decodes them adds
// light, and would otherwise show dark outlines. Pairs with engine/render/HeadsetPasses.
#include "light/ToneCurve.glsl"

uniform sampler2D picture;
noperspective in vec2 uv;
out vec4 colour;

void main() {
    colour = textureLod(picture, uv, 0.0);
    if (colour.a > 0.0 && colour.a < 1.0) colour.rgb = srgbFromLinear(linearFromSrgb(colour.rgb / colour.a) * colour.a);
}
