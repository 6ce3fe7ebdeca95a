// A fuzz target defines LLVMFuzzerTestOneInput(); libFuzzer calls it with one input after the other.
#pragma once

#include "engine/core/Files.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <span>
#include <stdexcept>
#include <unistd.h>

namespace shoal::fuzz {

// Asserts what holds for any input; libFuzzer keeps the input of a run that aborts.
inline void expect(bool holds) {
    if (!holds) std::abort();
}

inline int taken = 0; // inputs that the target did not refuse
inline Path beside;   // folder whose .bin files lie beside the input too

// Reads the input from the front; zeros once it is used up.
class Bytes {
  public:
    Bytes(const uint8_t* data, size_t size) : rest_(data, size) {}
    bool empty() const { return rest_.empty(); }
    template <class T> T next() {
        T value{};
        const size_t count = std::min(sizeof value, rest_.size());
        std::memcpy(&value, rest_.data(), count);
        rest_ = rest_.subspan(count);
        return value;
    }

  private:
    std::span<const uint8_t> rest_;
};

// The bytes of a run as a file, for parsers of files: in a folder in memory that goes with the process.
class FileInput {
  public:
    // name: of the file, whose ending some parsers go by.
    explicit FileInput(const std::string& name) {
        const bool inMemory = ::access("/dev/shm", W_OK) == 0;
        std::string pattern = inMemory ? "/dev/shm/shoal_fuzz_XXXXXX" : "/tmp/shoal_fuzz_XXXXXX";
        if (!::mkdtemp(pattern.data())) throw std::runtime_error(pattern + " cannot be made");
        folder_ = pattern;
        file_ = folder_ / name;
    }
    ~FileInput() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    FileInput(const FileInput&) = delete;
    FileInput& operator=(const FileInput&) = delete;

    const Path& operator()(std::span<const uint8_t> bytes) const {
        if (copied_ != beside)
            for (const auto& entry : std::filesystem::directory_iterator(copied_ = beside))
                if (entry.path().extension() == ".bin")
                    copy(entry.path(), folder_ / entry.path().filename(),
                         std::filesystem::copy_options::overwrite_existing);
        const int out = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
        if (out < 0 || ::write(out, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
            throw std::runtime_error("the disk is full");
        ::close(out);
        return file_;
    }
    const Path& folder() const { return folder_; }

  private:
    Path folder_, file_;
    mutable Path copied_; // files of this folder are there
};

} // namespace shoal::fuzz
