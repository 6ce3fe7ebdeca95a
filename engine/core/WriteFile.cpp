#include "engine/core/WriteFile.h"

#include <cerrno>
#include <system_error>
#include <unistd.h>

namespace shoal {

namespace fs = std::filesystem;

constexpr size_t kLongestName = 200; // part of a name that its temporary name has, within 255 bytes

static Error cannotWrite(const Path& file, const std::string& why) {
    return Error{file.string(), "cannot be written: " + why};
}

static Error cannotWrite(const Path& file, int code) {
    return cannotWrite(file, std::generic_category().message(code));
}

// Resolves the symbolic links of a path, even without a target; returns a link if they form a cycle.
static Path placeOf(const Path& file) {
    std::error_code code;
    const Path place = fs::weakly_canonical(fs::absolute(file, code), code);
    if (code) return file;
    if (!fs::is_symlink(fs::symlink_status(place, code))) return place;
    return placeOf(place.parent_path() / fs::read_symlink(place, code)); // a dangling link
}

static bool isSpecial(const fs::file_status& status) {
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

using Staged = std::vector<std::pair<Path, Path>>; // files under temporary names, and their places

// Writes a file under a temporary name in its folder, which it adds to `staged`; writes a device directly.
static Status stage(const Path& file, std::string_view bytes, Staged& staged) {
    std::error_code code;
    const Path place = placeOf(file);
    const fs::file_status old = fs::status(place, code);
    if (fs::is_directory(old)) return cannotWrite(file, "it is a folder");
    if (fs::is_symlink(fs::symlink_status(place, code))) return cannotWrite(file, ELOOP);
    Path to = place;
    if (!isSpecial(old)) {
        to.replace_filename("." + place.filename().string().substr(0, kLongestName) + "." +
                            std::to_string(::getpid()) + ".part");
        fs::remove(to, code);
        staged.emplace_back(to, place);
    }
    auto out = GrowingFile::open(to);
    if (out && fs::is_regular_file(old)) fs::permissions(to, old.permissions(), code);
    Status written = out ? out->write(bytes) : Status(out.error());
    if (written) written = out->finish();
    return written ? written : Error{file.string(), written.error().reason};
}

// Renames the files if all were written, and removes those that were not put in place. Temporary files stay
// only where memory runs out.
static Status putInPlace(const Staged& staged, Status written) {
    std::error_code code;
    for (const auto& [temporary, place] : staged) {
        if (written) fs::rename(temporary, place, code);
        if (written && code) written = Error{place.string(), "cannot be put in place: " + code.message()};
        if (!written) fs::remove(temporary, code);
    }
    return written;
}

Status writeFileWhole(const Path& file, std::string_view bytes) {
    std::error_code code;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), code);
    Staged staged;
    const Status written = stage(file, bytes, staged);
    return putInPlace(staged, written);
}

Status writeFolderWhole(const Path& folder, std::span<const NamedBytes> files) {
    std::error_code code;
    const bool isNew = fs::create_directories(folder, code);
    if (code) return Error{folder.string(), "cannot be created: " + code.message()};
    Staged staged;
    Status written = Done{};
    for (const auto& [name, bytes] : files)
        if (written) written = stage(folder / name, bytes, staged);
    written = putInPlace(staged, written);
    if (!written && isNew) fs::remove(folder, code);
    return written;
}

Result<GrowingFile> GrowingFile::open(const Path& file, uint64_t kept) {
    std::error_code code;
    if (kept > 0) fs::resize_file(file, kept, code);
    if (code) return cannotWrite(file, code.message());
    GrowingFile opened(file, std::fopen(file.c_str(), kept > 0 ? "abe" : "wbe"));
    if (!opened.out_) return cannotWrite(file, errno);
    return opened;
}

Status GrowingFile::write(std::string_view bytes) {
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), out_.get()) == bytes.size() &&
                         std::fflush(out_.get()) == 0;
    return written ? Status(Done{}) : cannotWrite(file_, errno);
}

Status GrowingFile::finish() {
    // File systems, devices and pipes that cannot be synced answer EINVAL.
    const bool synced = ::fsync(::fileno(out_.get())) == 0 || errno == EINVAL || errno == EROFS;
    const int problem = errno;
    if (std::fclose(out_.release()) == 0 && synced) return Done{};
    return cannotWrite(file_, synced ? errno : problem);
}

static Status checkOutput(const NamedFile& output) {
    std::error_code code;
    const Path place = placeOf(output.file), folder = place.parent_path();
    const fs::file_status there = fs::status(place, code);
    if (fs::is_directory(there)) return cannotWrite(output.file, "it is a folder");
    if (!fs::is_directory(folder, code))
        return Error{output.file.string(), "there is no folder " + folder.string()};
    const Path& written = isSpecial(there) ? place : folder;
    return ::access(written.c_str(), W_OK) == 0 ? Status(Done{}) : cannotWrite(output.file, errno);
}

// Returns whether two names refer to the same file; false for a device, which may be named twice.
static bool isSame(const Path& a, const Path& b) {
    std::error_code code;
    const Path place = placeOf(a), other = placeOf(b);
    return !isSpecial(fs::status(place, code)) && (place == other || fs::equivalent(place, other, code));
}

Status checkOutputs(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs) {
    for (size_t i = 0; i < outputs.size(); ++i) {
        const auto& [option, file] = outputs[i];
        if (file.empty()) continue;
        if (Status possible = checkOutput(outputs[i]); !possible) return possible;
        for (const NamedFile& input : inputs)
            if (!input.file.empty() && isSame(file, input.file))
                return Error{file.string(), option + " would overwrite what " + input.option + " reads"};
        for (size_t k = 0; k < i; ++k)
            if (!outputs[k].file.empty() && isSame(file, outputs[k].file))
                return Error{file.string(), outputs[k].option + " and " + option + " name the same file"};
    }
    return Done{};
}

} // namespace shoal
