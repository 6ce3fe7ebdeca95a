#version 330 core
#include "light/LatLong.glsl"
uniform sampler2D frame;
in vec3 position; // on a cube around the eye
out vec4 colour;
void main() { colour = textureLod(frame, latLongFromDirection(normalize(position)), 0.0); }
