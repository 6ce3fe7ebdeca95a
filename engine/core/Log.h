// Writes one-line messages to standard error, from any thread. Formats are fmt's. The header does not include
// spdlog, which takes seconds to compile.
#pragma once

#include <fmt/core.h>

#include <mutex>

namespace shoal::log {

enum class Level { Debug = 1, Info, Warning, Error }; // values of spdlog::level::level_enum

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
// Messages of this logger are still written. A second thread waits until the first one's object is destroyed.
class QuietStandardError {
  public:
    QuietStandardError();
    ~QuietStandardError();

  private:
    std::unique_lock<std::mutex> lock_;
    int original_; // file descriptor of standard error before; -1: it could not be duplicated
};

} // namespace shoal::log
