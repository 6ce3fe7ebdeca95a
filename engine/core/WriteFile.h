// Writes files so that nothing is lost; all files of the program are written by these functions. Any thread.
//
// A file is written under a temporary name in its folder (.NAME.PID.part, which a killed process leaves),
// synchronised to the disk, then renamed: a reader, a crash or a full disk finds the old file or the new one,
// never half of one. Symbolic links are followed and kept; devices and FIFOs are written to directly.
#pragma once

#include "engine/core/Files.h"

#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace shoal {

// Writes or replaces a file; creates its parent folder.
Status writeFileWhole(const Path& file, std::string_view bytes);

struct NamedBytes {
    std::string name; // of a file in the folder
    std::string bytes;
};

// Writes all files under temporary names before it renames the first, so that a full disk replaces none. If a
// rename fails, the files before it stay replaced. Creates the folder.
Status writeFolderWhole(const Path& folder, std::span<const NamedBytes> files);

// A file that grows while the program runs, under its final name, so that it survives a crash.
class GrowingFile {
  public:
    // Replaces the file; if kept > 0, keeps that many of its first bytes and appends to them.
    static Result<GrowingFile> open(const Path& file, uint64_t kept = 0);

    Status write(std::string_view bytes);
    // Waits until all bytes are on the disk, and closes the file.
    Status finish();

  private:
    GrowingFile(const Path& file, std::FILE* opened) : file_(file), out_(opened, std::fclose) {}
    Path file_;
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> out_;
};

// A file that the user names, and the option that names it.
struct NamedFile {
    std::string option;
    Path file; // empty: not given
};

// Checks, before work whose result would be lost, that every output has a folder that can be written to, is
// no folder itself, and is neither another output nor one of the inputs.
Status checkOutputs(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs = {});

} // namespace shoal
