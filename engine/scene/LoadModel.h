// Loader of .glb and .gltf files. Calling thread; files are untrusted.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"
#include "engine/scene/Model.h"

namespace shoal::scene {

struct LoadLimits {
    uint64_t maxFileBytes = 256u << 20;   // each file read, buffers and images included
    uint64_t maxTotalBytes = 1u << 30;    // all of them together
    uint64_t maxVertices = 4'000'000;     // in all, each morph target's and those split for normals included
    uint64_t maxIndices = 12'000'000;     // in all
    uint64_t maxImagePixels = 64'000'000; // in all
    uint64_t maxKeyValues = 16'000'000;   // numbers in all animations' keys
    uint32_t maxNodes = 65'536;           // and of every other list in the file but accessors and their views
    uint32_t maxJoints = 256;             // a skin
};

// Reads only files at or below the model's own folder. Everything in the result is in range: indices, joints,
// finite positions, no node cycles. Generates flat normals and tangents (per glTF, MikkTSpace's convention)
// where absent. Errors name the file and the glTF element that is wrong. Warnings (odd, but drawable) are
// logged once each.
Result<Model> loadModel(const Path& file, const LoadLimits& limits = {});

} // namespace shoal::scene
