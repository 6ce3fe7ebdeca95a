in vec3 factor;
out vec4 colour;

void main() { colour = vec4(factor, 1.0); }
