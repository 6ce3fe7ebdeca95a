// Writing files so that nothing is lost: the one way in which the program writes them. Any thread.
//
// A file is written beside its place, brought to the disk, then renamed: a reader, a crash or a full disk
// finds the old file or the new one, never half of one. The name beside NAME is .NAME.PID.part, of the
// process that writes; a process that is killed in the middle leaves it there. Symbolic links are followed,
// so that a link stays one; devices, FIFOs and sockets are written into directly.
#pragma once

#include "engine/core/Files.h"

#include <cstdint>
#include <cstdio>
#include <memory>
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

// Writes all of them or none: nothing is put in place before everything has been written beside. Creates the
// folder.
Status writeFolderWhole(const Path& folder, std::span<const NamedBytes> files);

// A file that grows while the program runs, under its final name, so that it survives a crash.
class GrowingFile {
  public:
    // Replaces the file.
    static Result<GrowingFile> create(const Path& file);
    // Cuts a file to its first `bytes` and continues it.
    static Result<GrowingFile> extend(const Path& file, uint64_t bytes);

    Status write(std::string_view bytes);
    // Waits until the disk has it all, and closes.
    Status finish();

  private:
    static Result<GrowingFile> open(const Path& file, const char* mode); // of std::fopen()
    GrowingFile(const Path& file, std::FILE* opened) : file_(file), out_(opened, std::fclose) {}
    Path file_;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> out_;
};

// A file that a person has named, and the option that did so.
struct NamedFile {
    std::string option;
    Path file; // empty: not given
};

// Checks, before work whose result would be lost, that every output has a folder that can be written to, is
// no folder itself, and is neither another output nor one of the inputs.
Status checkOutputs(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs = {});

} // namespace shoal
