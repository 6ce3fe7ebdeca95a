// Shadows on the filmed ground: what is there already times what they leave of it.
#include "render/Attributes.glsl"

layout(location = ATTRIBUTE_POSITION) in vec3 place; // world frame
layout(location = ATTRIBUTE_COLOUR) in vec3 left;
uniform mat4 clipFromWorld;
out vec3 factor;

void main() {
    factor = left;
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
