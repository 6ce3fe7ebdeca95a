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

struct Close {
    void operator()(ALCdevice* device) const { alcCloseDevice(device); }
    void operator()(ALCcontext* context) const {
        if (alcGetCurrentContext() == context) alcMakeContextCurrent(nullptr);
        alcDestroyContext(context);
    }
};

} // namespace

struct Audio::State {
    AudioOptions options;
    std::vector<Clip> clips;
    // paused: all sounds fade to silence. standing: after that, they stand still.
    bool paused = false, standing = false;
    double pausedAt_s = 0, pausedFor_s = 0; // on the device's clock, which runs on in a pause
    Clock::time_point retry;

    std::unique_ptr<ALCdevice, Close> device;   // the output, or loopback to memory
    std::unique_ptr<ALCcontext, Close> context; // null: no device
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

    Status openDevice() {
        // Sound libraries below OpenAL write pages about a missing sound card; the caller says it in one
        // sentence.
        const log::QuietStandardError quiet;
        device.reset(options.loopback ? alcLoopbackOpenDeviceSOFT(nullptr) : alcOpenDevice(nullptr));
        if (!device) return Error{"", "there is no sound device"};
        std::vector<ALCint> attributes = {ALC_HRTF_SOFT, options.headphones ? ALC_TRUE : ALC_FALSE};
        if (options.loopback)
            for (const ALCint each : {ALC_FORMAT_CHANNELS_SOFT, ALC_STEREO_SOFT, ALC_FORMAT_TYPE_SOFT,
                                      ALC_FLOAT_SOFT, ALC_FREQUENCY, 48000})
                attributes.push_back(each);
        attributes.push_back(0);
        context.reset(alcCreateContext(device.get(), attributes.data()));
        if (!context) {
            device.reset();
            return Error{"", "the sound device could not be set up"};
        }
        return Done{};
    }

    Status open() {
        if (Status opened = openDevice(); !opened) return opened;
        pausedAt_s = pausedFor_s = 0; // a new device, a new clock
        standing = false;
        makeCurrent();
        voices.setUp();
        streamed.setUp();
        for (const Clip& clip : clips) addBuffer(clip);
        setVolume();
        return Done{};
    }

    void close() {
        buffers.clear();
        context.reset();
        device.reset(); // OpenAL Soft frees all that belongs to it
    }

    // Makes the context current, for the whole process; all methods of Audio call it. False: no device.
    bool makeCurrent() const {
        if (context && alcGetCurrentContext() != context.get()) alcMakeContextCurrent(context.get());
        return context != nullptr;
    }

    bool is(ALCenum property) const { // ALC_CONNECTED: not unplugged yet; ALC_HRTF_SOFT: for headphones
        ALCint value = ALC_FALSE;
        if (context) alcGetIntegerv(device.get(), property, 1, &value);
        return value != ALC_FALSE;
    }

    // Seconds of sound rendered so far, to a device or to memory.
    double played_s() const {
        ALCint64SOFT clock_ns = 0;
        alcGetInteger64vSOFT(device.get(), ALC_DEVICE_CLOCK_SOFT, 1, &clock_ns);
        return static_cast<double>(clock_ns) * 1e-9;
    }

    // Returns whether there is a device to play on; looks for another if it is gone.
    bool ready() {
        if (is(ALC_CONNECTED)) return makeCurrent();
        if (context) {
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
    if (state_->makeCurrent()) state_->addBuffer(state_->clips.back());
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
    s.streamed.turn(glm::inverse(listener.worldFromHead) * listener.worldFromTrack);
    if (s.paused) {
        if (s.standing || s.played_s() - s.pausedAt_s < VoicePool::kGlide_s) return;
        s.standing = true;
        s.pausedAt_s = s.played_s();
        return s.voices.setPaused(true);
    }
    s.voices.setEnclosure(listener.enclosure);
    s.voices.update(s.clips, s.buffers, listener.position, emitters, shots, s.played_s() - s.pausedFor_s);
}

void Audio::setTrack(TrackSource sound) {
    state_->track = std::move(sound);
    if (state_->makeCurrent()) state_->streamed.stop();
}

double Audio::syncTrack(double position_s, float gain, bool paused) {
    State& s = *state_;
    if (s.track.length <= 0 || !s.makeCurrent()) return 0;
    s.streamed.update(s.track, position_s, gain, paused || s.paused);
    return s.streamed.ahead_s();
}

void Audio::setVolume(float volume) {
    state_->options.volume = volume;
    if (state_->makeCurrent()) state_->setVolume();
}

void Audio::setPaused(bool paused) {
    State& s = *state_;
    if (std::exchange(s.paused, paused) == paused || !s.makeCurrent()) return;
    s.setVolume();
    if (paused) {
        s.pausedAt_s = s.played_s();
    } else if (s.standing) {
        s.standing = false;
        s.pausedFor_s += s.played_s() - s.pausedAt_s;
        s.voices.setPaused(false);
    }
}

bool Audio::headphones() const { return state_->is(ALC_HRTF_SOFT); }

int Audio::sounding() const { return state_->makeCurrent() ? state_->voices.sounding() : 0; }

void Audio::render(std::span<float> stereo) {
    assert(stereo.size() % 2 == 0);
    if (state_->context)
        alcRenderSamplesSOFT(state_->device.get(), stereo.data(), static_cast<ALCsizei>(stereo.size() / 2));
    else
        std::ranges::fill(stereo, 0.0f);
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
