#include "engine/audio/Audio.h"

#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>
#include <AL/efx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fcntl.h>
#include <unistd.h>

namespace shoal::audio {

namespace {

// The medium. Sound runs 4.3 times as fast as in air; high tones fade with distance far sooner than low ones.
// The figures are set by ear: real sea water is clear to sound over any distance in this game, but would not
// sound like water.
constexpr float kSpeed_mps = 1480;
constexpr float kReference_m = 0.7f; // within this a sound keeps its level
constexpr float kRolloff = 1.0f;
constexpr float kHighNear = 0.5f; // what is left of the high tones at no distance
constexpr float kHighFade_m = 4;  // and over which distance that falls to 1/e
constexpr float kReverbSend = 0.35f;

struct Context {
    ALCdevice* device = nullptr;
    ALCcontext* context = nullptr;
    ~Context() {
        alcMakeContextCurrent(nullptr);
        if (context) alcDestroyContext(context);
        if (device) alcCloseDevice(device);
    }
};

// Sound libraries below OpenAL write pages about a missing sound card straight to standard error; the caller
// says it in one sentence instead. Only while a device is opened, at the start of the program.
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

template <class Function> Function extension(const char* name) {
    return reinterpret_cast<Function>(alGetProcAddress(name));
}

} // namespace

struct Audio::State {
    Context context; // first: it dies last
    std::vector<ALuint> buffers;
    struct Source {
        ALuint name = 0;
        ALuint filter = 0;
        bool looping = false;
        uint32_t id = 0;
    };
    std::array<Source, kSources> sources{};
    ALuint reverb = 0, slot = 0;
    LPALCRENDERSAMPLESSOFT renderSamples = nullptr;
    LPALFILTERF filterf = nullptr;

    ~State() {
        for (const Source& source : sources)
            if (source.name) alDeleteSources(1, &source.name);
        if (!buffers.empty()) alDeleteBuffers(static_cast<ALsizei>(buffers.size()), buffers.data());
    }

    void place(Source& source, const glm::vec3& position, const glm::vec3& listener, float gain, float pitch,
               bool everywhere) {
        alSourcef(source.name, AL_GAIN, std::clamp(gain, 0.0f, 1.0f));
        alSourcef(source.name, AL_PITCH, std::clamp(pitch, 0.25f, 4.0f));
        alSourcei(source.name, AL_SOURCE_RELATIVE, everywhere ? AL_TRUE : AL_FALSE);
        const glm::vec3 at = everywhere ? glm::vec3(0) : position;
        alSource3f(source.name, AL_POSITION, at.x, at.y, at.z);
        if (!source.filter) return;
        const float high =
            everywhere ? 1.0f : kHighNear * std::exp(-glm::distance(position, listener) / kHighFade_m);
        filterf(source.filter, AL_LOWPASS_GAINHF, high);
        alSourcei(source.name, AL_DIRECT_FILTER, static_cast<ALint>(source.filter));
    }

    void start(Source& source, int clip, bool loop) {
        alSourcei(source.name, AL_BUFFER, static_cast<ALint>(buffers[static_cast<size_t>(clip)]));
        alSourcei(source.name, AL_LOOPING, loop ? AL_TRUE : AL_FALSE);
        source.looping = loop;
        alSourcePlay(source.name);
    }

    Source* freeSource() {
        for (Source& source : sources) {
            ALint playing = AL_STOPPED;
            alGetSourcei(source.name, AL_SOURCE_STATE, &playing);
            if (playing != AL_PLAYING) return &source;
        }
        return nullptr;
    }

