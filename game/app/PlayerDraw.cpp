// One frame of the dive: into a window or none, side by side, or into a headset.
#include "game/app/Player.h"

#include "engine/media/Pictures.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <variant>

namespace shoal::app {

namespace {

constexpr float kHintTime_s = 7;

} // namespace

render::Exposure Player::exposure() const {
    return {options.look.tone == "aces"     ? render::ToneCurve::Aces
            : options.look.tone == "linear" ? render::ToneCurve::Linear
                                            : surround->naturalTone(),
            plan.dive.exposure_ev + options.look.exposure_ev};
}

render::Glossy Player::glossy() const {
    return options.look.glossy == "phong36" ? render::Glossy::PhongRings : render::Glossy::Prefiltered;
}

Stage::Eye Player::eyeOf(int eye, const render::View& view, glm::ivec2 size) const {
    return {*surround, eye, view, exposure(), surround->water(), glossy(), size};
}

HudInfo Player::hudInfo(const Run& run, const render::View& view) const {
    const auto* mouse = std::get_if<MouseSource>(&run.source);
    const bool unused = mouse ? !mouse->used() : playedByAPerson(run.source) && run.shown.caught == 0;
    return {.snapshot = &run.shown,
            .view = &view,
            .captions = options.captions ? outputs->captions() : std::span<const HudCaption>(),
            .bestScore = best,
            .newBest = newBest,
            .showHints = unused && run.shown.time_s < kHintTime_s,
            .showTimes = showTimes,
            .times = &times,
            .lightName = surround->lightName(),
            .renderer = statistics.renderer,
            .notice = surround->notice().empty() && run.tracked ? run.tracked->caption()
                                                                : std::string_view(surround->notice()),
            .volume = volume,
            .showVolume = glfwGetTime() - volumeShown_s < 1.5 && window.has_value()};
}

// Both eyes, the panel with the text, and the window for those who look on. size: of the window.
Status Player::drawHeadset(const Run& run, glm::ivec2 size) {
    stage->set(run.shown, *surround, options.backdropOnly);
    const auto hudOn = [&](HudPart part, const render::View& view, glm::ivec2 pixels) {
        if (options.backdropOnly) return;
        HudInfo info = hudInfo(run, view);
        info.part = part;
        info.headset = true;
        info.showTimes &= part == HudPart::Panel;
        hud->draw(info, pixels);
    };
    const Quality quality = governor ? governor->quality() : Quality();
    Status drawn = headset->draw(
        {.scene = [&](int eye, const render::View& view, const gl::Target& canvas) -> Status {
             const Stage::Eye seen = eyeOf(eye, view, {canvas.width(), canvas.height()});
             if (Status s = stage->drawLayer(seen); !s) return s;
             canvas.bind();
             if (Status s = stage->drawBackdrop(seen); !s) return s;
             return stage->drawObjects(seen);
         },
         .marks = [&](const render::View& view, glm::ivec2 pixels) { hudOn(HudPart::Marks, view, pixels); },
         .panel = [&](const render::View& view, glm::ivec2 pixels) { hudOn(HudPart::Panel, view, pixels); }},
        quality.scale, size);
    if (!drawn || !headset->drew()) return drawn;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.x, size.y);
    if (!options.backdropOnly && size.x > 0 && size.y > 0) {
        HudInfo info = hudInfo(run, headset->windowView());
        info.part = HudPart::Panel; // the marks are in the picture already
        info.showHints = false;
        hud->draw(info, size);
    }
    times.draws = stage->drawCount();
    times.triangles = stage->triangleCount();
    times.quality = quality;
    return Done{};
}

