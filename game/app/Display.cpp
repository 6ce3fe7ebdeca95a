#include "game/app/Display.h"

#include "engine/core/Log.h"
#include "engine/xr/Tracked.h"
#include "input/hands/OpenXrHands.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace shoal::app {

// The panel spans 53 by 37 degrees at 1.5 m with 18 pixels a degree, about as headsets have: a line of text
// is 1.5 degrees high.
constexpr glm::ivec2 kPanelPixels(960, 640);
constexpr glm::vec2 kPanel_m(1.5f, 1.0f);
constexpr glm::vec4 kDark(0.01f, 0.05f, 0.08f, 1); // display values; deep water
constexpr glm::vec4 kClear(0);                     // transparent: the room shows through
constexpr double kNoRoom_s = 5;
constexpr auto kIdle = std::chrono::milliseconds(10);

// Returns the size of the largest central part of a picture with the shape of the window.
static glm::ivec2 croppedTo(glm::ivec2 picture, glm::ivec2 window) {
    const double shape = static_cast<double>(window.x) / window.y;
    const glm::ivec2 wide(picture.x, std::max(1, static_cast<int>(std::lround(picture.x / shape))));
    if (wide.y <= picture.y) return wide;
    return {std::max(1, static_cast<int>(std::lround(picture.y * shape))), picture.y};
}

// Returns whether the index finger is straight: root and tip are almost a finger's length apart.
static bool points(const hands::HandPose& hand) {
    constexpr float kStretched = 0.93f;
    const hands::FingerJoints& index = hands::kFingerJoints[1];
    const auto at = [&](int joint) { return hand.joints[joint].position; };
    float bones_m = 0;
    for (int joint = index.proximal; joint < index.tip; ++joint)
        bones_m += glm::distance(at(joint), at(joint + 1));
    return glm::distance(at(index.proximal), at(index.tip)) > kStretched * bones_m;
}

// Replaces the targets by `count` new ones of this size, unless they have this count and size already.
static void resize(std::vector<gl::Target>& targets, int count, glm::ivec2 size, int samples) {
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
        const ImageRgba8 image = eyes[eye].read();
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                std::copy_n(image.at(x, y), 3, picture.at(eye * image.width + x, y));
    }
    return picture;
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
    for (int eye = 0; eye < eyes; ++eye) {
        const float side = eyes == 2 ? (eye == 0 ? -0.5f : 0.5f) * options_.eyeDistance_mm * 1e-3f : 0.0f;
        const render::View view{.eyeWorld = shown.headWorld + shown.worldFromView * glm::vec3(side, 0, 0),
                                .worldFromEye = shown.worldFromView,
                                .verticalFov = glm::radians(options_.fov_deg),
                                .aspect = aspect,
                                .heightPixels = drawnSize.y};
        toDraw.push_back({eye, view, canvases[eye]});
    }
    const Status drawn = painter.renderer.draw(toDraw, [&](const render::EyePicture& eye) {
        if (!reducedTargets_.empty()) {
            const gl::Target& target = targets_[eye.eye];
            eye.canvas.blitTo(target.framebuffer(), 0, eyeSize.x, eyeSize.y);
            target.bind();
        }
        painter.hud(HudPart::All, Audience::WindowPlayer, eye.view, eyeSize);
    });
    if (!drawn) return drawn.error();
    return true;
}

std::array<Pointing, 2> FlatDisplay::pointing(const GameSession& session) const {
    if (!session.tracked) return {};
    const std::array<hands::HandPose, 2> hands = session.tracked->seen();
    const glm::vec2 tanHalf = halfExtentOf(menuSurface().size, options_.fov_deg);
    return {pointingInView(hands[0], tanHalf), pointingInView(hands[1], tanHalf)};
}

void FlatDisplay::present() {
    if (!window_) return;
    const glm::ivec2 size = window_->framebufferSize();
    const int eyes = static_cast<int>(targets_.size());
    for (int eye = 0; eye < eyes; ++eye) targets_[eye].blitTo(0, eye * size.x / eyes, size.x / eyes, size.y);
    window_->present();
}