    void makeMedium() {
        const auto genFilters = extension<LPALGENFILTERS>("alGenFilters");
        const auto filteri = extension<LPALFILTERI>("alFilteri");
        filterf = extension<LPALFILTERF>("alFilterf");
        const auto genEffects = extension<LPALGENEFFECTS>("alGenEffects");
        const auto effecti = extension<LPALEFFECTI>("alEffecti");
        const auto effectf = extension<LPALEFFECTF>("alEffectf");
        const auto genSlots = extension<LPALGENAUXILIARYEFFECTSLOTS>("alGenAuxiliaryEffectSlots");
        const auto sloti = extension<LPALAUXILIARYEFFECTSLOTI>("alAuxiliaryEffectSloti");
        const auto slotf = extension<LPALAUXILIARYEFFECTSLOTF>("alAuxiliaryEffectSlotf");
        if (!genFilters || !filteri || !filterf || !genEffects || !effecti || !effectf || !genSlots ||
            !sloti || !slotf)
            return; // without effects it sounds like air, but it sounds
        genEffects(1, &reverb);
        effecti(reverb, AL_EFFECT_TYPE, AL_EFFECT_REVERB);
        effectf(reverb, AL_REVERB_DECAY_TIME, 1.6f);
        effectf(reverb, AL_REVERB_DECAY_HFRATIO, 0.3f);
        effectf(reverb, AL_REVERB_GAINHF, 0.15f);
        genSlots(1, &slot);
        sloti(slot, AL_EFFECTSLOT_EFFECT, static_cast<ALint>(reverb));
        slotf(slot, AL_EFFECTSLOT_GAIN, kReverbSend);
        for (Source& source : sources) {
            genFilters(1, &source.filter);
            filteri(source.filter, AL_FILTER_TYPE, AL_FILTER_LOWPASS);
            filterf(source.filter, AL_LOWPASS_GAIN, 1);
            alSource3i(source.name, AL_AUXILIARY_SEND_FILTER, static_cast<ALint>(slot), 0, AL_FILTER_NULL);
        }
    }
};

Audio::Audio(std::unique_ptr<State> state) : state_(std::move(state)) {}
Audio::Audio(Audio&&) noexcept = default;
Audio& Audio::operator=(Audio&&) noexcept = default;
Audio::~Audio() = default;

Result<Audio> Audio::open(const AudioOptions& options) {
    const QuietStandardError quiet;
    auto state = std::make_unique<State>();
    const ALCint hrtf = options.headphones ? ALC_TRUE : ALC_FALSE;
    if (options.loopback) {
        const auto openLoopback = reinterpret_cast<LPALCLOOPBACKOPENDEVICESOFT>(
            alcGetProcAddress(nullptr, "alcLoopbackOpenDeviceSOFT"));
        state->renderSamples =
            reinterpret_cast<LPALCRENDERSAMPLESSOFT>(alcGetProcAddress(nullptr, "alcRenderSamplesSOFT"));
        if (!openLoopback || !state->renderSamples) return Error{"", "this OpenAL cannot render to memory"};
        state->context.device = openLoopback(nullptr);
    } else {
        state->context.device = alcOpenDevice(nullptr);
    }
    if (!state->context.device) return Error{"", "there is no sound device"};
    const std::array<ALCint, 9> loopback = {ALC_FORMAT_CHANNELS_SOFT,
                                            ALC_STEREO_SOFT,
                                            ALC_FORMAT_TYPE_SOFT,
                                            ALC_FLOAT_SOFT,
                                            ALC_FREQUENCY,
                                            48000,
                                            ALC_HRTF_SOFT,
                                            hrtf,
                                            0};
    const std::array<ALCint, 3> live = {ALC_HRTF_SOFT, hrtf, 0};
    state->context.context =
        alcCreateContext(state->context.device, options.loopback ? loopback.data() : live.data());
    if (!state->context.context || !alcMakeContextCurrent(state->context.context))
        return Error{"", "the sound device could not be set up"};
    for (State::Source& source : state->sources) {
        alGenSources(1, &source.name);
        alSourcef(source.name, AL_REFERENCE_DISTANCE, kReference_m);
        alSourcef(source.name, AL_ROLLOFF_FACTOR, kRolloff);
    }
    alDistanceModel(AL_INVERSE_DISTANCE_CLAMPED);
    alSpeedOfSound(kSpeed_mps);
    state->makeMedium();
    Audio audio(std::move(state));
    audio.setVolume(options.volume);
    return audio;
}

int Audio::add(const Clip& clip) {
    ALuint buffer = 0;
    alGenBuffers(1, &buffer);
    alBufferData(buffer, clip.channels == 2 ? AL_FORMAT_STEREO16 : AL_FORMAT_MONO16, clip.samples.data(),
                 static_cast<ALsizei>(clip.samples.size() * sizeof(int16_t)), clip.rate_Hz);
    state_->buffers.push_back(buffer);
    return static_cast<int>(state_->buffers.size()) - 1;
}

void Audio::update(const Listener& listener, std::span<const Emitter> emitters, std::span<const Shot> shots) {
    State& s = *state_;
    alListener3f(AL_POSITION, listener.position.x, listener.position.y, listener.position.z);
    const glm::vec3 ahead = listener.worldFromHead * glm::vec3(0, 0, -1),
                    up = listener.worldFromHead * glm::vec3(0, 1, 0);
    const std::array<ALfloat, 6> facing = {ahead.x, ahead.y, ahead.z, up.x, up.y, up.z};
    alListenerfv(AL_ORIENTATION, facing.data());
    for (State::Source& source : s.sources) {
        if (!source.looping) continue;
        const bool listed = std::any_of(emitters.begin(), emitters.end(),
                                        [&](const Emitter& e) { return e.id == source.id; });
        if (listed) continue;
        alSourceStop(source.name);
        source.looping = false;
    }
    for (const Emitter& emitter : emitters) {
        const auto playing =
            std::find_if(s.sources.begin(), s.sources.end(), [&](const State::Source& source) {
                return source.looping && source.id == emitter.id;
            });
        State::Source* source = playing != s.sources.end() ? &*playing : s.freeSource();
        if (!source) continue;
        s.place(*source, emitter.position, listener.position, emitter.gain, emitter.pitch,
                emitter.everywhere);
        if (playing == s.sources.end()) {
            source->id = emitter.id;
            s.start(*source, emitter.clip, true);
        }
    }
    for (const Shot& shot : shots) {
        State::Source* source = s.freeSource();
        if (!source) break;
        s.place(*source, shot.position, listener.position, shot.gain, shot.pitch, shot.everywhere);
        s.start(*source, shot.clip, false);
    }
}

void Audio::setVolume(float volume) { alListenerf(AL_GAIN, std::clamp(volume, 0.0f, 1.0f)); }

void Audio::render(std::span<float> stereo) {
    state_->renderSamples(state_->context.device, stereo.data(), static_cast<ALCsizei>(stereo.size() / 2));
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
