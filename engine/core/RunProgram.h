// Runs another program until it ends. Any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace shoal {

// words: the program, found by PATH unless it has a slash, and its arguments. Returns its exit status; empty:
// it could not be started, or a signal ended it.
std::optional<int> runProgram(std::vector<std::string> words);

} // namespace shoal