void HeadsetPause::step(const HeadsetMoment& now, float dt_s, bool& paused, bool& restart) {
    fade_ = std::clamp(fade_ + (now.headTracked ? -dt_s / kFadeIn_s : dt_s / kFadeOut_s), 0.0f, 1.0f);
    followHeadset(now, dt_s, paused);
    if (now.menu && !menuWasDown_ && now.plays && begun_ && !now.results) {
        paused = !paused;
        endsByItself_ = false;
    }
    menuWasDown_ = now.menu;
    readFists(now, dt_s, paused, restart);
}

void HeadsetPause::followHeadset(const HeadsetMoment& now, float dt_s, bool& paused) {
    if (now.plays && now.headTracked) {
        steady_s_ += dt_s;
        if (begun_ && !(paused && endsByItself_)) return;
        const bool steady = steady_s_ >= kSteady_s;
        begun_ |= steady;
        paused = endsByItself_ = !steady;
        return;
    }
    steady_s_ = 0;
    const bool takenOff = !now.plays && begun_;
    if (!paused || takenOff) endsByItself_ = !takenOff;
    paused = true;
}

void HeadsetPause::readFists(const HeadsetMoment& now, float dt_s, bool& paused, bool& restart) {
    const bool asks = now.plays && (now.results || (paused && !endsByItself_));
    if (!asks || !asked_) {
        opened_ = {};
        fist_s_ = {};
    }
    asked_ = asks;
    if (!asks) return;
    for (size_t i = 0; i < 2; ++i) {
        if (now.grip[i] >= 0 && now.grip[i] < kOpen) opened_[i] = true;
        fist_s_[i] = opened_[i] && now.grip[i] > kFist ? fist_s_[i] + dt_s : 0;
    }
    if (now.results) {
        restart |= std::min(fist_s_[0], fist_s_[1]) >= kRestart_s;
        if (restart) fist_s_ = {};
    } else if (std::max(fist_s_[0], fist_s_[1]) >= kResume_s) {
        paused = false;
    }
}

Result<HeadsetDisplay> HeadsetDisplay::open(platform::Window& window, const hands::HandRig& rig,
                                            int samples) {
    auto passes = render::HeadsetPasses::make();
    if (!passes) return passes.error();
    auto headset = xr::Headset::open(kPanelPixels);
    if (!headset) return headset.error();
    log::debug("playing in {}, {}", headset->properties().name,
               headset->properties().bareHands ? "with bare hands or controllers" : "with controllers");
    return HeadsetDisplay(window, rig, std::move(*headset), std::move(*passes), samples);
}

Status HeadsetDisplay::begin() {
    elapsed_s_ = 0;
    if (Status polled = headset_.poll(); !polled) return polled;
    if (!headset_.wantsFrames()) {
        std::this_thread::sleep_for(kIdle); // the headset wants no frame now
        last_ns_ = 0;
        return Done{};
    }
    const auto frame = headset_.waitFrame();
    if (!frame) return frame.error();
    frame_ = *frame;
    waiting_ = true;
    if (last_ns_ != 0) elapsed_s_ = static_cast<double>(frame_.display_ns - last_ns_) * 1e-9;
    last_ns_ = frame_.display_ns;
    clock_s_ += elapsed_s_;
    noRoom_s_ -= elapsed_s_;
    return Done{};
}

void HeadsetDisplay::feed(GameSession& session) {
    const xr::Tracking& tracking = headset_.tracking();
    const auto poses = hands::openXrHands(*rig_, tracking);
    HeadsetMoment now{.plays = headset_.plays(),
                      .headTracked = tracking.headTracked,
                      .results = session.after.phase == game::Phase::Results};
    for (size_t i = 0; i < poses.size(); ++i) {
        now.menu |= tracking.controllers[i].menu;
        // A pointing hand counts as open, although its other fingers are closed: it chooses in a menu.
        if (poses[i].tracked) now.grip[i] = points(poses[i]) ? 0 : poses[i].grip;
        pointing_[i] = pointingOf(i, poses[i]);
    }
    pause_.step(now, static_cast<float>(elapsed_s_), session.paused, session.restart);
    if (session.restart) {
        session.paused = false;
        recentre(); // centres the new dive on the player's place now
    }
    session.head = tracking.worldFromHead;
    if (auto* source = std::get_if<OpenXrSource>(&session.source)) source->frame(poses);
}

