// A model's stored self-occlusion and ellipsoids.
#include "engine/render/BakedOcclusion.h"
#include "tests/fuzz/Target.h"

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    (void)render::parseBakedOcclusion({reinterpret_cast<const char*>(data), size});
    return 0;
}
