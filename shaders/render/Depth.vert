// Pairs with engine/render/DepthPass.
#include "render/WholePicture.glsl"
