// Draws the environment. Level 0 is sampled explicitly: a computed mip level would be wrong along the seam.
// AS_IS: shows the video's coded values unchanged, if the curve undoes their decoding and the exposure is 0.
#include "light/LatLong.glsl"
#include "render/Output.glsl"

uniform sampler2D frame;
uniform sampler2D shadowsLeft; // SHADED: factor for the frame's coded values
noperspective in vec2 mapUv;
noperspective in vec3 direction;
out vec4 colour;

void main() {
#ifdef POLAR
    vec2 uv = latLongFromDirection(normalize(direction));
#else
    vec2 uv = mapUv;
#endif
    vec3 texel = textureLod(frame, uv, 0.0).rgb;
#ifdef SHADED
    texel *= textureLod(shadowsLeft, uv, 0.0).rgb;
#endif
#ifdef AS_IS
    colour = vec4(texel, 1.0);
#else
#ifdef FRAME_IS_CODED
    texel = radianceOfFrame(texel);
#endif
    colour = vec4(displayValue(texel), 1.0);
#endif
}
