// Checks numbers from texts and from files read by libraries. NaN and infinities do not count as numbers.
#pragma once

#include <charconv>
#include <limits>
#include <optional>
#include <string_view>

namespace shoal {

// False for NaN.
template <class T> bool isWithin(T number, T low, T high) { return number >= low && number <= high; }

// Parses the whole text as a decimal number; empty if it is not one, or not within low .. high.
template <class T>
std::optional<T> parseNumber(std::string_view text, T low = std::numeric_limits<T>::lowest(),
                             T high = std::numeric_limits<T>::max()) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    T number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool read = error == std::errc() && end == text.data() + text.size();
    return read && isWithin(number, low, high) ? std::optional(number) : std::nullopt;
}

} // namespace shoal
