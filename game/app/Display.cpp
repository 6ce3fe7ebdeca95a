#include "game/app/Display.h"

#include <algorithm>
#include <cmath>

namespace shoal::app {

void resize(std::vector<gl::Target>& targets, int count, glm::ivec2 size, int samples) {
    if (targets.size() == static_cast<size_t>(count) && targets[0].width() == size.x &&
        targets[0].height() == size.y)
        return;
    targets.clear();
    for (int i = 0; i < count; ++i) targets.emplace_back(size.x, size.y, samples);
}

ImageRgb8 pictureOf(std::span<const gl::Target> eyes) {
    const int count = static_cast<int>(eyes.size());
    ImageRgb8 picture(eyes[0].width() * count, eyes[0].height());
    for (int eye = 0; eye < count; ++eye) {
        const ImageRgba8 image = eyes[static_cast<size_t>(eye)].read();
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                std::copy_n(image.at(x, y), 3, picture.at(eye * image.width + x, y));
    }
    return picture;
}

double FlatDisplay::period_s() const { return 1 / (window_ ? window_->refreshRate_Hz() : 60.0); }

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
    for (int eye = 0; eye < eyes; ++eye) {
        const float side = eyes == 2 ? (eye == 0 ? -0.5f : 0.5f) * options_.eyeDistance_mm * 1e-3f : 0.0f;
        const render::View view{.eyeWorld = shown.headWorld + shown.worldFromView * glm::vec3(side, 0, 0),
                                .worldFromEye = shown.worldFromView,
                                .verticalFov = glm::radians(options_.fov_deg),
                                .aspect = aspect,
                                .heightPixels = drawnSize.y};
        toDraw.push_back({eye, view, canvases[static_cast<size_t>(eye)]});
    }
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

MenuSurface FlatDisplay::menuSurface() const {
    const int eyes = sideBySide() ? 2 : 1;
    const glm::vec2 size = window_ ? window_->framebufferSize() : options_.look.size;
    return {size / glm::vec2(eyes, 1), eyes};
}

std::array<Pointing, 2> FlatDisplay::pointing(const GameSession& session) const {
    if (!session.tracked) return {};
    const std::array<hands::HandPose, 2> hands = session.tracked->seen();
    const glm::vec2 size = menuSurface().size;
    const float tanY = std::tan(glm::radians(options_.fov_deg) / 2);
    const glm::vec2 tanHalf(tanY * size.x / std::max(size.y, 1.0f), tanY);
    return {pointingInView(hands[0], tanHalf), pointingInView(hands[1], tanHalf)};
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
