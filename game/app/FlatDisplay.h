// Pictures in a window or off screen, of one eye or of both side by side.
#pragma once

#include "engine/platform/Window.h"
#include "game/app/Display.h"

#include <vector>

namespace shoal::app {

struct FlatDisplayOptions {
    glm::ivec2 size{0}; // pixels, without a window
    bool sideBySide = false;
    float verticalFov = 1; // radians
    float eyeDistance_m = 0.064f;
    int samples = 1; // for anti-aliasing
};

class FlatDisplay : public Display {
  public:
    // window: null off screen; must outlive this.
    FlatDisplay(platform::Window* window, const FlatDisplayOptions& options)
        : window_(window), options_(options) {}

    Status begin() override { return Done{}; }
    double period_s() const override;
    Result<bool> draw(const Painter& painter, const game::Snapshot& shown, float scale) override;
    void present() override;
    std::span<const gl::Target> pictures() const override { return targets_; }

  private:
    render::View viewOf(int eye, const game::Snapshot& shown, glm::ivec2 drawnSize, float aspect) const;

    platform::Window* window_;
    FlatDisplayOptions options_;
    std::vector<gl::Target> targets_;        // one per eye
    std::vector<gl::Target> reducedTargets_; // what those are enlarged from, while `scale` is below 1
};

} // namespace shoal::app
