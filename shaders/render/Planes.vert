#include "render/WholePicture.glsl"
