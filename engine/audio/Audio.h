// Sounds in their places, heard through water. OpenAL Soft does the mixing on its own thread; these calls
// belong to one thread. World frame: metres, +Y up, -Z ahead.
#pragma once

#include "engine/audio/Clip.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace shoal::audio {

// Sound is so quick in water (1500 m/s) that what swims by hardly changes its pitch: a shark at 3 m/s by 3.5
// cents, less than anybody hears. Ears learnt the effect in air (343 m/s), and expect of what rushes past
// what it does there: 15 cents, just felt.
constexpr float kDopplerAsInAir = 1500.0f / 343;

struct AudioOptions {
    bool headphones = false;         // HRTF
    bool loopback = false;           // renders to memory: render() below; no device is touched
    float volume = 1;                // 0 to 1
    float doppler = kDopplerAsInAir; // times water's own; 0: none
};

struct Listener {
    glm::vec3 position{0};
    glm::quat worldFromHead{1, 0, 0, 0}; // looks along -Z, +Y up
    float shelter = 0; // how enclosed the place is: 0 open water, 1 a tunnel; it reverberates accordingly
};

// A sound that goes on, looping, for as long as it is listed.
struct Emitter {
    uint32_t id = 0; // the same sound from one update to the next
    int clip = 0;
    glm::vec3 position{0};
    float gain = 1, pitch = 1; // 0 to 1; 0.25 to 4
    bool everywhere = false;   // not placed: a bed. Stereo clips are always everywhere
    glm::vec3 velocity{0};     // m/s, for the doppler effect
};

// A sound that starts now and ends by itself.
struct Shot {
    int clip = 0;
    glm::vec3 position{0};
    float gain = 1, pitch = 1;
    bool everywhere = false;
    glm::vec3 velocity{0}; // m/s; it moves on by itself while it sounds
};

// A sound to be heard in step with something seen: the video's own. Read piece by piece, stereo at 48 kHz.
struct Accompaniment {
    int64_t length = 0;                             // frames; then it begins again
    std::function<void(int64_t frame)> seek;        // the next read begins there
    std::function<size_t(std::span<int16_t>)> read; // interleaved; frames that were ready, without waiting
};

class Audio {
  public:
    // Fails where there is no sound device.
    static Result<Audio> open(const AudioOptions& options);
    Audio(Audio&&) noexcept;
    Audio& operator=(Audio&&) noexcept;
    ~Audio();

    // Index for Emitter::clip and Shot::clip, counted from 0 in the order of the calls. The clip is kept, for
    // a device that comes back.
    int add(Clip clip);

    // Starts, moves and ends sounds; call once a frame. No more than kSources sound at once: a new one takes
    // the place of the one heard least, if that is heard less, else it is left out (an emitter until there is
    // room). Emitters end with a short fade. A device that was pulled out is replaced when there is another;
    // meanwhile all is silent. Takes no memory.
    void update(const Listener& listener, std::span<const Emitter> emitters, std::span<const Shot> shots);
    static constexpr int kSources = 32;

    // Plays this sound from now on; an empty one ends it. Its functions are called within accompany() alone.
    void setAccompaniment(Accompaniment sound);

    // Once a frame: what is seen now belongs to that second of the sound (modulo its length), and moves on at
    // its own pace until the next call. Paused it is silent and stands still. How far the sound is ahead of
    // the picture; 0 while it is silent.
    double accompany(double position_s, float gain, bool paused);

    void setVolume(float volume); // 0 to 1

    // While paused all is silent, every sound stands still and update() starts none.
    void setPaused(bool paused);

    // Closes the device and opens the present default one; shots end, emitters start again. On failure all is
    // silent and update() goes on trying every other second.
    Status reopen();

    bool headphones() const; // HRTF is on
    int sounding() const;    // how many sounds there are now

    // Loopback only: the next samples, stereo interleaved, 48 kHz. Nominally -1 to 1, but not clipped.
    void render(std::span<float> stereo);

  private:
    struct State;
    explicit Audio(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// Names of the sound outputs; empty without any.
std::vector<std::string> listOutputs();

} // namespace shoal::audio
