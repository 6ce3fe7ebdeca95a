// The command line of the program, generated from the tables of settings.
#pragma once

namespace shoal::app {

// Parses, runs the command and returns the exit status: 0 success, 1 the command failed or an expectation was
// not met, 2 the command line was wrong.
int run(int argc, char** argv);

} // namespace shoal::app
