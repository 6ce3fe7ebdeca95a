// Writing files so that nothing is lost: the one way in which the program writes them. Any thread.
//
// A file is written beside its place, brought to the disk, then renamed: a reader, a crash or a full disk
// finds the old file or the new one, never half of one. The name beside NAME is .NAME.PID.part, of the
// process that writes; those of the same NAME whose process is gone are removed by the next writer. Symbolic
// links are followed, so that a link stays one; into devices, FIFOs and sockets is written as they are.
#pragma once

#include "engine/core/Files.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace shoal {

// Creates the parent folder.
Status writeFileWhole(const Path& file, std::string_view bytes);

struct NamedBytes {
    std::string name; // of a file in the folder
    std::string bytes;
};

// All of them or none: a folder that is not there yet appears whole; in one that is, nothing is replaced
// before everything has been written beside. Creates the parent folder.
Status writeFolderWhole(const Path& folder, std::span<const NamedBytes> files);

// A file that grows while the program runs, written under its final name; for what must survive a crash.
class GrowingFile {
  public:
    // Replaces what was there.
    static Result<GrowingFile> create(const Path& file);
    // Goes on behind the first `bytes` of a file that is there; what it holds beyond them is dropped.
    static Result<GrowingFile> extend(const Path& file, uint64_t bytes);
    GrowingFile(GrowingFile&&) noexcept;
    GrowingFile& operator=(GrowingFile&&) noexcept;
    ~GrowingFile();

    Status write(std::string_view bytes);
    // Waits until the disk has it all, and closes.
    Status finish();

  private:
    GrowingFile(Path file, int descriptor) : file_(std::move(file)), descriptor_(descriptor) {}
    Path file_;
    int descriptor_;
};

// A file that a person has named, and the option that did so.
struct NamedFile {
    std::string option;
    Path file; // empty: not given
};

// Before work whose result would be lost: every output has a folder that can be written to, is no folder
// itself, and is neither another output nor one of the inputs.
Status checkOutputs(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs = {});

} // namespace shoal
