#include "game/settings/Setting.h"

#include <cstdio>

namespace shoal::app {

TextSetting sizeSetting(glm::ivec2& pixels) {
    const auto set = [&pixels](const std::string& text) {
        int width = 0, height = 0, end = 0;
        if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &end) != 2 ||
            static_cast<size_t>(end) != text.size() || width < 16 || height < 16 || width > 8192 ||
            height > 8192)
            return false;
        pixels = {width, height};
        return true;
    };
    return {set, "wants WIDTHxHEIGHT in pixels, 16x16 to 8192x8192", {}};
}

TextSetting addressSetting(std::string& host, uint16_t& port) {
    const auto set = [&host, &port](const std::string& text) {
        const size_t colon = text.rfind(':');
        int number = 0, end = 0;
        if (colon == std::string::npos || colon == 0 ||
            std::sscanf(text.c_str() + colon, ":%d%n", &number, &end) != 1 ||
            colon + static_cast<size_t>(end) != text.size() || number < 1 || number > 65535)
            return false;
        host = text.substr(0, colon);
        port = static_cast<uint16_t>(number);
        return true;
    };
    return {set, "wants HOST:PORT", [&host, &port] { return host + ":" + std::to_string(port); }};
}

TextSetting vectorSetting(std::optional<glm::vec3>& value) {
    const auto set = [&value](const std::string& text) {
        glm::vec3 v{0};
        int end = 0;
        if (std::sscanf(text.c_str(), "%f,%f,%f%n", &v.x, &v.y, &v.z, &end) != 3 ||
            static_cast<size_t>(end) != text.size())
            return false;
        value = v;
        return true;
    };
    return {set, "wants three numbers with commas between", {}};
}

std::string Setting::key() const {
    for (const char* prefix : {"!--no-", "--"})
        if (option.starts_with(prefix)) return option.substr(std::string(prefix).size());
    return option;
}

} // namespace shoal::app
