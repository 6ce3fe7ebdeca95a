#include "engine/audio/Audio.h"

#include "engine/audio/StreamedTrack.h"
#include "engine/core/Log.h"

#include <AL/alc.h>
#include <AL/alext.h>
#include <AL/efx.h>
#include <glm/geometric.hpp>

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

// Fixed pool of OpenAL sources, their assignment to sounds, and the effects of the water on them:
// attenuation, low-pass filtering, reverberation. All calls require the OpenAL context to be current.
class VoicePool {
  public:
    // OpenAL Soft fades to a new gain in one mix of at most 2048 samples, 43 ms; then a stop does not click.
    static constexpr double kGlide_s = 0.05;

    // Makes kSources voices in a new context, fewer if the device has fewer. They end with the context.
    void setUp() {
        voices_ = {};
        alDistanceModel(AL_INVERSE_DISTANCE_CLAMPED);
        alSpeedOfSound(kSpeed_mps);
        alDopplerFactor(kDopplerAsInAir);
        alGenEffects(1, &reverb_);
        alEffecti(reverb_, AL_EFFECT_TYPE, AL_EFFECT_REVERB);
        alEffectf(reverb_, AL_REVERB_DECAY_TIME, 2.2f);
        alEffectf(reverb_, AL_REVERB_DECAY_HFRATIO, 0.3f);
        alEffectf(reverb_, AL_REVERB_GAINHF, 0.15f);
        alGenAuxiliaryEffectSlots(1, &slot_);
        alAuxiliaryEffectSloti(slot_, AL_EFFECTSLOT_EFFECT, static_cast<ALint>(reverb_));
        applyReverbGain();
        for (Voice& voice : voices_) {
            alGetError();
            alGenSources(1, &voice.source);
            if (alGetError() != AL_NO_ERROR) {
                voice.source = 0;
                break;
            }
            alGenFilters(1, &voice.filter);
            alFilteri(voice.filter, AL_FILTER_TYPE, AL_FILTER_LOWPASS);
            alSourcef(voice.source, AL_REFERENCE_DISTANCE, kReference_m);
            alSourcef(voice.source, AL_ROLLOFF_FACTOR, 1);
        }
    }

    // See Audio::update(). clips, buffers: by Sound::clip. now_s: the device's clock, minus the time paused.
    void update(std::span<const Clip> clips, std::span<const ALuint> buffers, const glm::vec3& listener,
                std::span<const Sound> emitters, std::span<const Sound> shots, double now_s) {
        for (Voice& voice : voices_) {
            if (voice.use == Use::Free) continue;
            if (!plays(voice.source)) {
                voice.use = Use::Free;
            } else if (voice.use == Use::OneShot) {
                place(voice, listener, now_s - voice.since_s);
            } else if (voice.use == Use::Ending) {
                if (now_s - voice.since_s > kGlide_s) release(voice);
            } else if (std::ranges::find(emitters, voice.sound.id, &Sound::id) == emitters.end()) {
                alSourcef(voice.source, AL_GAIN, 0);
                voice.use = Use::Ending;
                voice.since_s = now_s;
                voice.loudness = 0;
            }
        }
        const auto play = [&](const Sound& sound, Use use, Voice* playing) {
            Voice* voice = playing ? playing : voiceFor(loudnessOf(sound, listener));
            if (!voice) return;
            voice->sound = sound;
            voice->use = use;
            voice->since_s = now_s;
            place(*voice, listener, 0);
            if (playing) return;
            const auto clip = static_cast<size_t>(sound.clip);
            assert(clip < buffers.size());
            start(*voice, clips[clip], buffers[clip]);
        };
        for (const Sound& emitter : emitters) {
            const auto playing = std::ranges::find_if(voices_, [&](const Voice& voice) {
                return (voice.use == Use::Emitter || voice.use == Use::Ending) &&
                       voice.sound.id == emitter.id && voice.sound.clip == emitter.clip;
            });
            play(emitter, Use::Emitter, playing != voices_.end() ? &*playing : nullptr);
        }
        for (const Sound& shot : shots) play(shot, Use::OneShot, nullptr);
    }

