// Where sound goes: a device of this machine, or memory. Internal to this room.
#pragma once

#include "engine/core/Result.h"

#include <AL/alc.h>
#include <AL/alext.h>

#include <span>
#include <string>
#include <vector>

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

    // OpenAL's calls go to the context that is current in the process; each call of Audio starts with this.
    void makeCurrent() const;

    // False once the device was pulled out.
    bool connected() const;

    bool headphones() const; // HRTF is on

    // Seconds of sound made so far, whether to a device or to memory; it stands still while nothing is made.
    double played_s() const;

    void render(std::span<float> stereo); // loopback only

  private:
    ALCdevice* device_ = nullptr;
    ALCcontext* context_ = nullptr;
    LPALCRENDERSAMPLESSOFT renderSamples_ = nullptr;
    LPALCGETINTEGER64VSOFT getInteger64v_ = nullptr;
};

// Names of the sound outputs; empty without any.
std::vector<std::string> outputNames();

} // namespace shoal::audio
