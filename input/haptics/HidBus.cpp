#include "input/haptics/HidBus.h"

#include <fmt/core.h>
#include <hidapi/hidapi.h>

#include <algorithm>
#include <array>
#include <fcntl.h>
#include <filesystem>
#include <linux/input.h>
#include <optional>
#include <sys/ioctl.h>
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

// Returns HidInfo::device of a node, as hidapi 0.13 cannot. folder: the class folder in /sys that has an
// entry for the node; link: relative path from that entry to the device.
std::string deviceOf(const char* folder, const std::string& node, const char* link) {
    std::error_code none;
    return fs::canonical(fs::path(folder) / fs::path(node).filename() / link, none).string();
}

std::vector<HidInfo> findHidDevices() {
    std::vector<HidInfo> found;
    hid_device_info* first = hid_enumerate(0, 0);
    for (const hid_device_info* info = first; info; info = info->next) {
        if (!info->path || std::ranges::find(found, info->path, &HidInfo::path) != found.end())
            continue; // one entry for each usage of a device
        std::string name;
        for (const wchar_t* c = info->product_string; c && *c; ++c)
            name += *c > 31 && *c < 127 ? static_cast<char>(*c) : '?';
        found.push_back({info->path, info->vendor_id, info->product_id,
                         info->bus_type == HID_API_BUS_USB         ? Transport::Usb
                         : info->bus_type == HID_API_BUS_BLUETOOTH ? Transport::Bluetooth
                                                                   : Transport::Any,
                         std::move(name), deviceOf("/sys/class/hidraw", info->path, "device"),
                         info->usage_page, info->usage});
    }
    hid_free_enumeration(first);
    return found;
}

constexpr uint16_t kPlay_ms = 1000; // an effect ends by itself, unless it is written again before

class EventNode final : public HidDevice {
  public:
    explicit EventNode(const std::string& path)
        : fd_(::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)), path_(path) {}
    ~EventNode() override {
        if (fd_ >= 0) ::close(fd_);
    }

    bool isOpen() const { return fd_ >= 0; }

    bool rumbles() const { return has<EV_FF, FF_MAX>(FF_RUMBLE) && has<EV_KEY, KEY_MAX>(BTN_GAMEPAD); }

    HidInfo info() const {
        input_id id{};
        std::array<char, 128> name{};
        ::ioctl(fd_, EVIOCGID, &id);
        ::ioctl(fd_, EVIOCGNAME(name.size() - 1), name.data());
        for (char& c : name)
            if (c && (c < ' ' || c > '~')) c = '?';
        return {.path = path_,
                .vendor = id.vendor,
                .product = id.product,
                .transport = Transport::ForceFeedback,
                .name = name.data(),
                .device = deviceOf("/sys/class/input", path_, "device/device")};
    }

    bool write(std::span<const uint8_t> report) override {
        const auto word = [&](size_t at) { return static_cast<uint16_t>(report[at] | report[at + 1] << 8); };
        const uint16_t strong = word(0), weak = word(2);
        const bool stop = strong == 0 && weak == 0;
        if (stop && effect_ < 0) return true;
        if (!stop) {
            ff_effect effect{};
            effect.type = FF_RUMBLE;
            effect.id = effect_;
            effect.replay.length = kPlay_ms;
            effect.u.rumble.strong_magnitude = strong;
            effect.u.rumble.weak_magnitude = weak;
            if (::ioctl(fd_, EVIOCSFF, &effect) < 0) return false;
            effect_ = effect.id;
        }
        const input_event event{.type = EV_FF, .code = static_cast<uint16_t>(effect_), .value = stop ? 0 : 1};
        return ::write(fd_, &event, sizeof event) == sizeof event;
    }

  private:
    // Returns whether the device has this code among its events of the type.
    template <int kType, int kMax> bool has(int code) const {
        std::array<uint8_t, kMax / 8 + 1> bits{};
        return ::ioctl(fd_, EVIOCGBIT(kType, bits.size()), bits.data()) >= 0 &&
               (bits[code / 8] >> (code % 8) & 1);
    }

    int fd_;
    std::string path_;
    int16_t effect_ = -1; // in the device; -1: none yet
};

std::vector<HidInfo> findRumblingPads() {
    std::vector<HidInfo> found;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator("/dev/input", none)) {
        if (!entry.path().filename().string().starts_with("event")) continue;
        if (const EventNode node(entry.path().string()); node.rumbles()) found.push_back(node.info());
    }
    return found;
}

} // namespace

HidBus hidapiBus() {
    const auto open = [](const std::string& path) -> std::unique_ptr<HidDevice> {
        hid_device* device = hid_open_path(path.c_str());
        return device ? std::make_unique<HidapiDevice>(path, device) : nullptr;
    };
    return {findHidDevices, open};
}

// The shell waits for a line from a pipe. The destructor sends one; if the process dies, the pipe closes
// without a line. Signals that end the program may also reach the shell, so it ignores them.
CrashStop::CrashStop(const std::string& file, std::span<const uint8_t> stop) {
    std::string octal;
    for (const uint8_t byte : stop) octal += fmt::format("\\{:03o}", byte);
    const std::string script =
        fmt::format("trap '' HUP INT QUIT TERM; read -r line || printf '{}' 2>/dev/null >'{}'", octal, file);
    shell_.reset(popen(script.c_str(), "we")); // e: no other program inherits the pipe
}

HidBus withForceFeedback(HidBus bus) {
    const auto list = [other = bus.list] {
        std::vector<HidInfo> all = other();
        std::ranges::copy(findRumblingPads(), std::back_inserter(all));
        return all;
    };
    const auto open = [other = bus.open](const std::string& path) -> std::unique_ptr<HidDevice> {
        if (!path.starts_with("/dev/input/")) return other(path);
        auto node = std::make_unique<EventNode>(path);
        return node->isOpen() ? std::move(node) : nullptr;
    };
    return {list, open};
}

} // namespace shoal::haptics
