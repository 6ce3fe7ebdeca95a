#include "game/settings/Setting.h"

namespace shoal::app {

namespace {

// Sets a vector from kCount numbers with a character between them, or changes nothing and returns false.
template <int kCount, class Vector, class T>
bool setVector(Vector& value, std::string_view text, char between, T low, T high) {
    glm::vec<kCount, T> read(0);
    for (int i = 0; i < kCount; ++i) {
        const size_t end = i + 1 < kCount ? text.find(between) : text.size();
        const auto number = parseNumber(text.substr(0, end), low, high);
        if (!number || end > text.size()) return false;
        read[i] = *number;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    value = read;
    return true;
}

} // namespace

TextSetting sizeSetting(glm::ivec2& pixels) {
    const auto set = [&](const std::string& text) { return setVector<2>(pixels, text, 'x', 16, 8192); };
    return {set, "wants WIDTHxHEIGHT in pixels, 16x16 to 8192x8192", {}};
}

TextSetting addressSetting(std::string& host, uint16_t& port) {
    const auto set = [&host, &port](const std::string& text) {
        const size_t colon = text.rfind(':');
        const auto number = parseNumber<uint16_t>(text.substr(colon + 1), 1);
        if (!number || colon == std::string::npos || colon == 0) return false;
        host = text.substr(0, colon);
        port = *number;
        return true;
    };
    return {set, "wants HOST:PORT", [&host, &port] { return host + ":" + std::to_string(port); }};
}

TextSetting vectorSetting(std::optional<glm::vec3>& value) {
    const auto set = [&](const std::string& text) { return setVector<3>(value, text, ',', -1e6f, 1e6f); };
    return {set, "wants three numbers from -1000000 to 1000000 with commas between", {}};
}

std::string Setting::key() const {
    for (const char* prefix : {"!--no-", "--"})
        if (option.starts_with(prefix)) return option.substr(std::string(prefix).size());
    return option;
}

} // namespace shoal::app
