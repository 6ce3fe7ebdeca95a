in float taken;
out vec4 colour; // premultiplied

void main() { colour = vec4(0.0, 0.0, 0.0, taken); }
