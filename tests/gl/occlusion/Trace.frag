// One ray per pixel: where it meets the body. THESIS: by the thesis' layers, else by the cured ones.
#ifdef THESIS
#include "occlusion/ThesisTrace.glsl"
#else
#include "occlusion/Ollfb.glsl"
#endif

struct Ray {
    vec4 origin; // w: nearest
    vec4 direction;
};
layout(std430, binding = OCCLUSION_RAYS) readonly buffer Rays { Ray rays[]; };
uniform int width, rayCount;
out vec4 hit;

void main() {
    int ray = int(gl_FragCoord.y) * width + int(gl_FragCoord.x);
    hit = ray < rayCount ? traceLayers(rays[ray].origin.xyz, rays[ray].direction.xyz, rays[ray].origin.w) : vec4(-1, 0, 0, 0);
}
