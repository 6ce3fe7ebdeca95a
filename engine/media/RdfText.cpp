#include "engine/media/RdfText.h"

#include <charconv>
#include <cmath>

namespace shoal::media {

std::optional<std::string_view> rdfValue(std::string_view text, std::string_view name) {
    constexpr std::string_view kSpace = " \t\r\n";
    for (size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
        size_t begin = text.find_first_not_of(kSpace, at + name.size());
        if (begin == text.npos) return std::nullopt;
        char close = 0;
        if (text[begin] == '>' && at > 0 && text[at - 1] == '<') {
            close = '<';
            ++begin;
        } else if (text[begin] == '=') {
            begin = text.find_first_not_of(kSpace, begin + 1);
            if (begin == text.npos || (text[begin] != '"' && text[begin] != '\'')) continue;
            close = text[begin++];
        } else {
            continue; // a closing tag, or a longer name
        }
        const std::string_view window = text.substr(begin, 65);
        const size_t length = window.find(close);
        if (length == window.npos) return std::nullopt;
        const std::string_view value = window.substr(0, length);
        const size_t first = value.find_first_not_of(kSpace);
        if (first == value.npos) return std::string_view{};
        return value.substr(first, value.find_last_not_of(kSpace) - first + 1);
    }
    return std::nullopt;
}

std::optional<double> rdfNumber(std::string_view text, std::string_view name) {
    const auto value = rdfValue(text, name);
    if (!value) return std::nullopt;
    double number = 0;
    const auto [end, code] = std::from_chars(value->data(), value->data() + value->size(), number);
    if (code != std::errc{} || !std::isfinite(number)) return std::nullopt;
    return number;
}

} // namespace shoal::media
