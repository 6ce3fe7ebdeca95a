// One triangle that covers the viewport, without attributes. Pairs with engine/render/TriangleBatch.h.
noperspective out vec2 uv;

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    uv = 2.0 * corner;
    gl_Position = vec4(4.0 * corner - 1.0, 0.0, 1.0);
}
