// Draws the cells of the picture in which a layer shows something.
#include "render/Attributes.glsl"

layout(location = ATTRIBUTE_POSITION) in vec2 place; // on the picture, -1 to 1
noperspective out vec2 layerUv;

void main() {
    layerUv = 0.5 * place + 0.5;
    gl_Position = vec4(place, 0.0, 1.0);
}
