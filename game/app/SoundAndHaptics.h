// A dive's sound and haptic output is made from the same snapshots and events as its picture. Main thread.
#pragma once

#include "engine/audio/Audio.h"
#include "engine/media/SoundTrack.h"
#include "game/feedback/Feedback.h"
#include "game/settings/PlayOptions.h"
#include "input/haptics/HapticDevices.h"

#include <optional>
#include <span>

namespace shoal::app {

class SoundAndHaptics {
  public:
    // Opens sound and haptics. Without a sound device it is silent, which is logged. The options, whose
    // volumes and strength are read in every frame, must outlive this. music: DiveFile::music. video: the
    // file whose sound plays in step with the picture. Either may be empty: none.
    SoundAndHaptics(const PlayOptions& options, const std::string& music, const Path& video,
                    double videoLength_s);
    SoundAndHaptics(const SoundAndHaptics&) = delete; // the audio holds the track's address
    SoundAndHaptics& operator=(const SoundAndHaptics&) = delete;

    // Outputs a frame. attended: false while another window has the focus, which stops all haptics.
    // videoPosition_s: time of the frame shown since the video's first.
    void frame(const game::Snapshot& shown, const game::Events& events, float dt_s, bool attended,
               double videoPosition_s, const glm::quat& worldFromFilm);
    const haptics::HapticFrame& hapticFrame() const { return hapticFrame_; } // as sent by the last frame()
    // Newest first; valid until the next frame().
    std::span<const game::Caption> captions() const { return sounds_.captions(); }

  private:
    Status openSound();
    Status openMusic(const std::string& theme);
    void openVideoSound(const Path& video, double videoLength_s);

    game::SoundCues sounds_;
    game::HapticFeedback hapticFeedback_;
    const PlayOptions& options_;
    bool hasMusic_ = false;
    float volume_;                           // last volume set on the audio
    std::optional<media::SoundTrack> track_; // declared before the audio, which reads it
    std::optional<audio::Audio> audio_;
    std::optional<haptics::HapticOutput> haptics_;
    haptics::HapticFrame hapticFrame_;
};

} // namespace shoal::app
