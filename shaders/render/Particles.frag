in vec3 speck;
in float speckCover;
out vec4 colour;

void main() {
    vec2 at = 2.0 * gl_PointCoord - 1.0;
    float inside = max(1.0 - dot(at, at), 0.0);
    float cover = speckCover * inside;
    colour = vec4(speck * cover, cover);
}
