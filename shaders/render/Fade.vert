// Pairs with engine/render/FadePass.
#include "render/WholePicture.glsl"
