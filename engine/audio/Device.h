// OpenAL output device, or loopback to memory. Internal to this folder.
#pragma once

#include "engine/core/Result.h"

#include <AL/alc.h>
#include <AL/alext.h>

#include <span>

namespace shoal::audio {

constexpr int kLoopbackRate_Hz = 48000;

class Device {
  public:
    static Result<Device> open(bool loopback, bool headphones);
    Device() = default; // none
    Device(Device&& other) noexcept;
    Device& operator=(Device&& other) noexcept;
    ~Device();

    explicit operator bool() const { return context_ != nullptr; }

    // OpenAL's context is global to the process; each method of Audio starts with this.
    void makeCurrent() const;

    // False once the device was unplugged.
    bool connected() const;

    bool headphones() const; // HRTF is on

    // Seconds of sound rendered so far, to a device or to memory.
    double played_s() const;

    void render(std::span<float> stereo); // loopback only

  private:
    ALCdevice* device_ = nullptr;
    ALCcontext* context_ = nullptr;
    LPALCRENDERSAMPLESSOFT renderSamples_ = nullptr;
    LPALCGETINTEGER64VSOFT getInteger64v_ = nullptr;
};

} // namespace shoal::audio
