// Paths of the source tree, the program under test and the optional reference data.
#pragma once

#include <filesystem>
#include <string>
#include <unistd.h>

namespace shoal::tests {

std::filesystem::path sourceFolder();
std::string program();                    // the built game
std::filesystem::path sharedDataFolder(); // $SHOAL_SHARED/data, else ../shared/data; may be missing

// Returns the folder, a new one for each build of the program, for files that take long to make or that
// several cases need. Cases run side by side: write a file whole (writeWhole()), so that none reads half of
// it.
std::filesystem::path cacheFolder();

// Calls write(path beside the file, of the same extension), then renames that. write: gives an object that is
// false where it failed, as writeWhole() does.
template <class Write> auto writeWhole(const std::filesystem::path& file, Write&& write) {
    const auto part = file.parent_path() / ("part" + std::to_string(::getpid()) + file.filename().string());
    auto written = write(part);
    if (written) std::filesystem::rename(part, file);
    return written;
}

// A new, empty folder, removed with its content. Cases run side by side, so each needs its own.
class ScratchFolder {
  public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

} // namespace shoal::tests
