#include "input/haptics/ForceFeedback.h"

#include "input/haptics/DeviceFolder.h"
#include "input/haptics/DeviceTable.h"

#include <fcntl.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

namespace shoal::haptics {

namespace {

namespace fs = std::filesystem;

constexpr int kFirstHandle = 1 << 16; // below are those of the bus behind
constexpr uint16_t kPlay_ms = 1000;   // it is written again before; a program that hangs is felt no longer

class EventNode {
  public:
    explicit EventNode(const std::string& path)
        : fd_(::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)), path_(path) {}
    ~EventNode() {
        if (fd_ >= 0) ::close(fd_);
    }
    EventNode(const EventNode&) = delete;
    EventNode& operator=(const EventNode&) = delete;

    bool isOpen() const { return fd_ >= 0; }

    bool rumbles() const { return has<EV_FF, FF_MAX>(FF_RUMBLE) && has<EV_KEY, KEY_MAX>(BTN_GAMEPAD); }

    HidInfo info() const {
        input_id id{};
        std::array<char, 128> name{};
        ::ioctl(fd_, EVIOCGID, &id);
        ::ioctl(fd_, EVIOCGNAME(name.size() - 1), name.data());
        for (char& c : name)
            if (c && (c < ' ' || c > '~')) c = '?';
        std::error_code none;
        const fs::path input = fs::path("/sys/class/input") / fs::path(path_).filename() / "device/device";
        return {path_,       id.vendor,
                id.product,  Transport::ForceFeedback,
                name.data(), fs::canonical(input, none).string()};
    }

    bool play(uint16_t strong, uint16_t weak) {
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
        input_event event{};
        event.type = EV_FF;
        event.code = static_cast<uint16_t>(effect_);
        event.value = stop ? 0 : 1;
        return ::write(fd_, &event, sizeof event) == sizeof event;
    }

  private:
    // Whether the device has this code among its events of the type.
    template <int kType, int kMax> bool has(int code) const {
        std::array<uint8_t, kMax / 8 + 1> bits{};
        return ::ioctl(fd_, EVIOCGBIT(kType, bits.size()), bits.data()) >= 0 &&
               (bits[static_cast<size_t>(code / 8)] >> (code % 8) & 1);
    }

    int fd_;
    std::string path_;
    int16_t effect_ = -1; // in the device; -1: none yet
};

struct EventNodes {
    DeviceFolder folder{"/dev/input"};
    std::vector<HidInfo> found;
    std::vector<std::unique_ptr<EventNode>> opened; // by handle; null: closed

    EventNode& at(int handle) { return *opened[static_cast<size_t>(handle - kFirstHandle)]; }

    void list() {
        found.clear();
        std::error_code none;
        for (const fs::directory_entry& entry : fs::directory_iterator("/dev/input", none)) {
            if (!entry.path().filename().string().starts_with("event")) continue;
            const EventNode node(entry.path().string());
            if (node.isOpen() && node.rumbles()) found.push_back(node.info());
        }
    }
    Result<int> open(const std::string& path) {
        auto node = std::make_unique<EventNode>(path);
        if (!node->isOpen()) return Error{path, "may not be opened"};
        auto free = std::find(opened.begin(), opened.end(), nullptr);
        if (free == opened.end()) free = opened.emplace(free);
        *free = std::move(node);
        return kFirstHandle + static_cast<int>(free - opened.begin());
    }
};

uint16_t scaled16(float amplitude) { return static_cast<uint16_t>(std::lround(driveOf(amplitude) * 65535)); }

} // namespace

Driver makeForceFeedback(const DeviceContext&) {
    return {.encode = [](const HapticFrame& frame) {
        const Motors motors = motorsOf(frame);
        const uint16_t strong = scaled16(motors.strong), weak = scaled16(motors.weak);
        Report report{.size = 4};
        report.bytes[0] = static_cast<uint8_t>(strong);
        report.bytes[1] = static_cast<uint8_t>(strong >> 8);
        report.bytes[2] = static_cast<uint8_t>(weak);
        report.bytes[3] = static_cast<uint8_t>(weak >> 8);
        return report;
    }};
}

HidBus withForceFeedback(HidBus bus) {
    auto nodes = std::make_shared<EventNodes>();
    HidBus both = bus;
    both.list = [nodes, bus] {
        std::vector<HidInfo> all = bus.list();
        if (nodes->folder.mayHaveChanged()) nodes->list();
        all.insert(all.end(), nodes->found.begin(), nodes->found.end());
        return all;
    };
    both.open = [nodes, bus](const std::string& path) {
        return path.starts_with("/dev/input/") ? nodes->open(path) : bus.open(path);
    };
    both.write = [nodes, bus](int handle, std::span<const uint8_t> report) {
        if (handle < kFirstHandle) return bus.write(handle, report);
        const auto word = [&](size_t at) { return static_cast<uint16_t>(report[at] | report[at + 1] << 8); };
        return report.size() == 4 && nodes->at(handle).play(word(0), word(2));
    };
    both.readFeature = [bus](int handle, std::span<uint8_t> report) -> size_t {
        return handle < kFirstHandle ? bus.readFeature(handle, report) : 0;
    };
    both.guard = [bus](int handle, std::span<const uint8_t> stop) {
        if (handle < kFirstHandle) bus.guard(handle, stop);
    };
    both.close = [nodes, bus](int handle) {
        if (handle < kFirstHandle) return bus.close(handle);
        nodes->opened[static_cast<size_t>(handle - kFirstHandle)].reset();
    };
    return both;
}

} // namespace shoal::haptics