    // Sets the reverberation: Listener::enclosure. In open water only ground and surface reflect.
    void setEnclosure(float enclosure) {
        const float wanted = std::clamp(enclosure, 0.0f, 1.0f);
        if (std::exchange(enclosure_, wanted) != wanted) applyReverbGain();
    }
    // Ends the reverberation, or lets it sound again; the listener's gain silences the rest.
    void setSilent(bool silent) {
        silent_ = silent;
        applyReverbGain();
    }

    void setPaused(bool paused) {
        for (const Voice& voice : voices_)
            if (voice.use != Use::Free && plays(voice.source))
                paused ? alSourcePause(voice.source) : alSourcePlay(voice.source);
    }

    int sounding() const {
        return static_cast<int>(std::ranges::count_if(
            voices_, [](const Voice& voice) { return voice.use != Use::Free && plays(voice.source); }));
    }

  private:
    // A new sound must be this many times as loud as the one it replaces, or two equal ones would alternate.
    static constexpr float kTakeOver = 1.3f;
    static constexpr float kAmbientLoudness = 10; // never replaced by sounds with a position

    // Effects of the water, chosen by ear: real sea water's are inaudible over this game's distances.
    static constexpr float kReference_m = 0.7f; // beyond it, the level falls as 1 / distance
    static constexpr float kSpeed_mps = 1500;   // speed of sound in water, 4.4 times that in air
    // Exaggeration of the Doppler effect. At the speed of sound in water a shark at 3 m/s shifts by 3.5
    // cents, which is inaudible; as in air (343 m/s) it shifts by 15 cents, which is just noticed.
    static constexpr float kDopplerAsInAir = kSpeed_mps / 343;
    static constexpr float kReverbOpen = 0.12f, kReverbTunnel = 0.8f; // reverberation gain
    static constexpr float kHighNear = 0.6f;                          // gain above 5 kHz at distance 0
    static constexpr float kHighFade_m = 4;                           // distance over which that falls to 1/e
    // Lower bound of that gain, -16 dB: frequencies above 5 kHz carry the directional cues of front and back,
    // above and below, which an equal filter on both ears leaves intact as long as they are audible.
    static constexpr float kHighMin = 0.16f;

    enum class Use { Free, OneShot, Emitter, Ending };
    struct Voice {
        ALuint source = 0; // 0: the device has no more sources
        ALuint filter = 0; // its low-pass
        Use use = Use::Free;
        Sound sound;
        double since_s = 0; // when it started, was last heard as an emitter, or began to end
        float loudness = 0; // gain at the ear
    };

    // Returns the gain at the ear, by OpenAL's AL_INVERSE_DISTANCE_CLAMPED with a roll-off of 1.
    static float loudnessOf(const Sound& sound, const glm::vec3& listener) {
        return sound.everywhere ? kAmbientLoudness + sound.gain
                                : sound.gain * kReference_m /
                                      std::max(glm::distance(sound.position, listener), kReference_m);
    }

    static bool plays(ALuint source) {
        ALint state = AL_STOPPED;
        alGetSourcei(source, AL_SOURCE_STATE, &state);
        return state == AL_PLAYING || state == AL_PAUSED;
    }

    // Interpolates geometrically, because loudness is perceived on a logarithmic scale.
    void applyReverbGain() const {
        alAuxiliaryEffectSlotf(slot_, AL_EFFECTSLOT_GAIN,
                               silent_ ? 0 : kReverbOpen * std::pow(kReverbTunnel / kReverbOpen, enclosure_));
    }

    // Applies the water's low-pass and reverberation; ambient sounds were recorded under water already.
    void applyWater(const Voice& voice, float distance_m) const {
        const bool everywhere = voice.sound.everywhere;
        const float high = std::max(kHighNear * std::exp(-distance_m / kHighFade_m), kHighMin);
        alFilterf(voice.filter, AL_LOWPASS_GAINHF, everywhere ? 1.0f : high);
        alSourcei(voice.source, AL_DIRECT_FILTER, static_cast<ALint>(voice.filter));
        const ALuint send = everywhere ? static_cast<ALuint>(AL_EFFECTSLOT_NULL) : slot_;
        alSource3i(voice.source, AL_AUXILIARY_SEND_FILTER, static_cast<ALint>(send), 0, AL_FILTER_NULL);
    }

