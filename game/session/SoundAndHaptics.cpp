#include "game/session/SoundAndHaptics.h"

#include "engine/core/Log.h"
#include "engine/media/SoundTrack.h"
#include "game/feedback/HapticFeedback.h"
#include "game/feedback/SoundCues.h"
#include "input/haptics/HapticOutput.h"

#include <optional>

namespace shoal::app {

struct SoundAndHaptics::State {
    game::SoundCues sounds;
    game::HapticFeedback hapticFeedback;
    float hapticStrength = 1;
    float videoSound = 0;
    std::optional<media::SoundTrack> track; // before the audio, which reads it
    std::optional<audio::Audio> audio;
    std::optional<haptics::HapticOutput> haptics;
    haptics::HapticFrame hapticFrame;

    Status openSound(const SoundAndHapticsOptions& options) {
        auto opened = audio::Audio::open(
            {.headphones = options.headphones, .volume = options.volume, .doppler = options.doppler});
        if (!opened) return opened.error();
        for (const game::SoundRow& row : game::kSounds) {
            auto clip =
                audio::readClip(dataRoot() / "content" / "sounds" / (std::string(row.file) + ".flac"));
            if (!clip) return clip.error();
            opened->add(*clip);
        }
        audio = std::move(*opened);
        return Done{};
    }

    void openVideoSound(const SoundAndHapticsOptions& options) {
        auto opened = media::SoundTrack::open(options.video, options.videoLength_s);
        if (!opened) return log::info("{}", opened.error().message());
        track = std::move(*opened);
        videoSound = options.videoSound;
        audio->setTrack({.length = track->passLength(),
                         .seek = [this](int64_t frame) { track->seek(frame); },
                         .read = [this](std::span<int16_t> stereo) { return track->read(stereo); }});
    }
};

SoundAndHaptics SoundAndHaptics::open(const SoundAndHapticsOptions& options) {
    auto state = std::make_unique<State>();
    state->hapticStrength = options.hapticStrength;
    if (options.sound)
        if (Status opened = state->openSound(options); !opened)
            log::info("playing on without sound: {}", opened.error().message());
    if (state->audio && options.videoSound > 0 && !options.video.empty()) state->openVideoSound(options);
    if (options.haptics) state->haptics.emplace(haptics::hidapiBus());
    return SoundAndHaptics(std::move(state));
}

SoundAndHaptics::SoundAndHaptics(std::unique_ptr<State> state) : state_(std::move(state)) {}
SoundAndHaptics::SoundAndHaptics(SoundAndHaptics&&) noexcept = default;
SoundAndHaptics& SoundAndHaptics::operator=(SoundAndHaptics&&) noexcept = default;
SoundAndHaptics::~SoundAndHaptics() = default;

void SoundAndHaptics::frame(const game::Snapshot& shown, std::span<const game::Event> events, float dt_s,
                            bool attended, double videoPosition_s) {
    State& s = *state_;
    // Haptics first: a touch has the shortest latency that is noticed.
    s.hapticFrame = s.hapticFeedback.frame(shown, events, dt_s, attended ? s.hapticStrength : 0);
    if (s.haptics) s.haptics->submit(s.hapticFrame);
    s.sounds.listen(shown, events, dt_s);
    if (s.audio) {
        s.audio->setPaused(shown.paused);
        s.audio->update({.position = shown.headWorld,
                         .worldFromHead = shown.worldFromView,
                         .enclosure = s.sounds.enclosure()},
                        s.sounds.emitters(), s.sounds.shots());
        s.audio->syncTrack(videoPosition_s, s.videoSound, shown.paused);
    }
}

void SoundAndHaptics::setVolume(float volume) {
    if (state_->audio) state_->audio->setVolume(volume);
}

const haptics::HapticFrame& SoundAndHaptics::hapticFrame() const { return state_->hapticFrame; }
std::span<const game::Caption> SoundAndHaptics::captions() const { return state_->sounds.captions(); }

} // namespace shoal::app
