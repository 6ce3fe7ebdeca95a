// Runs another program until it ends. Any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace shoal {

// Runs a program and returns its exit status; empty if it could not be started, or a signal ended it. words:
// the program, found by PATH unless it has a slash, and its arguments.
std::optional<int> runProgram(std::vector<std::string> words);

} // namespace shoal
