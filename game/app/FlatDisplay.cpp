#include "game/app/FlatDisplay.h"

#include <algorithm>

namespace shoal::app {

void resize(std::vector<gl::Target>& targets, int count, glm::ivec2 size, int samples) {
    if (targets.size() == static_cast<size_t>(count) && targets[0].width() == size.x &&
        targets[0].height() == size.y)
        return;
    targets.clear();
    for (int i = 0; i < count; ++i) targets.emplace_back(size.x, size.y, samples);
}

double FlatDisplay::period_s() const { return 1 / (window_ ? window_->refreshRate_Hz() : 60.0); }

render::View FlatDisplay::viewOf(int eye, const game::Snapshot& shown, glm::ivec2 drawnSize,
                                 float aspect) const {
    render::View view;
    view.worldFromEye = shown.worldFromView;
    const float side = sideBySide() ? (eye == 0 ? -0.5f : 0.5f) * options_.eyeDistance_mm * 1e-3f : 0.0f;
    view.eyeWorld = shown.headWorld + view.worldFromEye * glm::vec3(side, 0, 0);
    view.verticalFov = glm::radians(options_.fov_deg);
    view.aspect = aspect;
    view.heightPixels = drawnSize.y;
    return view;
}

Result<bool> FlatDisplay::draw(const Painter& painter, const game::Snapshot& shown, float scale) {
    const glm::ivec2 size = window_ ? window_->framebufferSize() : options_.look.size;
    if (size.x <= 0 || size.y <= 0) return false; // minimised
    const int eyes = sideBySide() ? 2 : 1;
    const glm::ivec2 eyeSize(std::max(1, size.x / eyes), size.y);
    const glm::ivec2 drawnSize(glm::max(glm::vec2(eyeSize) * scale + 0.5f, 1.0f));
    resize(targets_, eyes, eyeSize, samples_);
    if (scale == 1)
        reducedTargets_.clear();
    else
        resize(reducedTargets_, eyes, drawnSize, samples_);
    const std::vector<gl::Target>& canvases = reducedTargets_.empty() ? targets_ : reducedTargets_;
    const float aspect = static_cast<float>(eyeSize.x) / static_cast<float>(eyeSize.y);
    std::vector<SceneRenderer::Eye> toDraw;
    for (int eye = 0; eye < eyes; ++eye)
        toDraw.push_back({eye, viewOf(eye, shown, drawnSize, aspect), canvases[static_cast<size_t>(eye)]});
    const Status drawn = painter.scene(toDraw, [&](const render::EyePicture& eye) {
        if (!reducedTargets_.empty()) {
            const gl::Target& target = targets_[static_cast<size_t>(eye.eye)];
            eye.canvas.blitTo(target.framebuffer(), 0, eyeSize.x, eyeSize.y);
            target.bind();
        }
        painter.hud(HudPart::All, Audience::WindowPlayer, eye.view, eyeSize);
    });
    if (!drawn) return drawn.error();
    return true;
}

void FlatDisplay::present() {
    if (!window_) return;
    const glm::ivec2 size = window_->framebufferSize();
    const int eyes = static_cast<int>(targets_.size());
    for (int eye = 0; eye < eyes; ++eye)
        targets_[static_cast<size_t>(eye)].blitTo(0, eye * size.x / eyes, size.x / eyes, size.y);
    window_->present();
}

} // namespace shoal::app
