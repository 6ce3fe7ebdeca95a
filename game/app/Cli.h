// The command line: the one place where options are named, explained and bounded.
#pragma once

namespace shoal::app {

// Parses, runs the command and returns the exit status: 0 good, 1 the command failed or an expectation was
// not met, 2 the command line was wrong.
int run(int argc, char** argv);

} // namespace shoal::app
