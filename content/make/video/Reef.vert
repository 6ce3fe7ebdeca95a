out vec2 uv; // of the lat-long picture, v = 0 at the top

void main() {
    vec2 corner = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
    uv = vec2(corner.x, corner.y); // the first row drawn is the picture's top row, as the encoder wants it
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
