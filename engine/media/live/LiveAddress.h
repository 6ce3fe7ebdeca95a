// What `--video` may name beside a file.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <array>
#include <optional>
#include <string>
#include <variant>

namespace shoal::media {

struct CameraAddress {
    int index = 0; // as the system counts them
};
struct PipeAddress {
    Path file;
};
struct StreamAddress {
    std::string url;
    // What FFmpeg may open for it, with commas between: a server cannot lead it to files or elsewhere.
    const char* protocols = "";
};
using LiveAddress = std::variant<CameraAddress, PipeAddress, StreamAddress>;

// Before "://"; whatever else stands there is refused.
inline constexpr std::array kStreamSchemes = {"rtsp", "http", "https", "tcp", "udp"};

// "camera:N", the name of a named pipe, or a URL of one of the schemes. Empty: `text` names a file, if
// anything. Errors: it names something live that cannot be had, such as a scheme that is not allowed.
Result<std::optional<LiveAddress>> liveAddress(const std::string& text);

// As it is shown: without the user's name and password.
std::string withoutPassword(const std::string& url);

} // namespace shoal::media
