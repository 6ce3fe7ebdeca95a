// Locations of files, and reading them whole; WriteFile.h writes them. Any thread.
#pragma once

#include "engine/core/Result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace shoal {

using Path = std::filesystem::path;

Path programFolder(); // of the running program

// Returns the folder of content/ and shaders/, the same at each call: $SHOAL_DATA; else where it is
// installed, relative to the program, so that an installation can be moved; else the build's source tree.
const Path& dataRoot();

// $XDG_CONFIG_HOME/shoal, $XDG_DATA_HOME/shoal, $XDG_CACHE_HOME/shoal; relative values are ignored, as the
// XDG Base Directory Specification asks. Not created here.
Path configFolder();
Path dataFolder();
Path cacheFolder();

// Returns one of the user's folders, whatever its name in their language: from xdg-user-dirs' file
// $XDG_CONFIG_HOME/user-dirs.dirs, else by its English name in the home folder. Not created here.
enum class UserFolder { Pictures, Videos, Downloads };
Path userFolder(UserFolder which);

// Returns the extension with its dot and in lower case (of ASCII): ".png" of "A.PNG".
std::string extensionOf(const Path& file);

// Reads the whole file. Fails if it is missing, not a regular file, or larger than maxBytes (checked before
// memory is taken).
Result<std::vector<uint8_t>> readFile(const Path& file, uint64_t maxBytes);
// Reads the file's first maxBytes, or all of a smaller file.
Result<std::vector<uint8_t>> readFileBegin(const Path& file, uint64_t maxBytes);
Result<std::string> readText(const Path& file, uint64_t maxBytes = 16u << 20);

} // namespace shoal
