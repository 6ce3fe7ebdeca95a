// Detector of device nodes that came or went, so that a costly list of devices is made only then.
#pragma once

#include <chrono>
#include <filesystem>

namespace shoal::haptics {

class DeviceFolder {
  public:
    explicit DeviceFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // Returns whether a list that was made at the last call may be out of date; also for a while after a
    // change, because a device is not set up in one moment, and if the folder cannot be read.
    bool mayHaveChanged() {
        constexpr std::chrono::seconds kSettles{3};
        std::error_code code;
        const auto changed = std::filesystem::last_write_time(folder_, code);
        const auto now = std::filesystem::file_time_type::clock::now();
        if (!code && listed_ > changed + kSettles && listed_ <= now) return false;
        listed_ = now;
        return true;
    }

  private:
    std::filesystem::path folder_;
    std::filesystem::file_time_type listed_ = std::filesystem::file_time_type::min();
};

} // namespace shoal::haptics
