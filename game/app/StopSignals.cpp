#include "game/app/StopSignals.h"

#include <csignal>

namespace shoal::app {

// The signal handler may touch only this.
static volatile std::sig_atomic_t came = 0;

void noteStopSignals() {
    struct sigaction action {};
    action.sa_handler = [](int signal) { came = signal; };
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr); // nohup has them ignored
    }
}

int stopSignal() { return came; }

} // namespace shoal::app
