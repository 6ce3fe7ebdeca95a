#include "engine/core/Log.h"

#include <spdlog/sinks/stdout_sinks.h>

namespace shoal::log {

void setUp(bool verbose) {
    auto logger =
        std::make_shared<spdlog::logger>("shoal", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    logger->set_pattern(verbose ? "%n: [%o ms] %l: %v" : "%n: %v");
    logger->set_level(verbose ? spdlog::level::debug : spdlog::level::info);
    spdlog::set_default_logger(std::move(logger));
}

} // namespace shoal::log
