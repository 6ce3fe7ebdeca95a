// A .glb or .gltf file taken apart into its JSON text and its binary chunk.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace shoal::scene {

struct Container {
    std::string_view json;                          // views of the file's bytes
    std::optional<std::span<const uint8_t>> binary; // the GLB's BIN chunk
};

// glTF 2.0 specification, section 4 "GLB File Format Specification". Throws Fault where a length lies.
Container openContainer(std::span<const uint8_t> file);

// Refuses JSON text that would take far more memory than itself once parsed (many tiny objects), or more
// stack (deep nesting); the parser's own callback takes quadratic time. Reads brackets and commas only; the
// parser finds what is not JSON at all.
void checkJsonSize(std::string_view json);

} // namespace shoal::scene
