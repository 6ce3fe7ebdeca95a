// A body seen from all sides at once: view k is an instance, drawn in its own square of a wide picture.
#include "occlusion/ThesisViews.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

uniform int columns; // squares side by side
uniform vec2 pictureSize;

noperspective out float depth; // pixels
noperspective out vec3 normalBody;
flat out int view;

void main() {
    vec3 pixel = pixelFromBody(viewFromBody(cubeDirection(gl_InstanceID)), position);
    vec2 place = pixel.xy + vec2(gl_InstanceID % columns, gl_InstanceID / columns) * float(resolution);
    gl_Position = vec4(place / pictureSize * 2.0 - 1.0, 0.0, 1.0);
    depth = pixel.z;
    normalBody = normal;
    view = gl_InstanceID;
}
