#include "engine/core/Log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace shoal::log {

namespace {

spdlog::level::level_enum spdlogLevel(Level level) {
    switch (level) {
    case Level::Debug:
        return spdlog::level::debug;
    case Level::Info:
        return spdlog::level::info;
    case Level::Warning:
        return spdlog::level::warn;
    case Level::Error:
        return spdlog::level::err;
    }
    return spdlog::level::err;
}

} // namespace

void write(Level level, fmt::string_view format, fmt::format_args arguments) {
    const spdlog::level::level_enum at = spdlogLevel(level);
    if (spdlog::should_log(at)) spdlog::log(at, fmt::vformat(format, arguments));
}

void setUp(bool verbose) {
    auto logger =
        std::make_shared<spdlog::logger>("shoal", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    logger->set_pattern(verbose ? "%n: [%o ms] %l: %v" : "%n: %v");
    logger->set_level(verbose ? spdlog::level::debug : spdlog::level::info);
    spdlog::set_default_logger(std::move(logger));
}

} // namespace shoal::log
