// A model's file, to its first pose.
#include "tests/fuzz/Target.h"
#include "tests/robustness/gltf/Sound.h"

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const fuzz::FileInput binary("input.glb"), text("input.gltf");
    const bool isBinary = size > 4 && data[0] == 'g';
    const auto model = scene::loadModel((isBinary ? binary : text)({data, size}), "",
                                        {.maxTotalBytes = 16u << 20,
                                         .maxVertices = 100'000,
                                         .maxIndices = 300'000,
                                         .maxImagePixels = 1'000'000,
                                         .maxKeyValues = 400'000});
    if (!model) return 0;
    ++fuzz::taken;
    fuzz::expect(scene::isSound(*model));
    return 0;
}
