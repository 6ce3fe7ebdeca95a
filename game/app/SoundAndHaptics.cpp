#include "game/app/SoundAndHaptics.h"

#include "engine/core/Log.h"

namespace shoal::app {

static Status addClip(audio::Audio& audio, const std::string& name) {
    auto clip = audio::readClip(dataRoot() / "content" / "sounds" / (name + ".flac"));
    if (!clip) return clip.error();
    audio.add(*std::move(clip));
    return Done{};
}

SoundAndHaptics::SoundAndHaptics(const PlayOptions& options, const std::string& music, const Path& video,
                                 double videoLength_s)
    : options_(options), volume_(options.volume) {
    if (!options.mute && !options.headless)
        if (Status opened = openSound(); !opened)
            log::info("playing on without sound: {}", opened.error().message());
    if (audio_ && !music.empty())
        if (Status opened = openMusic(music); !opened)
            log::info("playing on without music: {}", opened.error().message());
    if (audio_ && options.videoSound > 0 && !video.empty()) openVideoSound(video, videoLength_s);
    if (options.hapticStrength > 0 && !options.headless)
        haptics_.emplace(haptics::withForceFeedback(haptics::hidapiBus()));
}

Status SoundAndHaptics::openSound() {
    auto opened = audio::Audio::open({.headphones = options_.headphones, .volume = volume_});
    if (!opened) return opened.error();
    for (const game::SoundRow& row : game::kSounds)
        if (Status added = addClip(*opened, row.file); !added) return added;
    audio_ = std::move(*opened);
    return Done{};
}

Status SoundAndHaptics::openMusic(const std::string& theme) {
    for (const char* layer : game::kMusicLayers)
        if (Status added = addClip(*audio_, "music_" + theme + "_" + layer); !added) return added;
    hasMusic_ = true;
    return Done{};
}

void SoundAndHaptics::openVideoSound(const Path& video, double videoLength_s) {
    auto opened = media::SoundTrack::open(video, videoLength_s);
    if (!opened) { // a dive's own film needs no sound
        if (!options_.environment.isOwnVideo()) log::info("{}", opened.error().message());
        return;
    }
    track_ = std::move(*opened);
    audio_->setTrack({.length = track_->passLength(),
                      .channels = track_->channels(),
                      .seek = [this](int64_t frame) { track_->seek(frame); },
                      .read = [this](std::span<int16_t> samples) { return track_->read(samples); }});
}

void SoundAndHaptics::frame(const game::Snapshot& shown, const game::Events& events, float dt_s,
                            bool attended, double videoPosition_s, const glm::quat& worldFromFilm) {
    // Haptics come first: a touch has the shortest latency that is noticed.
    hapticFrame_ = hapticFeedback_.frame(shown, events, dt_s, attended ? options_.hapticStrength : 0);
    if (haptics_) haptics_->submit(hapticFrame_);
    const bool plays = hasMusic_ && (options_.freeSwimMusic || !shown.freeSwim);
    sounds_.listen(shown, events, dt_s, options_.effects, plays ? options_.music : 0);
    if (!audio_) return;
    if (volume_ != options_.volume) audio_->setVolume(volume_ = options_.volume);
    audio_->setPaused(shown.paused);
    audio_->update({.position = shown.headWorld,
                    .worldFromHead = shown.worldFromView,
                    .worldFromTrack = worldFromFilm,
                    .enclosure = sounds_.enclosure()},
                   sounds_.emitters(), sounds_.shots());
    audio_->syncTrack(videoPosition_s, track_ ? options_.videoSound : 0, shown.paused);
}

} // namespace shoal::app
