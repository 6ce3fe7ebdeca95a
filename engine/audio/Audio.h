// Spatial audio under water, and a streamed track in step with a video. OpenAL Soft mixes on a thread of its
// own; these calls belong to one thread. World frame: metres, +Y up, -Z ahead.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Hidden.h"
#include "engine/core/Result.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace shoal::audio {

// A sound in memory.
struct Clip {
    int rate_Hz = 48000;
    int channels = 1;             // 1 or 2; only mono sounds have a place in space
    std::vector<int16_t> samples; // interleaved
};

constexpr int kMaxClip_s = 60;

// Reads WAV, FLAC, Ogg Vorbis and other formats of libsndfile; at most kMaxClip_s long, 1 or 2 channels, 8 to
// 192 kHz. The file's header is checked before memory is allocated.
Result<Clip> readClip(const Path& file);

struct AudioOptions {
    bool headphones = false; // HRTF
    bool loopback = false;   // renders to memory: render() below; no device is touched
    float volume = 1;        // 0 to 1
};

struct Listener {
    glm::vec3 position{0};
    glm::quat worldFromHead{1, 0, 0, 0};  // looks along -Z, +Y up
    glm::quat worldFromTrack{1, 0, 0, 0}; // turns B-format, whose X is along -Z and Z along +Y
    float enclosure = 0;                  // reverberation: 0 open water, 1 a tunnel
};

// A sound that plays now: an emitter, which loops for as long as it is listed, or one that plays once.
struct Sound {
    uint32_t id = 0; // identifies an emitter in successive updates
    int clip = 0;
    glm::vec3 position{0};
    float gain = 1, pitch = 1; // 0 to 1; 0.25 to 4
    bool everywhere = false;   // ambient, without a position. Stereo clips are always ambient
    bool inStep = false;   // an emitter that starts at its loop's start, in step with others of the update
    glm::vec3 velocity{0}; // m/s; a sound that plays once keeps moving with it
};

// Source of a streamed track, such as a video's own sound, at 48 kHz, read piece by piece.
struct TrackSource {
    int64_t length = 0;                             // frames; then it repeats
    int channels = 2;                               // 2: stereo; 4: FuMa B-format, which surrounds the head
    std::function<void(int64_t frame)> seek;        // the next read begins there
    std::function<size_t(std::span<int16_t>)> read; // interleaved; returns the frames that were ready
};

class Audio {
  public:
    // Fails if there is no sound device.
    static Result<Audio> open(const AudioOptions& options);

    // Adds a clip, which is kept when the device is replaced. Returns its index for Sound::clip, from 0 on.
    int add(Clip clip);

    // Starts, moves and ends sounds; call it once a frame. At most kSources play at once: a new one replaces
    // the quietest if it is 1.3 times as loud, else it is left out (an emitter until there is room). Emitters
    // end with a short fade. Replaces an unplugged device once there is another, and allocates only then.
    void update(const Listener& listener, std::span<const Sound> emitters, std::span<const Sound> shots);
    static constexpr int kSources = 32;

    // Streams this track from now on; an empty one ends it. Only syncTrack() calls its functions.
    void setTrack(TrackSource sound);

    // Synchronises the track with the video; call it once a frame. position_s: time of the picture now shown,
    // in the track, modulo its length. A paused track is silent and does not advance. Returns how far the
    // sound is ahead of the picture, seconds; 0 while it is silent.
    double syncTrack(double position_s, float gain, bool paused);

    void setVolume(float volume); // 0 to 1

    // While paused, all sounds are silent and do not advance, and update() starts none.
    void setPaused(bool paused);

    // Closes the device and opens the current default device; shots end, emitters start again. If this fails,
    // there is no sound, and update() tries again every two seconds.
    Status reopen();

    bool headphones() const; // HRTF is on
    int sounding() const;    // number of sounds now playing

    // Renders the next samples, stereo interleaved, 48 kHz; nominally -1 to 1, not clipped. Loopback only.
    void render(std::span<float> stereo);

  private:
    struct State;
    explicit Audio(Hidden<State> state) : state_(std::move(state)) {}
    Hidden<State> state_;
};

// Returns the names of the sound outputs; empty if there are none.
std::vector<std::string> listOutputs();

} // namespace shoal::audio
