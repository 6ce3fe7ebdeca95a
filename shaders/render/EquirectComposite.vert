// Draws tiles of the lat-long frame's texels, so small that rays are nearly linear within; the frame's first row is the
// framebuffer's first.
#include "render/Attributes.glsl"
#include "light/LatLong.glsl"

layout(location = ATTRIBUTE_POSITION) in vec2 uv;
uniform mat3 eyeFromEnv;
noperspective out vec3 eyeRay;
uniform sampler2D scattered; // light around each place; changes more slowly than tiles do
noperspective out vec3 scatteredLight;

void main() {
    float longitude = (uv.x - 0.5) * 2.0 * kPi, latitude = (0.5 - uv.y) * kPi;
    eyeRay = eyeFromEnv * vec3(cos(latitude) * sin(longitude), sin(latitude), -cos(latitude) * cos(longitude));
#ifdef FILMED
    scatteredLight = textureLod(scattered, uv, 0.0).rgb;
#endif
    gl_Position = vec4(2.0 * uv - 1.0, 0.0, 1.0);
}