    void release(Voice& voice) {
        alSourceStop(voice.source);
        voice.use = Use::Free;
    }

    void place(Voice& voice, const glm::vec3& listener, double age_s) {
        Sound shot = voice.sound;
        shot.position += shot.velocity * static_cast<float>(age_s);
        const glm::vec3 at = shot.everywhere ? glm::vec3(0) : shot.position;
        const glm::vec3 velocity = shot.everywhere ? glm::vec3(0) : shot.velocity;
        alSourcef(voice.source, AL_GAIN, std::clamp(shot.gain, 0.0f, 1.0f));
        alSourcef(voice.source, AL_PITCH, std::clamp(shot.pitch, 0.25f, 4.0f));
        alSourcei(voice.source, AL_SOURCE_RELATIVE, shot.everywhere ? AL_TRUE : AL_FALSE);
        alSource3f(voice.source, AL_POSITION, at.x, at.y, at.z);
        alSource3f(voice.source, AL_VELOCITY, velocity.x, velocity.y, velocity.z);
        applyWater(voice, glm::distance(shot.position, listener));
        voice.loudness = loudnessOf(shot, listener);
    }

    static void start(const Voice& voice, const Clip& clip, ALuint buffer) {
        const bool loop = voice.use == Use::Emitter, stereo = clip.channels == 2;
        alSourcei(voice.source, AL_BUFFER, static_cast<ALint>(buffer));
        alSourcei(voice.source, AL_LOOPING, loop ? AL_TRUE : AL_FALSE);
        // Stereo goes to the ears directly, not through the HRTF of two loudspeakers.
        alSourcei(voice.source, AL_DIRECT_CHANNELS_SOFT, stereo ? AL_TRUE : AL_FALSE);
        if (loop) {
            // Unless in step, each emitter starts at another place in its loop, so that two of one clip do
            // not coincide; and OpenAL Soft fades in sounds that do not start at 0.
            const auto frames = static_cast<uint32_t>(clip.samples.size() / (stereo ? 2 : 1));
            const uint32_t place = voice.sound.inStep ? 0 : voice.sound.id * 2654435761u >> 8;
            const uint32_t offset = frames > 1 ? 1 + place % (frames - 1) : 0;
            alSourcei(voice.source, AL_SAMPLE_OFFSET, static_cast<ALint>(offset));
        }
        alSourcePlay(voice.source);
    }

    Voice* voiceFor(float loudness) {
        Voice* minimum = nullptr;
        for (Voice& voice : voices_) {
            if (!voice.source) continue;
            if (voice.use == Use::Free) return &voice;
            if (!minimum || voice.loudness < minimum->loudness) minimum = &voice;
        }
        if (!minimum || loudness < kTakeOver * minimum->loudness) return nullptr;
        release(*minimum);
        return minimum;
    }

    ALuint reverb_ = 0, slot_ = 0;
    float enclosure_ = 0;
    bool silent_ = false;
    std::array<Voice, Audio::kSources> voices_{};
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

    Status open() {
        // Sound libraries below OpenAL write pages about a missing sound card; the caller says it briefly.
        const log::QuietStandardError quiet;
        device.reset(options.loopback ? alcLoopbackOpenDeviceSOFT(nullptr) : alcOpenDevice(nullptr));
        if (!device) return Error{"", "there is no sound device"};
        // The first 0 ends the list, so that a real device keeps its own format.
        const ALCint hrtf = options.headphones ? ALC_TRUE : ALC_FALSE,
                     format = options.loopback ? ALC_FORMAT_CHANNELS_SOFT : 0;
        const ALCint attributes[] = {
            ALC_HRTF_SOFT, hrtf,  format, ALC_STEREO_SOFT, ALC_FORMAT_TYPE_SOFT, ALC_FLOAT_SOFT,
            ALC_FREQUENCY, 48000, 0};
        context.reset(alcCreateContext(device.get(), attributes));
        if (!context) {
            device.reset();
            return Error{"", "the sound device could not be set up"};
        }
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
    alListener3f(AL_POSITION, listener.position.x, listener.position.y, listener.position.z);
    alListenerfv(AL_ORIENTATION, orientationOf(listener.worldFromHead).data());
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
