#include "input/haptics/HidBus.h"

#include <fcntl.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <utility>

namespace shoal::haptics {

namespace {

namespace fs = std::filesystem;

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
        std::error_code none;
        const fs::path input = fs::path("/sys/class/input") / fs::path(path_).filename() / "device/device";
        return {path_,       id.vendor,
                id.product,  Transport::ForceFeedback,
                name.data(), fs::canonical(input, none).string()};
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
        input_event event{};
        event.type = EV_FF;
        event.code = static_cast<uint16_t>(effect_);
        event.value = stop ? 0 : 1;
        return ::write(fd_, &event, sizeof event) == sizeof event;
    }

  private:
    // Returns whether the device has this code among its events of the type.
    template <int kType, int kMax> bool has(int code) const {
        std::array<uint8_t, kMax / 8 + 1> bits{};
        return ::ioctl(fd_, EVIOCGBIT(kType, bits.size()), bits.data()) >= 0 &&
               (bits[static_cast<size_t>(code / 8)] >> (code % 8) & 1);
    }

    int fd_;
    std::string path_;
    int16_t effect_ = -1; // in the device; -1: none yet
};

} // namespace

HidBus withForceFeedback(HidBus bus) {
    struct Nodes {
        DeviceFolder folder{"/dev/input"};
        std::vector<HidInfo> found;
    };
    const auto list = [nodes = std::make_shared<Nodes>(), other = bus.list] {
        std::error_code none;
        if (nodes->folder.mayHaveChanged()) {
            nodes->found.clear();
            for (const fs::directory_entry& entry : fs::directory_iterator("/dev/input", none)) {
                if (!entry.path().filename().string().starts_with("event")) continue;
                const EventNode node(entry.path().string());
                if (node.isOpen() && node.rumbles()) nodes->found.push_back(node.info());
            }
        }
        std::vector<HidInfo> all = other();
        all.insert(all.end(), nodes->found.begin(), nodes->found.end());
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
