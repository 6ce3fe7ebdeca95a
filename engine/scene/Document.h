// A checked glTF file: what tinygltf read, with its buffers' bytes, and where its images' bytes are.
#pragma once

#include "engine/scene/TinyGltf.h"
#include "engine/scene/Variants.h"

#include <cstdint>
#include <string>
#include <vector>

namespace shoal::scene {

struct Loading;

struct ImageSource { // either
    std::string uri;
    int bufferView = -1;
    std::string mimeType;
};

struct Document {
    tinygltf::Model gltf; // images are empty: see imageSources
    std::vector<ImageSource> imageSources;
    bool quantized = false; // KHR_mesh_quantization is used
    Variants variants;
};

// Reads and checks the file: container, JSON, types, indices, extensions, buffers, and that every bufferView
// and accessor lies inside what it refers to. Throws Fault.
Document readDocument(Loading& loading);

} // namespace shoal::scene
