#include "occlusion/Screen.glsl"

void main() { coverScreen(); }
