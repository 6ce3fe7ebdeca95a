#include "engine/media/live/LiveFeed.h"

#include "engine/core/Number.h"

#include <string_view>

namespace shoal::media {

// Schemes of URLs that are played, with StreamAddress::protocols; all others are refused. RTSP has to send
// pictures over its own connection: by UDP its server could make us send to other hosts.
constexpr std::pair<const char*, const char*> kStreams[] = {
    {"rtsp", "tcp"}, {"http", "http,tcp"}, {"https", "https,tls,tcp"}, {"tcp", "tcp"}, {"udp", "udp"}};

constexpr size_t kMaxLength = 2048;

// Returns the text before "://", if that can be a scheme.
static std::string_view schemeOf(std::string_view text) {
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-.";
    const size_t end = text.find_first_not_of(kLetters);
    return end != text.npos && text.substr(end).starts_with("://") ? text.substr(0, end) : std::string_view();
}

Result<std::optional<LiveAddress>> liveAddress(const std::string& text) {
    if (text.starts_with("camera:")) {
        const auto number = parseNumber(text.substr(7), 0, 99);
        if (!number) return Error{text, "wants the number of a camera, such as camera:0"};
        return std::optional<LiveAddress>(CameraAddress{*number});
    }
    if (const std::string_view scheme = schemeOf(text); !scheme.empty()) {
        if (text.size() > kMaxLength) return Error{withoutPassword(text.substr(0, 80)), "is too long a URL"};
        std::string known;
        for (const auto& [name, protocols] : kStreams) {
            if (scheme == name) return std::optional<LiveAddress>(StreamAddress{text, protocols});
            known += (known.empty() ? "" : ", ") + std::string(name);
        }
        return Error{withoutPassword(text), "is a URL of a kind that is not played; these are: " + known};
    }
    std::error_code code;
    if (!std::filesystem::is_fifo(text, code)) return std::optional<LiveAddress>();
    return std::optional<LiveAddress>(StreamAddress{.place = text, .protocols = "pipe", .isPipe = true});
}

std::string withoutPassword(const std::string& url) {
    const size_t from = url.find("://");
    if (from == std::string::npos) return url;
    const size_t host = from + 3, at = url.substr(0, url.find_first_of("/?#", host)).rfind('@');
    return at == std::string::npos || at < host ? url : url.substr(0, host) + url.substr(at + 1);
}

std::shared_ptr<LiveFeed> feedFrom(const LiveAddress& address, const FeedTimeouts& timeouts) {
    if (const auto* camera = std::get_if<CameraAddress>(&address)) return cameraFeed(*camera);
    return streamFeed(std::get<StreamAddress>(address), timeouts);
}

} // namespace shoal::media
