// The bytes behind a URI in a glTF file: a data URI, or a file at or below the model's own folder.
#pragma once

#include "engine/core/Files.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace shoal::scene {

struct Loading;

// who: the element that names the URI, for messages. Throws Fault for what cannot or must not be read, before
// memory beyond the limits is taken.
std::vector<uint8_t> readUri(Loading& loading, const std::string& uri, const std::string& who);

// Where a relative URI leads; percent-decoded. Throws Fault for absolute paths, schemes, "..", and links that
// leave the folder.
Path confined(const Path& folder, const std::string& uri, const std::string& who);

// RFC 4648 section 4, padding optional. Throws Fault for any other character.
std::vector<uint8_t> decodeBase64(std::string_view text, const std::string& who);

} // namespace shoal::scene
