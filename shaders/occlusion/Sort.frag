// Each pixel of each view puts its layers in order of depth.
#include "occlusion/ThesisViews.glsl"

uniform int columns;
uniform int views;

void main() {
    ivec2 square = ivec2(gl_FragCoord.xy) / resolution, place = ivec2(gl_FragCoord.xy) % resolution;
    int view = square.y * columns + square.x;
    if (square.x >= columns || view >= views) return;
    int pixel = (view * resolution + place.y) * resolution + place.x;
    uint begin = starts[pixel], end = starts[pixel + 1];
    for (uint i = begin + 1u; i < end; ++i) {
        ThesisLayer moving = layers[i];
        uint to = i;
        for (; to > begin && layers[to - 1u].depth > moving.depth; --to) layers[to] = layers[to - 1u];
        layers[to] = moving;
    }
}
