#include "engine/audio/Audio.h"

#include "engine/audio/StreamedTrack.h"
#include "engine/audio/VoicePool.h"
#include "engine/core/Log.h"

#include <AL/alc.h>
#include <AL/alext.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <sndfile.h>
#include <utility>

namespace shoal::audio {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kRetry{2}; // between two looks for a new device

// OpenAL output device, or loopback to memory.
class Device {
  public:
    Device() = default; // no device
    Device(Device&&) noexcept = default;
    Device& operator=(Device&& other) noexcept {
        std::swap(device_, other.device_); // the other destroys its context before its device
        std::swap(context_, other.context_);
        return *this;
    }

    static Result<Device> open(bool loopback, bool headphones) {
        // Sound libraries below OpenAL write pages about a missing sound card; the caller says it in one
        // sentence.
        const log::QuietStandardError quiet;
        Device made;
        made.device_.reset(loopback ? alcLoopbackOpenDeviceSOFT(nullptr) : alcOpenDevice(nullptr));
        if (!made.device_) return Error{"", "there is no sound device"};
        std::vector<ALCint> attributes = {ALC_HRTF_SOFT, headphones ? ALC_TRUE : ALC_FALSE};
        if (loopback)
            for (const ALCint each : {ALC_FORMAT_CHANNELS_SOFT, ALC_STEREO_SOFT, ALC_FORMAT_TYPE_SOFT,
                                      ALC_FLOAT_SOFT, ALC_FREQUENCY, 48000})
                attributes.push_back(each);
        attributes.push_back(0);
        made.context_.reset(alcCreateContext(made.device_.get(), attributes.data()));
        if (!made.context_) return Error{"", "the sound device could not be set up"};
        return made;
    }

    explicit operator bool() const { return context_ != nullptr; }

    // Makes the context current, for the whole process; all methods of Audio call it. False: no device.
    bool makeCurrent() const {
        if (context_ && alcGetCurrentContext() != context_.get()) alcMakeContextCurrent(context_.get());
        return context_ != nullptr;
    }

    bool is(ALCenum property) const { // ALC_CONNECTED: not unplugged yet; ALC_HRTF_SOFT: for headphones
        ALCint value = ALC_FALSE;
        if (device_) alcGetIntegerv(device_.get(), property, 1, &value);
        return value != ALC_FALSE;
    }

    // Seconds of sound rendered so far, to a device or to memory.
    double played_s() const {
        ALCint64SOFT clock_ns = 0;
        alcGetInteger64vSOFT(device_.get(), ALC_DEVICE_CLOCK_SOFT, 1, &clock_ns);
        return static_cast<double>(clock_ns) * 1e-9;
    }

    void render(std::span<float> stereo) { // loopback only
        assert(stereo.size() % 2 == 0);
        alcRenderSamplesSOFT(device_.get(), stereo.data(), static_cast<ALCsizei>(stereo.size() / 2));
    }

  private:
    struct Close {
        void operator()(ALCdevice* device) const { alcCloseDevice(device); }
        void operator()(ALCcontext* context) const {
            if (alcGetCurrentContext() == context) alcMakeContextCurrent(nullptr);
            alcDestroyContext(context);
        }
    };
    std::unique_ptr<ALCdevice, Close> device_;
    std::unique_ptr<ALCcontext, Close> context_;
};

} // namespace

struct Audio::State {
    AudioOptions options;
    std::vector<Clip> clips;
    // paused: all sounds fade to silence. standing: after that, they stand still.
    bool paused = false, standing = false;
    double pausedAt_s = 0, pausedFor_s = 0; // on the device's clock, which runs on in a pause
    Clock::time_point retry;

    Device device;
    std::vector<ALuint> buffers;
    VoicePool voices;
    StreamedTrack streamed;
    TrackSource track;

    void addBuffer(const Clip& clip) {
        ALuint buffer = 0;
        alGenBuffers(1, &buffer);
        alBufferData(buffer, clip.channels == 2 ? AL_FORMAT_STEREO16 : AL_FORMAT_MONO16, clip.samples.data(),
                     static_cast<ALsizei>(clip.samples.size() * sizeof(int16_t)), clip.rate_Hz);
        buffers.push_back(buffer);
    }

    void setVolume() {
        alListenerf(AL_GAIN, paused ? 0 : std::clamp(options.volume, 0.0f, 1.0f));
        voices.setSilent(paused);
    }

    Status open() {
        auto opened = Device::open(options.loopback, options.headphones);
        if (!opened) return opened.error();
        device = std::move(*opened);
        pausedAt_s = pausedFor_s = 0; // a new device, a new clock
        standing = false;
        device.makeCurrent();
        voices.setUp();
        streamed.setUp();
        for (const Clip& clip : clips) addBuffer(clip);
        setVolume();
        return Done{};
    }

