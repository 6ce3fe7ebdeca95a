// Addresses of live video, as `--video` takes them: camera, named pipe or URL.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <array>
#include <optional>
#include <string>
#include <variant>

namespace shoal::media {

struct CameraAddress {
    int index = 0; // of /dev/videoN
};
struct PipeAddress {
    Path file;
};
struct StreamAddress {
    std::string url;
    // Protocols that FFmpeg may use for it, comma separated: a server cannot redirect it to files.
    const char* protocols = "";
};
using LiveAddress = std::variant<CameraAddress, PipeAddress, StreamAddress>;

// Schemes of URLs that are played; all others are refused.
inline constexpr std::array kStreamSchemes = {"rtsp", "http", "https", "tcp", "udp"};

// "camera:N", the name of a named pipe, or a URL of one of the schemes. Empty: `text` names a file, if
// anything. Errors: a malformed camera or URL, or a scheme that is not allowed.
Result<std::optional<LiveAddress>> liveAddress(const std::string& text);

// For messages: without user name and password.
std::string withoutPassword(const std::string& url);

} // namespace shoal::media
