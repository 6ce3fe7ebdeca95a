#include "engine/core/WriteFile.h"

#include "engine/core/Number.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace shoal {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kEnding = ".part";
constexpr size_t kLongestName = 200; // of the file's in the temporary's, which must not exceed 255 bytes

Error failed(const Path& file, const std::string& what, int code) {
    return Error{file.string(), what + ": " + std::generic_category().message(code)};
}

class Descriptor {
  public:
    explicit Descriptor(int value) : value_(value) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (value_ >= 0) ::close(value_);
    }
    int get() const { return value_; }
    bool close() { return ::close(std::exchange(value_, -1)) == 0; }

  private:
    int value_;
};

bool writeAll(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        bytes.remove_prefix(static_cast<size_t>(written));
    }
    return true;
}

// File systems that cannot be asked answer EINVAL.
bool sync(int descriptor) { return ::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS; }

// The names in it, so that a rename survives a loss of power.
void syncFolder(const Path& folder) {
    const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (opened.get() >= 0) sync(opened.get());
}

Path folderOf(const Path& file) { return file.has_parent_path() ? file.parent_path() : Path("."); }

// Where its symbolic links lead, whether something is there or not; a link where they lead in a circle.
Path followed(Path file) {
    std::error_code code;
    for (int links = 0; links < 40 && fs::is_symlink(fs::symlink_status(file, code)); ++links) {
        const Path target = fs::read_symlink(file, code);
        if (code) break;
        file = target.is_absolute() ? target : file.parent_path() / target;
    }
    return file;
}

std::string prefixFor(const Path& file) {
    return "." + file.filename().string().substr(0, kLongestName) + ".";
}

Path temporaryFor(const Path& file) {
    return folderOf(file) / (prefixFor(file) + std::to_string(::getpid()) + std::string(kEnding));
}

// What processes that are gone, or this one under an earlier owner of its number, have left beside the file.
void removeAbandoned(const Path& file) {
    const std::string prefix = prefixFor(file);
    std::error_code code;
    for (fs::directory_iterator entry(folderOf(file), code), end; !code && entry != end;
         entry.increment(code)) {
        const std::string name = entry->path().filename().string();
        if (!name.starts_with(prefix) || !name.ends_with(kEnding)) continue;
        const auto process =
            parseNumber<pid_t>(name.substr(prefix.size(), name.size() - prefix.size() - kEnding.size()), 1);
        if (!process) continue;
        const bool gone = *process == ::getpid() || (::kill(*process, 0) != 0 && errno == ESRCH);
        std::error_code ignored;
        if (gone) fs::remove_all(entry->path(), ignored);
    }
}

constexpr const char* kCannotWrite = "cannot be written";

