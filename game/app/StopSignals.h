// SIGINT, SIGTERM and SIGHUP ask the program to shut down cleanly: it first writes its files.
#pragma once

#include <csignal>

namespace shoal::app {

// The signal that came, 0: none. The program's exit status is then 128 more, as shells have it. The signal
// handler may touch only this.
inline volatile std::sig_atomic_t stopSignal = 0;

// Makes these signals set stopSignal from now on; a second one of a kind ends the program at once.
inline void noteStopSignals() {
    struct sigaction action {};
    action.sa_handler = [](int signal) { stopSignal = signal; };
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr); // nohup has them ignored
    }
}

} // namespace shoal::app
