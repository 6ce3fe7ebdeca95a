// SIGINT, SIGTERM and SIGHUP ask the program to end in order: it first writes its files.
#pragma once

namespace shoal::app {

// Notes these signals from now on instead of ending; a second one of a kind ends the program at once.
void noteStopSignals();

// Returns the signal that came, 0: none. The program's exit status is then 128 more, as shells have it.
int stopSignal();

} // namespace shoal::app
