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
constexpr std::chrono::seconds kRetry{2}; // time between two attempts to open a device

struct Close {
    void operator()(ALCdevice* device) const { alcCloseDevice(device); }
    void operator()(ALCcontext* context) const {
        if (alcGetCurrentContext() == context) alcMakeContextCurrent(nullptr);
        alcDestroyContext(context);
    }
};

// Assigns sounds to a fixed pool of OpenAL sources, and applies the effects of the water: attenuation,
// low-pass filtering, reverberation. All calls require the OpenAL context to be current.
class VoicePool {
  public:
    // Time to fade out before a stop, against clicks: OpenAL Soft fades in at most 2048 samples, 43 ms.
    static constexpr double kGlide_s = 0.05;

    // Makes kSources voices in a new context, fewer if the device has fewer. The context deletes them.
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

    // Sets the reverberation. enclosure: Listener's; in open water (0) only ground and surface reflect sound.
    void setEnclosure(float enclosure) {
        const float wanted = std::clamp(enclosure, 0.0f, 1.0f);
        if (std::exchange(enclosure_, wanted) != wanted) applyReverbGain();
    }
    // Silences the reverberation or makes it audible again; the listener's gain silences the sources.
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
    // A new sound must be this many times as loud as the one it replaces; else equal ones would alternate.
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
    // Lower bound of that gain, -16 dB. Frequencies above 5 kHz tell front from back and above from below;
    // the filter, which is the same for both ears, keeps these cues as long as the frequencies are audible.
    static constexpr float kHighMin = 0.16f;

    enum class Use { Free, OneShot, Emitter, Ending };
    struct Voice {
        ALuint source = 0; // 0: the device has no more sources
        ALuint filter = 0; // low-pass of the source
        Use use = Use::Free;
        Sound sound;
        double since_s = 0; // time: start of a one-shot, last update of an emitter, or start of the fade-out
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
        Sound sound = voice.sound;
        sound.position += sound.velocity * static_cast<float>(age_s);
        const glm::vec3 at = sound.everywhere ? glm::vec3(0) : sound.position;
        const glm::vec3 velocity = sound.everywhere ? glm::vec3(0) : sound.velocity;
        alSourcef(voice.source, AL_GAIN, std::clamp(sound.gain, 0.0f, 1.0f));
        alSourcef(voice.source, AL_PITCH, std::clamp(sound.pitch, 0.25f, 4.0f));
        alSourcei(voice.source, AL_SOURCE_RELATIVE, sound.everywhere ? AL_TRUE : AL_FALSE);
        alSource3f(voice.source, AL_POSITION, at.x, at.y, at.z);
        alSource3f(voice.source, AL_VELOCITY, velocity.x, velocity.y, velocity.z);
        applyWater(voice, glm::distance(sound.position, listener));
        voice.loudness = loudnessOf(sound, listener);
    }

    static void start(const Voice& voice, const Clip& clip, ALuint buffer) {
        const bool loop = voice.use == Use::Emitter, stereo = clip.channels == 2;
        alSourcei(voice.source, AL_BUFFER, static_cast<ALint>(buffer));
        alSourcei(voice.source, AL_LOOPING, loop ? AL_TRUE : AL_FALSE);
        // Stereo goes to the ears directly; HRTF would place it at two loudspeakers.
        alSourcei(voice.source, AL_DIRECT_CHANNELS_SOFT, stereo ? AL_TRUE : AL_FALSE);
        if (loop) {
            // Unless inStep, the start is hashed from the id, so that two emitters of one clip differ in
            // phase. It is never 0, because OpenAL Soft fades in only sounds that start after 0.
            const auto frames = static_cast<uint32_t>(clip.samples.size() / (stereo ? 2 : 1));
            const uint32_t place = voice.sound.inStep ? 0 : voice.sound.id * 2654435761u >> 8;
            const uint32_t offset = frames > 1 ? 1 + place % (frames - 1) : 0;
            alSourcei(voice.source, AL_SAMPLE_OFFSET, static_cast<ALint>(offset));
        }
        alSourcePlay(voice.source);
    }

    Voice* voiceFor(float loudness) {
        Voice* quietest = nullptr;
        for (Voice& voice : voices_) {
            if (!voice.source) continue;
            if (voice.use == Use::Free) return &voice;
            if (!quietest || voice.loudness < quietest->loudness) quietest = &voice;
        }
        if (!quietest || loudness < kTakeOver * quietest->loudness) return nullptr;
        release(*quietest);
        return quietest;
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
    // paused: by the caller; all sounds fade out. suspended: the fade is over, and the sources are paused.
    bool paused = false, suspended = false;
    double pausedAt_s = 0, pausedFor_s = 0; // device's clock, which does not stop in a pause
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
        // Libraries below OpenAL print many lines about a missing sound card; the caller reports it in one.
        const log::QuietStandardError quiet;
        device.reset(options.loopback ? alcLoopbackOpenDeviceSOFT(nullptr) : alcOpenDevice(nullptr));
        if (!device) return Error{"", "there is no sound device"};
        // For a real device `format` is 0 and ends the list early: the device keeps its own format and rate.
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
        pausedAt_s = pausedFor_s = 0; // the clock of a new device starts at 0
        suspended = false;
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

    bool isTrue(ALCenum property) const { // ALC_CONNECTED: still plugged in; ALC_HRTF_SOFT: HRTF is on
        ALCint value = ALC_FALSE;
        if (context) alcGetIntegerv(device.get(), property, 1, &value);
        return value != ALC_FALSE;
    }

    // Returns the duration of the sound rendered so far, to a device or to memory, seconds.
    double played_s() const {
        ALCint64SOFT clock_ns = 0;
        alcGetInteger64vSOFT(device.get(), ALC_DEVICE_CLOCK_SOFT, 1, &clock_ns);
        return static_cast<double>(clock_ns) * 1e-9;
    }

    // Returns whether a device is open. Tries every kRetry to open another after one is unplugged.
    bool ready() {
        if (isTrue(ALC_CONNECTED)) return makeCurrent();
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
        if (s.suspended || s.played_s() - s.pausedAt_s < VoicePool::kGlide_s) return;
        s.suspended = true;
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
    } else if (s.suspended) {
        s.suspended = false;
        s.pausedFor_s += s.played_s() - s.pausedAt_s;
        s.voices.setPaused(false);
    }
}

bool Audio::headphones() const { return state_->isTrue(ALC_HRTF_SOFT); }

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
