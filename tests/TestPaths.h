// Where tests find the source tree, the program under test and the optional reference data.
#pragma once

#include <filesystem>
#include <string>
#include <unistd.h>

namespace shoal::tests {

std::filesystem::path sourceFolder();
std::string program();                    // the built game
std::filesystem::path sharedDataFolder(); // $SHOAL_SHARED/data, else ../shared/data; may be missing

// Where a case keeps what others need too and what takes long to make: below the build, and anew for each
// build of the program. Cases run side by side: write a file whole (writeWhole()), so that nobody reads half
// of it.
std::filesystem::path cacheFolder();

// Calls write(path beside the file, of the same extension), then renames that. write: gives an object that is
// false where it failed, as writeWhole() does.
template <class Write> auto writeWhole(const std::filesystem::path& file, Write&& write) {
    const auto part = file.parent_path() / ("part" + std::to_string(::getpid()) + file.filename().string());
    auto written = write(part);
    if (written) std::filesystem::rename(part, file);
    return written;
}

// A new, empty folder, removed with what it holds at the end. Each case needs one of its own: cases run side
// by side, as processes of their own.
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
