// Loader of .glb and .gltf files. Calling thread; files are untrusted.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"
#include "engine/scene/Model.h"

namespace shoal::scene {

struct LoadLimits {
    uint64_t maxFileBytes = 256u << 20;   // each file read, buffers and images included
    uint64_t maxTotalBytes = 1u << 30;    // all of them together
    uint64_t maxVertices = 4'000'000;     // in all, with those of morph targets and those split for normals
    uint64_t maxIndices = 12'000'000;     // in all
    uint64_t maxImagePixels = 64'000'000; // in all
    uint64_t maxKeyValues = 16'000'000;   // numbers in all animations' keys
    uint32_t maxNodes = 65'536;           // also the limit of other lists, but four times that for accessors
    uint32_t maxJoints = 256;             // in each skin
};

// Loads a model; reads only files at or below its own folder. The result is valid: indices and joints are in
// range, positions finite, nodes without cycles. Generates flat normals and tangents (per glTF, MikkTSpace's
// convention) if they are missing. Errors name the file and the glTF element that is wrong. Each warning
// (odd, but drawable) is logged once.
Result<Model> loadModel(const Path& file, const LoadLimits& limits = {});

} // namespace shoal::scene
