// Messages to a person, on standard error. Set up once in main; usable from every thread.
#pragma once

#include <spdlog/spdlog.h>

namespace shoal::log {

using spdlog::debug;
using spdlog::error;
using spdlog::info;
using spdlog::warn;

// One plain line a message on standard error, prefixed "shoal: "; debug lines only when verbose.
void setUp(bool verbose);

} // namespace shoal::log
