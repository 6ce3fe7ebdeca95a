#include "engine/core/Log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace shoal::log {

void write(Level level, fmt::string_view format, fmt::format_args arguments) {
    constexpr spdlog::level::level_enum kLevels[] = {spdlog::level::debug, spdlog::level::info,
                                                     spdlog::level::warn, spdlog::level::err}; // by Level
    const spdlog::level::level_enum at = kLevels[static_cast<size_t>(level)];
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
