// Pairs with engine/render/HeadsetPasses.
#include "render/WholePicture.glsl"
