#include "engine/core/Files.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>

namespace shoal {

namespace fs = std::filesystem;

Path programFolder() {
    std::error_code code;
    return fs::read_symlink("/proc/self/exe", code).parent_path();
}

const Path& dataRoot() {
    static const Path root = [] {
        if (const char* set = std::getenv("SHOAL_DATA"); set && *set) return Path(set);
        std::error_code code;
        const Path installed = (programFolder() / SHOAL_DATA_FROM_PROGRAM).lexically_normal();
        return fs::exists(installed / "content", code) ? installed : Path(SHOAL_SOURCE_DIR);
    }();
    return root;
}

static Path home() {
    const char* set = std::getenv("HOME");
    return set && *set ? set : "/";
}

static Path xdgFolder(const char* variable, const char* fallbackBelowHome) {
    if (const char* set = std::getenv(variable); set && set[0] == '/') return set;
    return home() / fallbackBelowHome;
}

Path configFolder() { return xdgFolder("XDG_CONFIG_HOME", ".config") / "shoal"; }
Path dataFolder() { return xdgFolder("XDG_DATA_HOME", ".local/share") / "shoal"; }
Path cacheFolder() { return xdgFolder("XDG_CACHE_HOME", ".cache") / "shoal"; }

Path userFolder(UserFolder which) {
    constexpr std::pair<std::string_view, const char*> kRows[] = {{"XDG_PICTURES_DIR=\"", "Pictures"},
                                                                  {"XDG_VIDEOS_DIR=\"", "Videos"},
                                                                  {"XDG_DOWNLOAD_DIR=\"", "Downloads"}};
    const auto [entry, english] = kRows[static_cast<size_t>(which)];
    // Lines, in shell syntax: NAME="$HOME/relative" or NAME="/absolute", with \ before special characters.
    const auto text = readText(xdgFolder("XDG_CONFIG_HOME", ".config") / "user-dirs.dirs", 1u << 16);
    std::istringstream lines(text ? *text : "");
    constexpr std::string_view kHome = "$HOME";
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(entry)) continue;
        std::string value;
        for (size_t i = entry.size(); i < line.size() && line[i] != '"'; ++i)
            value += line[i] == '\\' && i + 1 < line.size() ? line[++i] : line[i];
        if (value.starts_with('/')) return value;
        if (value.starts_with(kHome)) return home() / Path(value.substr(kHome.size())).relative_path();
    }
    return home() / english;
}

// atMost: bytes that are read of a larger file.
template <class Bytes>
static Result<Bytes> read(const Path& file, uint64_t maxBytes, uint64_t atMost = UINT64_MAX) {
    std::error_code code;
    const auto status = fs::status(file, code);
    if (!fs::exists(status)) return Error{file.string(), "there is no such file"};
    if (fs::is_directory(status)) return Error{file.string(), "is a folder, not a file"};
    if (!fs::is_regular_file(status)) return Error{file.string(), "is not a regular file"};
    const uint64_t size = std::min(fs::file_size(file, code), atMost);
    if (code) return Error{file.string(), "cannot be read: " + code.message()};
    if (size > maxBytes)
        return Error{file.string(), "is larger than the limit of " + std::to_string(maxBytes) + " bytes"};
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return Error{file.string(), "cannot be opened; check its permissions"};
    Bytes bytes(size, 0);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (static_cast<uint64_t>(stream.gcount()) != size)
        return Error{file.string(), "ended while it was being read"};
    return bytes;
}

std::string extensionOf(const Path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return extension;
}

Result<std::vector<uint8_t>> readFile(const Path& file, uint64_t maxBytes) {
    return read<std::vector<uint8_t>>(file, maxBytes);
}

Result<std::vector<uint8_t>> readFileBegin(const Path& file, uint64_t maxBytes) {
    return read<std::vector<uint8_t>>(file, maxBytes, maxBytes);
}

Result<std::string> readText(const Path& file, uint64_t maxBytes) {
    return read<std::string>(file, maxBytes);
}

} // namespace shoal
