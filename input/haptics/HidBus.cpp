#include "input/haptics/HidBus.h"

#include <fmt/core.h>
#include <hidapi/hidapi.h>

#include <algorithm>
#include <fcntl.h>
#include <optional>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace shoal::haptics {

namespace {

namespace fs = std::filesystem;

class HidapiDevice final : public HidDevice {
  public:
    HidapiDevice(const std::string& path, hid_device* device) : path_(path), device_(device, hid_close) {}
    bool write(std::span<const uint8_t> report) override {
        return hid_write(device_.get(), report.data(), report.size()) >= 0;
    }
    size_t readFeature(std::span<uint8_t> report) override {
        const int got = hid_get_feature_report(device_.get(), report.data(), report.size());
        return got > 0 ? static_cast<size_t>(got) : 0;
    }
    void stopAtCrash(std::span<const uint8_t> stop) override { crashStop_.emplace(path_, stop); }

  private:
    std::string path_;
    std::unique_ptr<hid_device, decltype(&hid_close)> device_;
    std::optional<CrashStop> crashStop_;
};

// Returns HidInfo::device of a path, for which hidapi 0.13 has no call.
std::string deviceOf(const std::string& path) {
    std::error_code none;
    return fs::canonical(fs::path("/sys/class/hidraw") / fs::path(path).filename() / "device", none).string();
}

struct Hidapi {
    std::vector<HidInfo> found;
    DeviceFolder folder{"/dev"};

    Hidapi() { hid_init(); }
    ~Hidapi() { hid_exit(); }

    void list() {
        found.clear();
        hid_device_info* first = hid_enumerate(0, 0);
        for (const hid_device_info* info = first; info; info = info->next) {
            if (!info->path || std::any_of(found.begin(), found.end(), [&](const HidInfo& other) {
                    return other.path == info->path; // one entry for each usage of a device
                }))
                continue;
            std::string name;
            for (const wchar_t* c = info->product_string; c && *c; ++c)
                name += *c > 31 && *c < 127 ? static_cast<char>(*c) : '?';
            found.push_back({info->path, info->vendor_id, info->product_id,
                             info->bus_type == HID_API_BUS_USB         ? Transport::Usb
                             : info->bus_type == HID_API_BUS_BLUETOOTH ? Transport::Bluetooth
                                                                       : Transport::Any,
                             std::move(name), deviceOf(info->path), info->usage_page, info->usage});
        }
        hid_free_enumeration(first);
    }
};

} // namespace

HidBus hidapiBus() {
    auto hidapi = std::make_shared<Hidapi>();
    HidBus bus;
    bus.list = [hidapi] {
        if (hidapi->folder.mayHaveChanged()) hidapi->list();
        return hidapi->found;
    };
    bus.open = [hidapi](const std::string& path) -> std::unique_ptr<HidDevice> {
        hid_device* device = hid_open_path(path.c_str());
        return device ? std::make_unique<HidapiDevice>(path, device) : nullptr;
    };
    return bus;
}

// The shell waits for a line from a pipe. The destructor sends one; if the process dies, the pipe closes
// without a line. Signals that end the program may also reach the shell, so it ignores them.
CrashStop::CrashStop(const std::string& file, std::span<const uint8_t> stop) {
    constexpr const char* kScript =
        R"(trap '' HUP INT QUIT TERM; read -r line || printf "$1" 2>/dev/null >"$0")";
    std::string octal;
    for (const uint8_t byte : stop) octal += fmt::format("\\{:03o}", byte);
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    const char* arguments[] = {"sh", "-c", kScript, file.c_str(), octal.c_str(), nullptr};
    if (posix_spawn(&shell_, "/bin/sh", &actions, nullptr, const_cast<char**>(arguments), environ) != 0)
        shell_ = -1;
    posix_spawn_file_actions_destroy(&actions);
    close(ends[0]);
    pipe_ = ends[1];
}

CrashStop::~CrashStop() {
    if (shell_ > 0 && write(pipe_, "\n", 1) == 1) waitpid(shell_, nullptr, 0);
    if (pipe_ >= 0) close(pipe_);
}

} // namespace shoal::haptics
