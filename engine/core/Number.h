// Numbers from outside: texts, and values that a library has read of a file. NaN and infinities are none.
#pragma once

#include <charconv>
#include <limits>
#include <optional>
#include <string_view>

namespace shoal {

// False for NaN.
template <class T> bool isWithin(T number, T low, T high) { return number >= low && number <= high; }

// Returns the decimal number that the whole text is; empty where it is none, or T cannot hold it.
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
