#include "tests/TestPaths.h"

#include <cstdlib>
#include <stdexcept>

namespace shoal::tests {

std::filesystem::path sourceFolder() { return SHOAL_SOURCE_DIR; }

std::string program() { return SHOAL_PROGRAM; }

std::filesystem::path sharedDataFolder() {
    const char* set = std::getenv("SHOAL_SHARED");
    return (set && *set ? std::filesystem::path(set) : sourceFolder().parent_path() / "shared") / "data";
}

std::filesystem::path cacheFolder() {
    const std::filesystem::path built = program();
    const auto made = std::filesystem::last_write_time(built).time_since_epoch().count();
    return built.parent_path().parent_path() / "tests" / "cache" / std::to_string(made);
}

ScratchFolder::ScratchFolder() {
    std::string name = std::filesystem::temp_directory_path() / "shoal_test_XXXXXX";
    if (!mkdtemp(name.data())) throw std::runtime_error(name + " cannot be made");
    path_ = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

} // namespace shoal::tests
