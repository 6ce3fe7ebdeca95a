// COUNT: one more layer in this pixel. Otherwise: the layer goes to the pixel's next place.
#include "occlusion/ThesisViews.glsl"
#include "occlusion/Octahedral.glsl"

noperspective in float depth;
noperspective in vec3 normalBody;
flat in int view;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy) % resolution;
    int pixel = (view * resolution + place.y) * resolution + place.x;
#ifdef COUNT
    atomicAdd(starts[pixel], 1u);
#else
    // The pixel's start counts up as its layers come; it is set back afterwards.
    uint layer = atomicAdd(starts[pixel], 1u);
    float size = length(normalBody);
    layers[layer].depth = depth;
    layers[layer].normal = packDirection(size > 0.0 ? normalBody / size : vec3(0, 0, 1), 16);
#endif
}
