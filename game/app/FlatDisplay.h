// A display in a window or off screen, of one eye or of both side by side.
#pragma once

#include "engine/platform/Window.h"
#include "game/app/Display.h"
#include "game/settings/PlayOptions.h"

#include <vector>

namespace shoal::app {

class FlatDisplay : public Display {
  public:
    // window: null off screen; it and the options must outlive this. samples: for anti-aliasing.
    FlatDisplay(platform::Window* window, const PlayOptions& options, int samples)
        : window_(window), options_(options), samples_(samples) {}

    Status begin() override { return Done{}; }
    double period_s() const override;
    Result<bool> draw(const Painter& painter, const game::Snapshot& shown, float scale) override;
    void present() override;
    MenuSurface menuSurface() const override;
    std::array<Pointing, 2> pointing(const GameSession& session) const override;
    std::span<const gl::Target> pictures() const override { return targets_; }

  private:
    bool sideBySide() const { return options_.stereo == StereoOutput::SideBySide; }
    render::View viewOf(int eye, const game::Snapshot& shown, glm::ivec2 drawnSize, float aspect) const;

    platform::Window* window_;
    const PlayOptions& options_;
    int samples_;
    std::vector<gl::Target> targets_;        // one per eye
    std::vector<gl::Target> reducedTargets_; // enlarged to targets_ while `scale` is below 1
};

} // namespace shoal::app
