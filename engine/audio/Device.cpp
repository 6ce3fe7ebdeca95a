#include "engine/audio/Device.h"

#include "engine/audio/Audio.h"

#include <array>
#include <cassert>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

namespace shoal::audio {

namespace {

template <class Function> Function alcFunction(const char* name) {
    return reinterpret_cast<Function>(alcGetProcAddress(nullptr, name));
}

// Sound libraries below OpenAL write pages about a missing sound card straight to standard error; the caller
// says it in one sentence instead. Only while a device is opened.
class QuietStandardError {
  public:
    QuietStandardError() : kept_(::dup(STDERR_FILENO)) {
        if (const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0) {
            ::dup2(nowhere, STDERR_FILENO);
            ::close(nowhere);
        }
    }
    ~QuietStandardError() {
        if (kept_ < 0) return;
        ::dup2(kept_, STDERR_FILENO);
        ::close(kept_);
    }
    QuietStandardError(const QuietStandardError&) = delete;
    QuietStandardError& operator=(const QuietStandardError&) = delete;

  private:
    int kept_;
};

} // namespace

Device::Device(Device&& other) noexcept { *this = std::move(other); }

Device& Device::operator=(Device&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(context_, other.context_);
    renderSamples_ = other.renderSamples_;
    getInteger64v_ = other.getInteger64v_;
    return *this;
}

Device::~Device() {
    if (context_ && alcGetCurrentContext() == context_) alcMakeContextCurrent(nullptr);
    if (context_) alcDestroyContext(context_);
    if (device_) alcCloseDevice(device_);
}

Result<Device> Device::open(bool loopback, bool headphones) {
    const QuietStandardError quiet;
    Device made;
    if (loopback) {
        const auto openLoopback = alcFunction<LPALCLOOPBACKOPENDEVICESOFT>("alcLoopbackOpenDeviceSOFT");
        made.renderSamples_ = alcFunction<LPALCRENDERSAMPLESSOFT>("alcRenderSamplesSOFT");
        if (!openLoopback || !made.renderSamples_) return Error{"", "this OpenAL cannot render to memory"};
        made.device_ = openLoopback(nullptr);
    } else {
        made.device_ = alcOpenDevice(nullptr);
    }
    if (!made.device_) return Error{"", "there is no sound device"};
    const ALCint hrtf = headphones ? ALC_TRUE : ALC_FALSE;
    const std::array<ALCint, 9> memory = {ALC_FORMAT_CHANNELS_SOFT,
                                          ALC_STEREO_SOFT,
                                          ALC_FORMAT_TYPE_SOFT,
                                          ALC_FLOAT_SOFT,
                                          ALC_FREQUENCY,
                                          kLoopbackRate_Hz,
                                          ALC_HRTF_SOFT,
                                          hrtf,
                                          0};
    const std::array<ALCint, 3> live = {ALC_HRTF_SOFT, hrtf, 0};
    made.context_ = alcCreateContext(made.device_, loopback ? memory.data() : live.data());
    if (!made.context_) return Error{"", "the sound device could not be set up"};
    if (alcIsExtensionPresent(made.device_, "ALC_SOFT_device_clock"))
        made.getInteger64v_ = alcFunction<LPALCGETINTEGER64VSOFT>("alcGetInteger64vSOFT");
    return made;
}

void Device::makeCurrent() const {
    if (context_ && alcGetCurrentContext() != context_) alcMakeContextCurrent(context_);
}

bool Device::connected() const {
    if (!device_) return false;
    ALCint connected = ALC_TRUE; // and stays so where OpenAL cannot tell
    if (alcIsExtensionPresent(device_, "ALC_EXT_disconnect"))
        alcGetIntegerv(device_, ALC_CONNECTED, 1, &connected);
    return connected != ALC_FALSE;
}

bool Device::headphones() const {
    ALCint on = ALC_FALSE;
    if (device_) alcGetIntegerv(device_, ALC_HRTF_SOFT, 1, &on);
    return on != ALC_FALSE;
}

double Device::played_s() const {
    if (!getInteger64v_) return 0;
    ALCint64SOFT clock_ns = 0;
    getInteger64v_(device_, ALC_DEVICE_CLOCK_SOFT, 1, &clock_ns);
    return static_cast<double>(clock_ns) * 1e-9;
}

void Device::render(std::span<float> stereo) {
    assert(renderSamples_ && stereo.size() % 2 == 0);
    renderSamples_(device_, stereo.data(), static_cast<ALCsizei>(stereo.size() / 2));
}

std::vector<std::string> listOutputs() {
    std::vector<std::string> names;
    const ALCchar* list = alcGetString(nullptr, ALC_ALL_DEVICES_SPECIFIER);
    while (list && *list) {
        names.emplace_back(list);
        list += names.back().size() + 1;
    }
    return names;
}

} // namespace shoal::audio
