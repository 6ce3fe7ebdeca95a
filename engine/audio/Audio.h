// Sounds in their places, heard through water. OpenAL Soft does the mixing on its own thread; these calls
// belong to one thread.
#pragma once

#include "engine/audio/Clip.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace shoal::audio {

struct AudioOptions {
    bool headphones = false; // HRTF
    bool loopback = false;   // renders to memory: render() below; no device is touched
    float volume = 1;        // 0 to 1
};

struct Listener {
    glm::vec3 position{0};
    glm::quat worldFromHead{1, 0, 0, 0}; // looks along -Z, +Y up
};

// A sound that goes on for as long as it is listed.
struct Emitter {
    uint32_t id = 0; // the same sound from one update to the next
    int clip = 0;
    glm::vec3 position{0};
    float gain = 1, pitch = 1;
    bool everywhere = false; // not placed: a bed
};

// A sound that starts now and ends by itself.
struct Shot {
    int clip = 0;
    glm::vec3 position{0};
    float gain = 1, pitch = 1;
    bool everywhere = false;
};

class Audio {
  public:
    // Fails where there is no sound device.
    static Result<Audio> open(const AudioOptions& options);
    Audio(Audio&&) noexcept;
    Audio& operator=(Audio&&) noexcept;
    ~Audio();

    // Index for Emitter::clip and Shot::clip, counted from 0 in the order of the calls.
    int add(const Clip& clip);

    // Starts, moves and ends sounds; more than kSources at once: the newest shots are left out.
    void update(const Listener& listener, std::span<const Emitter> emitters, std::span<const Shot> shots);
    static constexpr int kSources = 32;

    void setVolume(float volume); // 0 to 1

    // Loopback only: the next samples, stereo interleaved, 48 kHz, -1 to 1.
    void render(std::span<float> stereo);

  private:
    struct State;
    explicit Audio(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// Names of the sound outputs; empty without any.
std::vector<std::string> listOutputs();

} // namespace shoal::audio
