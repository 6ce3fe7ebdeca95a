// Sends known pulses through the real hidapi; run below umockdev, which compares every byte written and then
// sends one, which only arrives when all was written.
//   send_pulse COUNT         as many devices: a strong pulse left, a quick one right, silence
//   send_pulse COUNT SIGNAL  the first pulse alone, and then the program dies by that signal
//   send_pulse 0             says why the device is not let in
#include "input/haptics/HapticDevices.h"

#include <hidapi/hidapi.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace {

using namespace shoal::haptics;

HapticFrame frameOf(size_t actuator, float frequency_Hz) {
    HapticFrame frame;
    frame.actuators[actuator] = {1, frequency_Hz};
    return frame;
}

bool found(HapticDevices& hapticDevices, size_t count) {
    for (const std::string& warning : hapticDevices.takeWarnings())
        std::fprintf(stderr, "%s\n", warning.c_str());
    if (hapticDevices.ready() != count)
        std::fprintf(stderr, "%zu devices instead of %zu\n", hapticDevices.ready(), count);
    return hapticDevices.ready() == count;
}

bool pulses(size_t count) {
    HapticDevices hapticDevices(hidapiBus());
    hapticDevices.step(frameOf(0, 40), 0);
    if (!found(hapticDevices, count)) return false;
    hapticDevices.step(frameOf(0, 40), 0.03); // what was greeted at 0 waited
    hapticDevices.step(frameOf(7, 250), 0.07);
    hapticDevices.step({}, 0.11);
    return found(hapticDevices, count);
}

bool dies(size_t count, int signal) {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
        HapticDevices hapticDevices(hidapiBus());
        hapticDevices.step(frameOf(0, 40), 0);
        hapticDevices.step(frameOf(0, 40), 0.03);
        if (!found(hapticDevices, count)) _exit(1);
        if (signal == SIGABRT) std::abort();
        raise(signal);
        _exit(1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFSIGNALED(status) && WTERMSIG(status) == signal) return true;
    std::fprintf(stderr, "did not die by signal %d\n", signal);
    return false;
}

} // namespace

int main(int argc, char** argv) {
    const size_t count = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 1;
    std::vector<hid_device*> listening;
    std::string path;
    hid_device_info* all = hid_enumerate(0, 0);
    for (const hid_device_info* info = all; info && count > 0; info = info->next)
        if (path != info->path) listening.push_back(hid_open_path((path = info->path).c_str()));
    hid_free_enumeration(all);
    bool good = argc > 2 ? dies(count, std::atoi(argv[2])) : pulses(count);
    for (hid_device* device : listening) {
        unsigned char byte = 0;
        if (!device || hid_read_timeout(device, &byte, 1, 300000) != 1 || byte != 'K') {
            std::fprintf(stderr, "not all reports came\n");
            good = false;
        }
    }
    return good ? 0 : 1;
}