Status Player::drawFrame(const Run& run, glm::ivec2 size) {
    const int eyes = stereo() ? 2 : 1;
    const glm::ivec2 eyeSize(std::max(1, size.x / eyes), std::max(1, size.y));
    if (targets.size() != static_cast<size_t>(eyes) || targets[0].width() != eyeSize.x ||
        targets[0].height() != eyeSize.y) {
        targets.clear();
        for (int eye = 0; eye < eyes; ++eye) targets.emplace_back(eyeSize.x, eyeSize.y, samples);
    }
    const Quality quality = governor ? governor->quality() : Quality();
    const glm::ivec2 drawnSize(glm::max(glm::vec2(eyeSize) * quality.scale + 0.5f, 1.0f));
    if (quality.scale == 1) {
        coarse.clear();
    } else if (coarse.size() != targets.size() || coarse[0].width() != drawnSize.x ||
               coarse[0].height() != drawnSize.y) {
        coarse.clear();
        for (int eye = 0; eye < eyes; ++eye) coarse.emplace_back(drawnSize.x, drawnSize.y, samples);
    }
    stage->set(run.shown, *surround, options.backdropOnly);
    const std::vector<gl::Target>& canvases = coarse.empty() ? targets : coarse;
    const auto seenBy = [&](int eye) {
        render::View view;
        view.worldFromEye = run.shown.worldFromView;
        const float side = eyes == 2 ? (eye == 0 ? -0.5f : 0.5f) * options.eyeDistance_mm * 1e-3f : 0.0f;
        view.eyeWorld = run.shown.headWorld + view.worldFromEye * glm::vec3(side, 0, 0);
        view.verticalFov = glm::radians(options.fov_deg);
        view.aspect = static_cast<float>(eyeSize.x) / static_cast<float>(eyeSize.y);
        view.heightPixels = drawnSize.y;
        return eyeOf(eye, view, drawnSize);
    };
    const std::array<Stage::Eye, 2> both = {seenBy(0), seenBy(1)};
    const std::span seen = std::span(both).first(static_cast<size_t>(eyes));
    stage->beginBackdrop(seen[0]);
    for (const Stage::Eye& eye : seen)
        if (Status drawn = stage->drawLayer(eye); !drawn) return drawn;
    for (const Stage::Eye& eye : seen) {
        const auto index = static_cast<size_t>(eye.eye);
        const gl::Target &target = targets[index], &canvas = canvases[index];
        // The backdrop is infinitely far: parallel eyes see the same of it, and copying is quicker than
        // drawing.
        const bool shared =
            eyes == 2 && samples == 1 && surround->eyesSeeTheSame() && stage->eyesShareBackdrop();
        if (!shared || eye.eye == 0) {
            canvas.bindColour();
            if (Status drawn = stage->drawBackdrop(eye); !drawn) return drawn;
        }
        if (shared && eye.eye == 0) canvas.blitTo(canvases[1].framebuffer(), 0, drawnSize.x, drawnSize.y);
        if (stage->needsDepth(eye)) {
            glFlush(); // its pixels are drawn while the objects' vertices are shaded
            canvas.bind();
        } else if (shared) {
            canvas.bindColour();
        }
        if (Status drawn = stage->drawObjects(eye); !drawn) return drawn;
        if (!coarse.empty()) {
            canvas.blitTo(target.framebuffer(), 0, eyeSize.x, eyeSize.y);
            target.bind();
        }
        if (!options.backdropOnly) hud->draw(hudInfo(run, eye.view), eyeSize);
    }
    times.draws = stage->drawCount();
    times.quality = quality;
    times.triangles = stage->triangleCount();
    return Done{};
}

Status Player::saveScreenshot() {
    const std::span<const gl::Target> shown = drawn();
    const ImageRgba8 left = shown[0].read();
    const int eyes = static_cast<int>(shown.size());
    ImageRgb8 picture(left.width * eyes, left.height);
    for (int eye = 0; eye < eyes; ++eye) {
        const ImageRgba8 image = eye == 0 ? left : shown[static_cast<size_t>(eye)].read();
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                std::copy_n(image.at(x, y), 3, picture.at(eye * left.width + x, y));
    }
    return media::writePng(options.screenshot, picture);
}

} // namespace shoal::app
