#include "engine/audio/UnderwaterEffects.h"

#include <algorithm>
#include <cmath>

namespace shoal::audio {

namespace {

constexpr float kSpeed_mps = 1500;                         // of sound in water, 4.4 times that in air
constexpr float kReverbOpen = 0.12f, kReverbTunnel = 0.8f; // reverberation gain

template <class Function> bool load(Function& function, const char* name) {
    function = reinterpret_cast<Function>(alGetProcAddress(name));
    return function != nullptr;
}

} // namespace

float highGain(float distance_m) {
    return std::max(kHighNear * std::exp(-distance_m / kHighFade_m), kHighMin);
}

float distanceGain(float distance_m) { return kReference_m / std::max(distance_m, kReference_m); }

void UnderwaterEffects::setUp(float doppler) {
    alDistanceModel(AL_INVERSE_DISTANCE_CLAMPED);
    alSpeedOfSound(kSpeed_mps);
    alDopplerFactor(std::max(doppler, 0.0f));
    LPALGENEFFECTS genEffects{};
    LPALEFFECTI effecti{};
    LPALEFFECTF effectf{};
    LPALGENAUXILIARYEFFECTSLOTS genSlots{};
    LPALAUXILIARYEFFECTSLOTI sloti{};
    if (!load(filteri_, "alFilteri") || !load(filterf_, "alFilterf") ||
        !load(deleteFilters_, "alDeleteFilters") || !load(genFilters_, "alGenFilters")) {
        genFilters_ = nullptr;
        return;
    }
    if (!load(genEffects, "alGenEffects") || !load(effecti, "alEffecti") || !load(effectf, "alEffectf") ||
        !load(genSlots, "alGenAuxiliaryEffectSlots") || !load(sloti, "alAuxiliaryEffectSloti") ||
        !load(slotf_, "alAuxiliaryEffectSlotf"))
        return;
    genEffects(1, &reverb_);
    effecti(reverb_, AL_EFFECT_TYPE, AL_EFFECT_REVERB);
    effectf(reverb_, AL_REVERB_DECAY_TIME, 2.2f);
    effectf(reverb_, AL_REVERB_DECAY_HFRATIO, 0.3f);
    effectf(reverb_, AL_REVERB_GAINHF, 0.15f);
    genSlots(1, &slot_);
    sloti(slot_, AL_EFFECTSLOT_EFFECT, static_cast<ALint>(reverb_));
    applyReverbGain();
}

// Interpolated geometrically, because loudness is perceived on a logarithmic scale.
void UnderwaterEffects::applyReverbGain() const {
    if (slot_)
        slotf_(slot_, AL_EFFECTSLOT_GAIN,
               silent_ ? 0 : kReverbOpen * std::pow(kReverbTunnel / kReverbOpen, enclosure_));
}

void UnderwaterEffects::setEnclosure(float enclosure) {
    enclosure = std::clamp(enclosure, 0.0f, 1.0f);
    if (enclosure == enclosure_) return;
    enclosure_ = enclosure;
    applyReverbGain();
}

void UnderwaterEffects::setSilent(bool silent) {
    if (silent == silent_) return;
    silent_ = silent;
    applyReverbGain();
}

ALuint UnderwaterEffects::makeFilter() const {
    if (!genFilters_) return 0;
    ALuint filter = 0;
    genFilters_(1, &filter);
    filteri_(filter, AL_FILTER_TYPE, AL_FILTER_LOWPASS);
    return filter;
}

void UnderwaterEffects::place(ALuint source, ALuint filter, float distance_m, bool everywhere) const {
    if (!filter) return;
    filterf_(filter, AL_LOWPASS_GAINHF, everywhere ? 1.0f : highGain(distance_m));
    alSourcei(source, AL_DIRECT_FILTER, static_cast<ALint>(filter));
    const ALuint send = everywhere ? static_cast<ALuint>(AL_EFFECTSLOT_NULL) : slot_;
    alSource3i(source, AL_AUXILIARY_SEND_FILTER, static_cast<ALint>(send), 0, AL_FILTER_NULL);
}

void UnderwaterEffects::removeFilter(ALuint filter) const {
    if (filter) deleteFilters_(1, &filter);
}

void UnderwaterEffects::tearDown() {
    LPALDELETEAUXILIARYEFFECTSLOTS deleteSlots{};
    LPALDELETEEFFECTS deleteEffects{};
    if (slot_ && load(deleteSlots, "alDeleteAuxiliaryEffectSlots")) deleteSlots(1, &slot_);
    if (reverb_ && load(deleteEffects, "alDeleteEffects")) deleteEffects(1, &reverb_);
    slot_ = reverb_ = 0;
}

} // namespace shoal::audio
