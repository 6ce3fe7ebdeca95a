// Rectangles of the lat-long frame's texels; the frame's first row is the framebuffer's first.
#include "render/Attributes.glsl"

layout(location = ATTRIBUTE_POSITION) in vec2 uv;
noperspective out vec2 mapUv;

void main() {
    mapUv = uv;
    gl_Position = vec4(2.0 * uv - 1.0, 0.0, 1.0);
}
