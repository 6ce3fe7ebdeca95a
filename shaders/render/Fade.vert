// Flat shapes on the image plane at distance 1. Pairs with engine/render/FadePass.
#include "render/Attributes.glsl"

layout(location = ATTRIBUTE_POSITION) in vec2 place;

uniform vec2 halfExtent, shift; // of the image plane, see render::View

void main() { gl_Position = vec4((place - shift) / halfExtent, 0, 1); }
