// Draws one colour over the whole picture. Pairs with engine/render/HeadsetPasses.
uniform vec4 colour;

out vec4 fragment;

void main() { fragment = colour; }
