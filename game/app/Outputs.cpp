#include "game/app/Outputs.h"

#include "engine/core/Log.h"
#include "game/Feel.h"
#include "game/Hear.h"
#include "input/haptics/HapticOutput.h"

#include <optional>

namespace shoal::app {

struct Outputs::State {
    game::Hear hear;
    game::Feel feel;
    float hapticStrength = 1;
    std::optional<audio::Audio> audio;
    std::optional<haptics::HapticOutput> haptics;
    haptics::HapticFrame felt;
    std::vector<HudCaption> captions;

    Status openSound(const OutputOptions& options) {
        auto opened = audio::Audio::open({.headphones = options.headphones, .volume = options.volume});
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
};

Outputs Outputs::open(const OutputOptions& options) {
    auto state = std::make_unique<State>();
    state->hapticStrength = options.hapticStrength;
    if (options.sound)
        if (Status opened = state->openSound(options); !opened)
            log::info("playing on without sound: {}", opened.error().sentence());
    if (options.haptics) state->haptics.emplace(haptics::hidapiBus());
    return Outputs(std::move(state));
}

Outputs::Outputs(std::unique_ptr<State> state) : state_(std::move(state)) {}
Outputs::Outputs(Outputs&&) noexcept = default;
Outputs& Outputs::operator=(Outputs&&) noexcept = default;
Outputs::~Outputs() = default;

void Outputs::frame(const game::Snapshot& shown, std::span<const game::Event> events, float dt_s) {
    State& s = *state_;
    s.hear.listen(shown, events, dt_s);
    if (s.audio)
        s.audio->update({.position = shown.headWorld, .worldFromHead = shown.worldFromView},
                        s.hear.emitters(), s.hear.shots());
    s.felt = s.feel.frame(shown, events, dt_s, s.hapticStrength);
    if (s.haptics) s.haptics->submit(s.felt);
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
