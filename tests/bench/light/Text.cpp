#include "tests/bench/light/Text.h"

#include <cstdarg>
#include <cstdio>

namespace shoal::bench {

std::string text(const char* format, ...) {
    char buffer[4001];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(buffer, sizeof buffer, format, arguments);
    va_end(arguments);
    return buffer;
}

} // namespace shoal::bench