const game::Notice* HeadsetDisplay::notice() const {
    static const game::Notice kPositionLost{
        "The headset has lost your place: for now you can only look around"};
    static const game::Notice kNoRoom{"This headset cannot show your own room"};
    if (noRoom_s_ > 0) return &kNoRoom;
    const xr::Tracking& tracking = headset_.tracking();
    return tracking.headTracked && tracking.positionLost ? &kPositionLost : nullptr;
}

bool HeadsetDisplay::showRoom(bool wanted) {
    const bool can = headset_.properties().seesRoom;
    surroundings_ = wanted && can ? render::Surroundings::Room : render::Surroundings::Film;
    noRoom_s_ = wanted && !can ? kNoRoom_s : 0;
    return can || !wanted;
}

MenuSurface HeadsetDisplay::menuSurface() const { return {kPanelPixels, 1, false}; }

// Returns where the line from the head through the fingertip meets the panel. For a hand that holds a
// controller the palm points instead, as the trigger moves the finger.
Pointing HeadsetDisplay::pointingOf(size_t side, const hands::HandPose& hand) const {
    constexpr float kPulled = 0.6f, kBefore_m = 0.05f;
    if (!hand.tracked) return {};
    const bool bare = headset_.tracking().hands[side].tracked;
    const int joint = bare ? hands::kFingerJoints[1].tip : hands::kPalmJoint;
    const xr::Pose panelFromHead = xr::inverse(worldFromPanel_) * headset_.tracking().worldFromHead;
    const glm::vec3 head = panelFromHead.position;
    const glm::vec3 tip = head + panelFromHead.orientation * hand.joints[joint].position;
    const float forward_m = head.z - tip.z; // the panel's +Z leads to the player
    if (head.z < kBefore_m || forward_m < kBefore_m) return {};
    const glm::vec2 onPanel = glm::vec2(head) + glm::vec2(tip - head) * (head.z / forward_m);
    const glm::vec2 share = onPanel / kPanel_m;
    return {true,
            {0.5f + share.x, 0.5f - share.y},
            forward_m,
            !bare && headset_.tracking().controllers[side].trigger > kPulled};
}

Status HeadsetDisplay::drawEyes(const Painter& painter, glm::ivec2 windowSize) {
    std::vector<SceneRenderer::Eye> eyes;
    for (int eye = 0; eye < 2; ++eye) {
        const gl::Target& target = targets_[eye];
        render::View view = xr::viewOf(headset_.tracking().eyes[eye]);
        view.heightPixels = target.height();
        eyes.push_back({eye, view, target, surroundings_, headset_.tracking().floor_m});
    }
    if (Status drawn = painter.renderer.draw(eyes); !drawn) return drawn;
    for (const SceneRenderer::Eye& eye : eyes)
        if (Status shown = showEye(eye, painter, windowSize); !shown) return shown;
    return Done{};
}

Status HeadsetDisplay::showEye(const SceneRenderer::Eye& drawnEye, const Painter& painter,
                               glm::ivec2 windowSize) {
    const int eye = drawnEye.eye;
    const render::View& view = drawnEye.view;
    const gl::Target& target = drawnEye.canvas;
    const glm::ivec2 size(target.width(), target.height());
    target.bind();
    painter.hud(HudPart::Marks, Audience::HeadsetPlayer, view, size);
    passes_.fade(surroundings_ == render::Surroundings::Room ? kClear : kDark, pause_.fade());

    const xr::Picture picture = eye == 0 ? xr::Picture::LeftEye : xr::Picture::RightEye;
    const auto framebuffer = headset_.acquire(picture);
    if (!framebuffer) return framebuffer.error();
    if (surroundings_ == render::Surroundings::Room)
        passes_.premultiply(target, *framebuffer);
    else
        target.blitTo(*framebuffer, 0, size.x, size.y);
    if (eye == 0 && windowSize.x > 0 && windowSize.y > 0) mirror(target, *framebuffer, windowSize, view);
    if (Status released = headset_.release(picture); !released || !headset_.properties().takesDepth)
        return released;
    const xr::Picture depth = eye == 0 ? xr::Picture::LeftDepth : xr::Picture::RightDepth;
    const auto depthBuffer = headset_.acquire(depth);
    if (!depthBuffer) return depthBuffer.error();
    if (Status drawn = painter.renderer.drawDepth(drawnEye, *depthBuffer); !drawn) return drawn;
    planes_ = {view.near_m, view.far_m};
    return headset_.release(depth);
}

