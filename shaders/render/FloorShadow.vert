// Shadows on the floor of the player's room. Pairs with engine/render/FloorShadowPass.
#include "render/Attributes.glsl"

layout(location = ATTRIBUTE_POSITION) in vec3 place; // world frame
layout(location = ATTRIBUTE_COLOUR) in float shareTaken;
uniform mat4 clipFromWorld;
out float taken;

void main() {
    taken = shareTaken;
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
