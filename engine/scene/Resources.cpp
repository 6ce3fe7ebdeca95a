#include "engine/scene/Resources.h"

#include "engine/scene/Loading.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace shoal::scene {

namespace {

constexpr uint8_t kNoDigit = 255;

constexpr std::array<uint8_t, 256> kBase64Digit = [] {
    std::array<uint8_t, 256> table{};
    table.fill(kNoDigit);
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < kDigits.size(); ++i)
        table[static_cast<unsigned char>(kDigits[i])] = static_cast<uint8_t>(i);
    return table;
}();

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::string percentDecoded(std::string_view uri) {
    std::string plain;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && hexDigit(uri[i + 1]) >= 0 && hexDigit(uri[i + 2]) >= 0) {
            plain += static_cast<char>(hexDigit(uri[i + 1]) * 16 + hexDigit(uri[i + 2]));
            i += 2;
        } else {
            plain += uri[i];
        }
    }
    return plain;
}

// RFC 3986: scheme = ALPHA *( ALPHA / DIGIT / "+" / "-" / "." ) ":"
bool hasScheme(const std::string& uri) {
    const size_t colon = uri.find(':');
    if (colon == std::string::npos || colon == 0) return false;
    return std::all_of(uri.begin(), uri.begin() + static_cast<ptrdiff_t>(colon),
                       [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; });
}

} // namespace

std::vector<uint8_t> decodeBase64(std::string_view text, const std::string& who) {
    for (int padding = 0; padding < 2 && !text.empty() && text.back() == '='; ++padding)
        text.remove_suffix(1);
    if (text.size() % 4 == 1) fault(who, ": the data URI is cut short");
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const uint8_t digit = kBase64Digit[static_cast<unsigned char>(c)];
        if (digit == kNoDigit) fault(who, ": the data URI is not base64");
        bits = bits << 6 | digit;
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<uint8_t>(bits >> count));
        }
    }
    return bytes;
}

Path confined(const Path& folder, const std::string& uri, const std::string& who) {
    namespace fs = std::filesystem;
    const std::string plain = percentDecoded(uri);
    if (plain.empty()) fault(who, ".uri is empty");
    if (hasScheme(plain)) fault(who, ".uri (", quoted(plain), ") is no file of the model's own folder");
    if (plain.find('\0') != std::string::npos || plain.find('\\') != std::string::npos)
        fault(who, ".uri (", quoted(plain), ") holds characters that no file name should");
    const Path relative(plain);
    const bool climbs = std::find(relative.begin(), relative.end(), "..") != relative.end();
    if (relative.is_absolute() || climbs)
        fault(who, ".uri (", quoted(plain), ") leads out of the model's own folder");

    // Links may lead anywhere below the folder, but not out of it.
    std::error_code code;
    const Path root = fs::canonical(folder.empty() ? Path(".") : folder, code);
    if (code) fault(who, ".uri: the model's folder cannot be read");
    const Path target = fs::weakly_canonical(root / relative, code);
    if (code) fault(who, ".uri (", quoted(plain), ") cannot be read: ", code.message());
    const auto [rootEnd, common] = std::mismatch(root.begin(), root.end(), target.begin(), target.end());
    if (rootEnd != root.end()) fault(who, ".uri (", quoted(plain), ") leads out of the model's own folder");
    return target;
}

std::vector<uint8_t> readUri(Loading& loading, const std::string& uri, const std::string& who) {
    if (uri.starts_with("data:")) {
        const size_t comma = uri.find(',');
        const std::string_view head(uri.data(), comma == std::string::npos ? uri.size() : comma);
        if (comma == std::string::npos) fault(who, ".uri is a data URI without data");
        const std::string_view body = std::string_view(uri).substr(comma + 1);
        Loading::spend(loading.bytes, body.size(), loading.limits.maxTotalBytes, who, "bytes");
        if (head.ends_with(";base64")) return decodeBase64(body, who);
        const std::string plain = percentDecoded(body);
        return {plain.begin(), plain.end()};
    }
    const Path target = confined(loading.file.parent_path(), uri, who);
    std::error_code code;
    const uint64_t size = std::filesystem::file_size(target, code);
    if (!code) {
        if (size > loading.limits.maxFileBytes)
            fault(who, ".uri (", quoted(uri), ") is larger than the limit of ", loading.limits.maxFileBytes,
                  " bytes");
        Loading::spend(loading.bytes, size, loading.limits.maxTotalBytes, who, "bytes");
    }
    auto bytes = readFile(target, loading.limits.maxFileBytes);
    if (!bytes) fault(who, ".uri (", quoted(uri), "): ", bytes.error().reason);
    return std::move(*bytes);
}

} // namespace shoal::scene
