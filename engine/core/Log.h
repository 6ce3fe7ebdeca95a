// One-line messages on standard error. Any thread. Formats are fmt's; spdlog itself stays out of this header,
// because it takes seconds to compile.
#pragma once

#include <fmt/core.h>

#include <mutex>

namespace shoal::log {

enum class Level { Debug = 1, Info, Warning, Error }; // as spdlog has them

void write(Level level, fmt::string_view format, fmt::format_args arguments);

template <class... T> void debug(fmt::format_string<T...> format, T&&... arguments) {
    write(Level::Debug, format, fmt::make_format_args(arguments...));
}
template <class... T> void info(fmt::format_string<T...> format, T&&... arguments) {
    write(Level::Info, format, fmt::make_format_args(arguments...));
}
template <class... T> void warn(fmt::format_string<T...> format, T&&... arguments) {
    write(Level::Warning, format, fmt::make_format_args(arguments...));
}
template <class... T> void error(fmt::format_string<T...> format, T&&... arguments) {
    write(Level::Error, format, fmt::make_format_args(arguments...));
}

// Prefixes each line with "shoal: "; debug lines are written only when verbose.
void setUp(bool verbose);

// Silences standard error during its lifetime, because libraries write there regardless of their log levels.
// Our own messages are still written. One thread at a time; others wait.
class QuietStandardError {
  public:
    QuietStandardError();
    ~QuietStandardError();

  private:
    std::unique_lock<std::mutex> turn_;
    int kept_; // file descriptor
};

} // namespace shoal::log
