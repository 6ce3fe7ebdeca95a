// Pairs with engine/render/PremultiplyPass.
#include "render/WholePicture.glsl"
