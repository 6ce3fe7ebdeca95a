#include "engine/core/Log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace shoal::log {

void write(Level level, fmt::string_view format, fmt::format_args arguments) {
    const auto at = static_cast<spdlog::level::level_enum>(level);
    if (spdlog::should_log(at)) spdlog::log(at, fmt::vformat(format, arguments));
}

void setUp(bool verbose) {
    // The logger writes to its own copy of the descriptor, which QuietStandardError does not redirect.
    std::FILE* file = ::fdopen(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1), "w");
    using Sink = spdlog::sinks::stdout_sink_base<spdlog::details::console_mutex>;
    const auto close = [file](Sink* sink) {
        delete sink;
        if (file) std::fclose(file);
    };
    auto logger = std::make_shared<spdlog::logger>(
        "shoal", std::shared_ptr<Sink>(new Sink(file ? file : stderr), close));
    logger->set_pattern(verbose ? "%n: [%o ms] %l: %v" : "%n: %v");
    logger->set_level(verbose ? spdlog::level::debug : spdlog::level::info);
    spdlog::set_default_logger(std::move(logger));
}

static std::mutex quietMutex;

QuietStandardError::QuietStandardError() : lock_(quietMutex), original_(::dup(STDERR_FILENO)) {
    if (original_ < 0) return; // it could not be restored
    if (const int devNull = ::open("/dev/null", O_WRONLY | O_CLOEXEC); devNull >= 0) {
        ::dup2(devNull, STDERR_FILENO);
        ::close(devNull);
    }
}

QuietStandardError::~QuietStandardError() {
    if (original_ < 0) return;
    ::dup2(original_, STDERR_FILENO);
    ::close(original_);
}

} // namespace shoal::log
