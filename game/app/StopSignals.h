// SIGINT, SIGTERM and SIGHUP ask the program to end in order: what a session leaves is written first.
#pragma once

namespace shoal::app {

// From now on they are noted instead of ending the program; a second one of a kind ends it at once.
void noteStopSignals();

// The one that came; 0: none. The program's exit status is then 128 more, as shells have it.
int stopSignal();

} // namespace shoal::app