// Copies the middle of the left eye's picture to the window.
void HeadsetDisplay::mirror(const gl::Target& target, uint32_t framebuffer, glm::ivec2 windowSize,
                            const render::View& view) {
    const glm::ivec2 size(target.width(), target.height());
    const glm::ivec2 part = croppedTo(size, windowSize), corner = (size - part) / 2;
    windowView_ = view;
    windowView_.verticalFov =
        2 * std::atan(view.halfExtent().y * static_cast<float>(part.y) / static_cast<float>(size.y));
    windowView_.aspect = static_cast<float>(windowSize.x) / static_cast<float>(windowSize.y);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(corner.x, corner.y, corner.x + part.x, corner.y + part.y, 0, 0, windowSize.x,
                      windowSize.y, GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

Status HeadsetDisplay::drawPanel(const Painter& painter) {
    const auto framebuffer = headset_.acquire(xr::Picture::Panel);
    if (!framebuffer) return framebuffer.error();
    glBindFramebuffer(GL_FRAMEBUFFER, *framebuffer);
    glViewport(0, 0, kPanelPixels.x, kPanelPixels.y);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    const xr::Pose& head = headset_.tracking().worldFromHead;
    // The view has the panel's angular size, so that captions know which sounds lie beyond the panel's edges.
    painter.hud(HudPart::Panel, Audience::HeadsetPlayer,
                {.eyeWorld = head.position,
                 .worldFromEye = head.orientation,
                 .verticalFov = 2 * std::atan(kPanel_m.y / 2 / PanelPlacement::kDistance_m),
                 .aspect = kPanel_m.x / kPanel_m.y},
                kPanelPixels);
    return headset_.release(xr::Picture::Panel);
}

Result<bool> HeadsetDisplay::draw(const Painter& painter, const game::Snapshot&, float scale) {
    if (!waiting_) return false;
    waiting_ = false;
    if (Status begun = headset_.begin(); !begun) return begun.error();
    // Before the head has been tracked there is no place to draw from.
    const bool drawn = frame_.drawn && pause_.fade() < 1;
    const glm::ivec2 windowSize = window_->framebufferSize();
    xr::Shown shown;
    shown.room = surroundings_ == render::Surroundings::Room;
    if (drawn) {
        const glm::ivec2 size =
            glm::max(glm::vec2(headset_.properties().eyeSize) * scale + 0.5f, glm::vec2(16));
        resize(targets_, 2, size, samples_);
        if (Status done = drawEyes(painter, windowSize); !done) return done.error();
        if (windowSize.x > 0 && windowSize.y > 0) {
            glBindFramebuffer(GL_FRAMEBUFFER, 0);
            glViewport(0, 0, windowSize.x, windowSize.y);
            // The mirrored picture already contains HudPart::Marks.
            painter.hud(HudPart::Panel, Audience::Onlooker, windowView_, windowSize);
        }
        // The player's panel is drawn last, because fingers point at the menu's last drawn layout.
        if (Status done = drawPanel(painter); !done) return done.error();
        shown.eyes = shown.panel = true;
        shown.eyeSize = size;
        shown.planes = planes_;
        worldFromPanel_ = panel_.follow(headset_.tracking().worldFromHead, static_cast<float>(elapsed_s_));
        shown.worldFromPanel = worldFromPanel_;
        shown.panelSize_m = kPanel_m;
    }
    if (Status ended = headset_.end(shown); !ended) return ended.error();
    return drawn;
}

Status HeadsetDisplay::vibrate(const haptics::HapticFrame& frame, bool paused) {
    for (int hand = 0; hand < 2; ++hand) {
        const haptics::Actuation now = paused ? haptics::Actuation{0, 0} : haptics::vibrationOf(frame, hand);
        if (!vibration_[hand].due(now, clock_s_)) continue;
        if (Status told = headset_.vibrate(hand, now.amplitude, now.frequency_Hz); !told) return told;
    }
    return Done{};
}

} // namespace shoal::app