    void close() {
        buffers.clear();
        device = Device(); // OpenAL Soft frees all that belongs to it
    }

    // Returns whether there is a device to play on; looks for another if it is gone.
    bool ready() {
        if (device.is(ALC_CONNECTED)) return device.makeCurrent();
        if (device) {
            log::info("the sound device is gone; playing on silently until there is another");
            close();
        } else if (Clock::now() < retry) {
            return false;
        }
        retry = Clock::now() + kRetry;
        if (!open()) return false;
        log::info("there is sound again");
        return true;
    }
};

Result<Audio> Audio::open(const AudioOptions& options) {
    auto state = makeHidden<State>();
    state->options = options;
    if (Status opened = state->open(); !opened) return opened.error();
    return Audio(std::move(state));
}

Status Audio::reopen() {
    state_->close();
    state_->retry = Clock::now() + kRetry;
    return state_->open();
}

int Audio::add(Clip clip) {
    state_->clips.push_back(std::move(clip));
    if (state_->device.makeCurrent()) state_->addBuffer(state_->clips.back());
    return static_cast<int>(state_->clips.size()) - 1;
}

void Audio::update(const Listener& listener, std::span<const Sound> emitters, std::span<const Sound> shots) {
    State& s = *state_;
    if (!s.ready()) return;
    const glm::vec3 ahead = listener.worldFromHead * glm::vec3(0, 0, -1),
                    up = listener.worldFromHead * glm::vec3(0, 1, 0);
    const std::array<ALfloat, 6> facing = {ahead.x, ahead.y, ahead.z, up.x, up.y, up.z};
    alListener3f(AL_POSITION, listener.position.x, listener.position.y, listener.position.z);
    alListenerfv(AL_ORIENTATION, facing.data());
    if (s.paused) {
        if (s.standing || s.device.played_s() - s.pausedAt_s < VoicePool::kGlide_s) return;
        s.standing = true;
        s.pausedAt_s = s.device.played_s();
        return s.voices.setPaused(true);
    }
    s.voices.setEnclosure(listener.enclosure);
    s.voices.update({s.buffers, s.clips}, listener.position, emitters, shots,
                    s.device.played_s() - s.pausedFor_s);
}

void Audio::setTrack(TrackSource sound) {
    state_->track = std::move(sound);
    if (state_->device.makeCurrent()) state_->streamed.stop();
}

double Audio::syncTrack(double position_s, float gain, bool paused) {
    State& s = *state_;
    if (s.track.length <= 0 || !s.device.makeCurrent()) return 0;
    s.streamed.update(s.track, position_s, gain, paused || s.paused);
    return s.streamed.ahead_s();
}

void Audio::setVolume(float volume) {
    state_->options.volume = volume;
    if (state_->device.makeCurrent()) state_->setVolume();
}

void Audio::setPaused(bool paused) {
    if (state_->paused == paused) return;
    state_->paused = paused;
    State& s = *state_;
    if (!s.device.makeCurrent()) return;
    s.setVolume();
    if (paused) {
        s.pausedAt_s = s.device.played_s();
    } else if (s.standing) {
        s.standing = false;
        s.pausedFor_s += s.device.played_s() - s.pausedAt_s;
        s.voices.setPaused(false);
    }
}

bool Audio::headphones() const { return state_->device.is(ALC_HRTF_SOFT); }

int Audio::sounding() const { return state_->device.makeCurrent() ? state_->voices.sounding() : 0; }

void Audio::render(std::span<float> stereo) {
    if (state_->device)
        state_->device.render(stereo);
    else
        std::fill(stereo.begin(), stereo.end(), 0.0f);
}

Result<Clip> readClip(const Path& file) {
    SF_INFO info{};
    std::error_code code;
    if (!std::filesystem::is_regular_file(file, code)) return Error{file.string(), "there is no such sound"};
    const std::unique_ptr<SNDFILE, int (*)(SNDFILE*)> sound(sf_open(file.c_str(), SFM_READ, &info), sf_close);
    if (!sound) return Error{file.string(), "is not a sound that can be read"};
    if (info.channels < 1 || info.channels > 2)
        return Error{file.string(), "has neither one nor two channels"};
    if (info.samplerate < 8000 || info.samplerate > 192000)
        return Error{file.string(), "has an unusable sample rate"};
    if (info.frames < 1 || info.frames > static_cast<sf_count_t>(info.samplerate) * kMaxClip_s)
        return Error{file.string(), "is empty or longer than a minute"};
    Clip clip{info.samplerate, info.channels, {}};
    clip.samples.resize(static_cast<size_t>(info.frames) * static_cast<size_t>(info.channels));
    if (sf_readf_short(sound.get(), clip.samples.data(), info.frames) != info.frames)
        return Error{file.string(), "is damaged or cut short"};
    return clip;
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
