// Draws cells of the environment at the far plane (engine/render/BackgroundCells.h). POLAR, near a pole: computes the map's
// coordinates for each pixel.
#include "render/Attributes.glsl"

layout(location = ATTRIBUTE_POSITION) in vec2 place; // on the picture, -1 to 1
layout(location = ATTRIBUTE_UV0) in vec2 uv;
layout(location = ATTRIBUTE_NORMAL) in vec3 directionEnv; // direction in which the film shows the corner
noperspective out vec2 mapUv;
noperspective out vec3 direction;

void main() {
    mapUv = uv;
    direction = directionEnv;
    gl_Position = vec4(place, 1.0, 1.0);
}
