#include "engine/audio/Voices.h"

#include <AL/alext.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>

namespace shoal::audio {

namespace {

// OpenAL Soft glides to a new gain over one mix, at most 2048 samples: 43 ms. After that an ending sound is
// silent and may stop without a click.
constexpr double kEnding_s = 0.05;
// A newcomer must be heard this much better than whom it silences, so that two of a kind do not take turns.
constexpr float kTakeOver = 1.3f;
constexpr float kBedHeard = 10; // beds and what else is everywhere give way to nobody placed

bool plays(ALuint source) {
    ALint state = AL_STOPPED;
    alGetSourcei(source, AL_SOURCE_STATE, &state);
    return state == AL_PLAYING || state == AL_PAUSED;
}

Shot asShot(const Emitter& e) { return {e.clip, e.position, e.gain, e.pitch, e.everywhere, e.velocity}; }

} // namespace

void Voices::setUp(float doppler) {
    medium_.setUp(doppler);
    for (Voice& voice : voices_) {
        alGetError();
        alGenSources(1, &voice.source);
        if (alGetError() != AL_NO_ERROR) {
            voice.source = 0;
            break;
        }
        voice.filter = medium_.makeFilter();
        alSourcef(voice.source, AL_REFERENCE_DISTANCE, kReference_m);
        alSourcef(voice.source, AL_ROLLOFF_FACTOR, 1);
    }
}

void Voices::tearDown() {
    for (Voice& voice : voices_) {
        if (voice.source) alDeleteSources(1, &voice.source);
        medium_.removeFilter(voice.filter);
        voice = {};
    }
    medium_.tearDown();
}

int Voices::sounding() const {
    return static_cast<int>(std::count_if(voices_.begin(), voices_.end(), [](const Voice& voice) {
        return voice.use != Use::Free && plays(voice.source);
    }));
}

float Voices::heardGain(const Shot& shot, const glm::vec3& listener) {
    return shot.everywhere ? kBedHeard + shot.gain
                           : shot.gain * distanceGain(glm::distance(shot.position, listener));
}

void Voices::release(Voice& voice) {
    alSourceStop(voice.source);
    voice.use = Use::Free;
}

void Voices::place(Voice& voice, const glm::vec3& listener, double age_s) {
    const Shot& shot = voice.shot;
    const glm::vec3 position = shot.position + shot.velocity * static_cast<float>(age_s);
    const glm::vec3 at = shot.everywhere ? glm::vec3(0) : position;
    const glm::vec3 velocity = shot.everywhere ? glm::vec3(0) : shot.velocity;
    alSourcef(voice.source, AL_GAIN, std::clamp(shot.gain, 0.0f, 1.0f));
    alSourcef(voice.source, AL_PITCH, std::clamp(shot.pitch, 0.25f, 4.0f));
    alSourcei(voice.source, AL_SOURCE_RELATIVE, shot.everywhere ? AL_TRUE : AL_FALSE);
    alSource3f(voice.source, AL_POSITION, at.x, at.y, at.z);
    alSource3f(voice.source, AL_VELOCITY, velocity.x, velocity.y, velocity.z);
    medium_.place(voice.source, voice.filter, glm::distance(position, listener), shot.everywhere);
    voice.heard = heardGain({shot.clip, position, shot.gain, shot.pitch, shot.everywhere}, listener);
}

void Voices::start(Voice& voice, const Clips& clips, bool loop) {
    const auto clip = static_cast<size_t>(voice.shot.clip);
    assert(clip < clips.buffers.size());
    const bool stereo = clips.clips[clip].channels == 2;
    alSourcei(voice.source, AL_BUFFER, static_cast<ALint>(clips.buffers[clip]));
    alSourcei(voice.source, AL_LOOPING, loop ? AL_TRUE : AL_FALSE);
    // Stereo goes to the ears as it is, not through the HRTF of two loudspeakers.
    alSourcei(voice.source, AL_DIRECT_CHANNELS_SOFT, stereo ? AL_TRUE : AL_FALSE);
    if (loop) {
        // Each emitter joins its loop somewhere else, so that two of a kind are not one sound twice; and
        // OpenAL Soft glides in what does not start at 0.
        const auto frames = static_cast<uint32_t>(clips.clips[clip].samples.size() / (stereo ? 2 : 1));
        const uint32_t offset = frames > 1 ? 1 + (voice.id * 2654435761u >> 8) % (frames - 1) : 0;
        alSourcei(voice.source, AL_SAMPLE_OFFSET, static_cast<ALint>(offset));
    }
    alSourcePlay(voice.source);
}

Voices::Voice* Voices::voiceFor(float heard) {
    Voice* least = nullptr;
    for (Voice& voice : voices_) {
        if (!voice.source) continue;
        if (voice.use == Use::Free) return &voice;
        if (!least || voice.heard < least->heard) least = &voice;
    }
    if (!least || heard < kTakeOver * least->heard) return nullptr;
    release(*least);
    return least;
}

void Voices::update(const Clips& clips, const glm::vec3& listener, std::span<const Emitter> emitters,
                    std::span<const Shot> shots, double now_s) {
    for (Voice& voice : voices_) {
        if (voice.use == Use::Free) continue;
        if (!plays(voice.source)) {
            voice.use = Use::Free;
        } else if (voice.use == Use::Shot) {
            place(voice, listener, now_s - voice.since_s);
        } else if (voice.use == Use::Ending) {
            if (now_s - voice.since_s > kEnding_s) release(voice);
        } else if (std::none_of(emitters.begin(), emitters.end(),
                                [&](const Emitter& e) { return e.id == voice.id; })) {
            alSourcef(voice.source, AL_GAIN, 0);
            voice.use = Use::Ending;
            voice.since_s = now_s;
            voice.heard = 0;
        }
    }
    for (const Emitter& emitter : emitters) {
        const auto playing = std::find_if(voices_.begin(), voices_.end(), [&](const Voice& voice) {
            return (voice.use == Use::Emitter || voice.use == Use::Ending) && voice.id == emitter.id &&
                   voice.shot.clip == emitter.clip;
        });
        const Shot shot = asShot(emitter);
        Voice* voice = playing != voices_.end() ? &*playing : voiceFor(heardGain(shot, listener));
        if (!voice) continue;
        voice->shot = shot;
        voice->use = Use::Emitter;
        voice->id = emitter.id;
        place(*voice, listener, 0);
        if (playing == voices_.end()) start(*voice, clips, true);
    }
    for (const Shot& shot : shots) {
        Voice* voice = voiceFor(heardGain(shot, listener));
        if (!voice) continue;
        voice->shot = shot;
        voice->use = Use::Shot;
        voice->since_s = now_s;
        place(*voice, listener, 0);
        start(*voice, clips, false);
    }
}

void Voices::setPaused(bool paused) {
    for (const Voice& voice : voices_)
        if (voice.use != Use::Free && plays(voice.source))
            paused ? alSourcePause(voice.source) : alSourcePlay(voice.source);
}

} // namespace shoal::audio
