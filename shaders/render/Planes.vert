// Pairs with PlanesPass in engine/render/EnvironmentGpu.
#include "render/WholePicture.glsl"
