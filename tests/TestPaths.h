// Where tests find the source tree, the program under test and the optional reference data.
#pragma once

#include <filesystem>
#include <string>

namespace shoal::tests {

std::filesystem::path sourceFolder();
std::string program();                    // the built game
std::filesystem::path sharedDataFolder(); // $SHOAL_SHARED/data, else ../shared/data; may be missing

// Where a case keeps what others need too and what takes long to make: below the build, and anew for each
// build of the program. Cases run side by side: write a file whole (writeWhole), so that nobody reads half of
// it.
std::filesystem::path cacheFolder();

} // namespace shoal::tests
