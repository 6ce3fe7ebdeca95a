#include "game/app/Outputs.h"

#include "engine/core/Log.h"
#include "engine/media/SoundTrack.h"
#include "game/Feel.h"
#include "game/Hear.h"
#include "input/haptics/HapticOutput.h"

#include <optional>

namespace shoal::app {

struct Outputs::State {
    game::Hear hear;
    game::Feel feel;
    float hapticStrength = 1;
    float videoSound = 0;
    std::optional<media::SoundTrack> track; // before the audio, which reads it
    std::optional<audio::Audio> audio;
    std::optional<haptics::HapticOutput> haptics;
    haptics::HapticFrame felt;
    std::vector<HudCaption> captions;

    Status openSound(const OutputOptions& options) {
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

    void openVideoSound(const OutputOptions& options) {
        auto opened = media::SoundTrack::open(options.video, options.videoLength_s);
        if (!opened) return log::info("{}", opened.error().sentence());
        track = std::move(*opened);
        videoSound = options.videoSound;
        audio->setAccompaniment({.length = track->passLength(),
                                 .seek = [this](int64_t frame) { track->seek(frame); },
                                 .read = [this](std::span<int16_t> stereo) { return track->read(stereo); }});
    }
};

Outputs Outputs::open(const OutputOptions& options) {
    auto state = std::make_unique<State>();
    state->hapticStrength = options.hapticStrength;
    if (options.sound)
        if (Status opened = state->openSound(options); !opened)
            log::info("playing on without sound: {}", opened.error().sentence());
    if (state->audio && options.videoSound > 0 && !options.video.empty()) state->openVideoSound(options);
    if (options.haptics) state->haptics.emplace(haptics::hidapiBus());
    return Outputs(std::move(state));
}

Outputs::Outputs(std::unique_ptr<State> state) : state_(std::move(state)) {}
Outputs::Outputs(Outputs&&) noexcept = default;
Outputs& Outputs::operator=(Outputs&&) noexcept = default;
Outputs::~Outputs() = default;

void Outputs::frame(const game::Snapshot& shown, std::span<const game::Event> events, float dt_s,
                    bool attended, double videoPosition_s) {
    State& s = *state_;
    // First what is felt: a touch is to be written before anything else is done.
    s.felt = s.feel.frame(shown, events, dt_s, attended ? s.hapticStrength : 0);
    if (s.haptics) s.haptics->submit(s.felt);
    s.hear.listen(shown, events, dt_s);
    if (s.audio) {
        s.audio->setPaused(shown.paused);
        s.audio->update(
            {.position = shown.headWorld, .worldFromHead = shown.worldFromView, .shelter = s.hear.shelter()},
            s.hear.emitters(), s.hear.shots());
        s.audio->accompany(videoPosition_s, s.videoSound, shown.paused);
    }
    s.captions.clear();
    for (const game::Caption& caption : s.hear.captions())
        s.captions.push_back({caption.text, caption.position, caption.age_s});
}

void Outputs::setVolume(float volume) {
    if (state_->audio) state_->audio->setVolume(volume);
}

const haptics::HapticFrame& Outputs::felt() const { return state_->felt; }
std::span<const HudCaption> Outputs::captions() const { return state_->captions; }

} // namespace shoal::app
