// Copies depth. Pairs with engine/render/DepthPass.
uniform sampler2D depth;
uniform float part; // of its width and height, about the middle
noperspective in vec2 uv;

void main() { gl_FragDepth = textureLod(depth, (uv - 0.5) * part + 0.5, 0.0).r; }
