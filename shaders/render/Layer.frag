// Scales up a picture of objects; display values, premultiplied by how much of the texel they cover.
uniform sampler2D layer;
noperspective in vec2 layerUv;
out vec4 colour;

void main() { colour = textureLod(layer, layerUv, 0.0); }
