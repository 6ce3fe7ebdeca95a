in vec3 speck;
in float speckCover;
#ifdef LAYER
uniform sampler2D layer;     // objects, which hide specks by their alpha
uniform vec3 layerFromPixel; // its coordinates are the pixel's times xy, plus z
#endif
out vec4 colour;

void main() {
    vec2 at = 2.0 * gl_PointCoord - 1.0;
    float inside = max(1.0 - dot(at, at), 0.0);
    float cover = speckCover * inside;
#ifdef LAYER
    cover *= 1.0 - textureLod(layer, gl_FragCoord.xy * layerFromPixel.xy + layerFromPixel.z, 0.0).a;
#endif
    colour = vec4(speck * cover, cover);
}