// A new file with these bytes, on the disk. Nothing is left of it on failure.
// old: the file that it is to replace, whose permissions it takes.
Status writeNew(const Path& at, const Path& shown, std::string_view bytes, const Path& old) {
    Descriptor out(::open(at.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (out.get() < 0) return failed(shown, kCannotWrite, errno);
    struct stat before {};
    if (::stat(old.c_str(), &before) == 0) ::fchmod(out.get(), before.st_mode & 07777);
    const bool written = writeAll(out.get(), bytes) && sync(out.get());
    const int problem = errno;
    if (out.close() && written) return Done{};
    const int closing = errno;
    ::unlink(at.c_str());
    return failed(shown, kCannotWrite, written ? closing : problem);
}

// Into what is there and is no regular file.
Status writeInto(const Path& target, const Path& shown, std::string_view bytes) {
    Descriptor out(::open(target.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
    if (out.get() < 0 || !writeAll(out.get(), bytes) || !out.close())
        return failed(shown, kCannotWrite, errno);
    return Done{};
}

// A file that is written beside its place and has not been put there.
struct Staged {
    Path temporary, target;
};

class Staging {
  public:
    ~Staging() {
        std::error_code ignored;
        for (const Staged& each : staged_) fs::remove(each.temporary, ignored);
    }

    Status add(const Path& target, const Path& shown, std::string_view bytes) {
        removeAbandoned(target);
        const Path temporary = temporaryFor(target);
        if (Status written = writeNew(temporary, shown, bytes, target); !written) return written;
        staged_.push_back({temporary, target});
        return Done{};
    }

    Status putInPlace() {
        while (!staged_.empty()) {
            const auto& [temporary, target] = staged_.back();
            std::error_code code;
            fs::rename(temporary, target, code);
            if (code) return Error{target.string(), "cannot be put in place: " + code.message()};
            syncFolder(folderOf(target));
            staged_.pop_back();
        }
        return Done{};
    }

  private:
    std::vector<Staged> staged_;
};

bool isSpecial(const fs::file_status& status) {
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

} // namespace

Status writeFileWhole(const Path& file, std::string_view bytes) {
    std::error_code code;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), code);
    const Path target = followed(file);
    const fs::file_status there = fs::status(target, code);
    if (fs::is_directory(there)) return Error{file.string(), "cannot be written: it is a folder"};
    if (fs::is_symlink(fs::symlink_status(target, code))) return failed(file, kCannotWrite, ELOOP);
    if (isSpecial(there)) return writeInto(target, file, bytes);
    Staging staging;
    if (Status staged = staging.add(target, file, bytes); !staged) return staged;
    return staging.putInPlace();
}

Status writeFolderWhole(const Path& named, std::span<const NamedBytes> files) {
    std::error_code code;
    const Path folder = followed((named / "").parent_path()); // without a slash at its end
    if (folder.has_parent_path()) fs::create_directories(folder.parent_path(), code);
    if (fs::exists(folder, code)) {
        if (!fs::is_directory(folder, code)) return Error{folder.string(), "is a file, not a folder"};
        Staging staging;
        for (const auto& [name, bytes] : files) {
            const Path target = followed(folder / name);
            const fs::file_status there = fs::status(target, code);
            if (fs::exists(there) && !fs::is_regular_file(there))
                return Error{target.string(), "cannot be written: it is not a regular file"};
            if (Status staged = staging.add(target, folder / name, bytes); !staged) return staged;
        }
        return staging.putInPlace();
    }
    removeAbandoned(folder);
    const Path temporary = temporaryFor(folder);
    const auto giveUp = [&](Error why) {
        std::error_code ignored;
        fs::remove_all(temporary, ignored);
        return why;
    };
    if (!fs::create_directory(temporary, code))
        return Error{folder.string(), "cannot be created: " + code.message()};
    for (const auto& [name, bytes] : files)
        if (Status written = writeNew(temporary / name, folder / name, bytes, folder / name); !written)
            return giveUp(written.error());
    syncFolder(temporary);
    fs::rename(temporary, folder, code);
    if (code) return giveUp(Error{folder.string(), "cannot be put in place: " + code.message()});
    syncFolder(folderOf(folder));
    return Done{};
}

Result<GrowingFile> GrowingFile::create(const Path& file) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOCTTY, 0666);
    if (descriptor < 0) return failed(file, kCannotWrite, errno);
    return GrowingFile(file, descriptor);
}

Result<GrowingFile> GrowingFile::extend(const Path& file, uint64_t bytes) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY);
    if (descriptor < 0) return failed(file, kCannotWrite, errno);
    GrowingFile extended(file, descriptor);
    if (::ftruncate(descriptor, static_cast<off_t>(bytes)) != 0) return failed(file, kCannotWrite, errno);
    return extended;
}

GrowingFile::GrowingFile(GrowingFile&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

GrowingFile& GrowingFile::operator=(GrowingFile&& other) noexcept {
    std::swap(file_, other.file_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

GrowingFile::~GrowingFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

Status GrowingFile::write(std::string_view bytes) {
    if (!writeAll(descriptor_, bytes)) return failed(file_, kCannotWrite, errno);
    return Done{};
}

Status GrowingFile::finish() {
    const bool synced = sync(descriptor_);
    const int problem = errno;
    if (::close(std::exchange(descriptor_, -1)) == 0 && synced) return Done{};
    return failed(file_, kCannotWrite, synced ? errno : problem);
}

static Status checkOutput(const NamedFile& output) {
    std::error_code code;
    const Path target = followed(output.file), folder = folderOf(target);
    const fs::file_status there = fs::status(target, code);
    if (fs::is_directory(there)) return Error{output.file.string(), "cannot be written: it is a folder"};
    if (!fs::is_directory(folder, code))
        return Error{output.file.string(), "there is no folder " + folder.string()};
    const Path& written = isSpecial(there) ? target : folder;
    if (::access(written.c_str(), W_OK) != 0) return failed(output.file, kCannotWrite, errno);
    return Done{};
}

// Two names of one file that keeps what is written to it: a device may be named twice.
static bool isSame(const Path& a, const Path& b) {
    std::error_code code;
    const Path first = followed(a), second = followed(b);
    if (isSpecial(fs::status(first, code))) return false;
    return fs::equivalent(first, second, code) || fs::weakly_canonical(fs::absolute(first, code), code) ==
                                                      fs::weakly_canonical(fs::absolute(second, code), code);
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
