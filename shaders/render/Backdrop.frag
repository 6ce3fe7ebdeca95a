// The surround itself. The level is explicit: one texel size over the whole view, so no wrong mip along the seam.
#include "light/LatLong.glsl"
#include "render/Output.glsl"

uniform sampler2D frame;
uniform bool frameIsCoded; // the video's own display values; else linear radiance
uniform float lod;
in vec3 ray;
out vec4 colour;

void main() {
    vec3 texel = textureLod(frame, latLongFromDirection(normalize(ray)), lod).rgb;
    // At exposure 0 the curve and its inverse cancel: the video's own values, untouched.
    if (frameIsCoded && toneCurve == 0 && exposureScale == 1.0) colour = vec4(texel, 1.0);
    else colour = vec4(displayValue(frameIsCoded ? radianceFromDisplay(texel) : texel), 1.0);
}
