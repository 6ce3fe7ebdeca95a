// One colour over the whole picture. Pairs with engine/render/FadePass.
#include "render/Attributes.glsl"

layout(location = ATTRIBUTE_POSITION) in vec2 place;

void main() { gl_Position = vec4(place, 0, 1); }
