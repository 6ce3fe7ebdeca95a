// A helper process that stops a device's motors when the program dies, however it dies.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <sys/types.h>

namespace shoal::haptics {

class CrashStop {
  public:
    // Starts a shell that writes the report to the device's file when this process has ended, unless this
    // object was destroyed before. Without a shell nothing is guarded.
    CrashStop(const std::string& file, std::span<const uint8_t> stop);
    ~CrashStop();
    CrashStop(const CrashStop&) = delete;
    CrashStop& operator=(const CrashStop&) = delete;

  private:
    int pipe_ = -1;
    pid_t shell_ = -1;
};

} // namespace shoal::haptics
