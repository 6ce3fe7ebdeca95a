// Formatting of a string as by printf.
#pragma once

#include <string>

namespace shoal::bench {

// At most 4000 characters.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

} // namespace shoal::bench
