// The environment behind everything, at the far plane, in cells of a grid over the picture. Away from the poles the map's
// coordinates are as good as affine within a cell, so that no pixel needs trigonometry; cells near a pole are drawn by
// a second program (POLAR), which computes them for each pixel.
#include "render/Attributes.glsl"

layout(location = ATTRIBUTE_POSITION) in vec2 place; // on the picture, -1 to 1
layout(location = ATTRIBUTE_UV0) in vec2 uv;
uniform mat3 envFromRay; // rotates a ray (x, y, -1) of the image plane into the env frame
uniform vec2 rayScale;   // half the image plane's extent at distance 1
uniform vec2 rayShift;   // its centre, for eyes whose frustum is off axis
noperspective out vec2 mapUv;
noperspective out vec3 ray;

void main() {
    mapUv = uv;
    ray = envFromRay * vec3(place * rayScale + rayShift, -1.0);
    gl_Position = vec4(place, 1.0, 1.0);
}
