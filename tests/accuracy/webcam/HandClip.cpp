#include "HandClip.h"

#include "engine/core/Hash.h"
#include "engine/light/MakeLight.h"
#include "engine/light/PackedLight.h"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace shoal::hands::test {

namespace {

// Returns an environment lit from above and the left, as by a window.
ImageRgb8 room() {
    ImageRgb8 frame(256, 128);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
            const float up = 1 - static_cast<float>(y) / 128,
                        left = std::cos(6.2832f * (static_cast<float>(x) / 256 - 0.3f));
            const float value = 90 + 60 * up + 45 * std::max(left, 0.0f);
            frame.at(x, y)[0] = static_cast<uint8_t>(value);
            frame.at(x, y)[1] = static_cast<uint8_t>(0.98f * value);
            frame.at(x, y)[2] = static_cast<uint8_t>(0.95f * value);
        }
    return frame;
}

cv::Mat background(Behind behind, cv::Size size) {
    cv::Mat picture(size, CV_8UC3, cv::Scalar(120, 122, 125));
    if (behind == Behind::Gradient) {
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                picture.at<cv::Vec3b>(y, x) = cv::Vec3b(static_cast<uchar>(60 + 160 * x / size.width),
                                                        static_cast<uchar>(200 - 120 * y / size.height),
                                                        static_cast<uchar>(80 + 60 * y / size.height));
    } else if (behind == Behind::Wood) { // the hue of skin, in grained boards, somewhat darker
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const double grain =
                    std::sin(0.11 * y + 2.5 * std::sin(0.013 * x) + 0.7 * std::sin(0.05 * y));
                const double value = 128 + 18 * grain - (y % 60 < 2 ? 40 : 0);
                picture.at<cv::Vec3b>(y, x) =
                    cv::Vec3b(static_cast<uchar>(0.55 * value), static_cast<uchar>(0.76 * value),
                              static_cast<uchar>(value));
            }
    } else if (behind == Behind::Room) { // furniture in strong colours
        picture = cv::Scalar(170, 180, 185);
        cv::rectangle(picture, {0, 0, size.width / 4, size.height}, {140, 90, 60}, cv::FILLED);
        cv::rectangle(picture, {size.width * 3 / 5, size.height / 3, size.width / 4, size.height},
                      {60, 130, 70}, cv::FILLED);
        cv::circle(picture, {size.width * 3 / 4, size.height / 5}, size.height / 8, {40, 200, 230},
                   cv::FILLED);
        cv::circle(picture, {size.width / 3, size.height / 4}, size.height / 10, {50, 40, 150}, cv::FILLED);
        cv::GaussianBlur(picture, picture, {}, 2);
    }
    return picture;
}

HandShape shapeOf(Gesture gesture) {
    if (gesture == Gesture::Open) return {.curl = {0.0f, 0.04f, 0.04f, 0.05f, 0.06f}, .spread = 1};
    if (gesture == Gesture::Fist) return {.curl = {0.9f, 0.95f, 0.95f, 0.95f, 0.95f}};
    // Pinching, thumb and index meet; the others stand.
    return {.curl = {0.85f, 0.68f, 0.10f, 0.08f, 0.08f}, .spread = 0.8f};
}

} // namespace

HandPose shownHand(const HandRig& rig, Side side, const Shown& shown) {
    // Fingers up, palm to the camera: -Z of the wrist along +y, +Y of it along -z.
    const glm::quat facing =
        glm::quat_cast(glm::mat3(glm::vec3(-1, 0, 0), glm::vec3(0, 0, -1), glm::vec3(0, -1, 0)));
    const glm::quat turn = glm::angleAxis(shown.roll, glm::vec3(0, 0, 1)) *
                           glm::angleAxis(shown.tilt, glm::vec3(1, 0, 0)) * facing;
    HandPose hand = rig.pose(side, shapeOf(shown.gesture), {{0, 0, 0}, turn});
    const glm::vec3 by = shown.palm - hand.joints[0].position;
    for (Joint& joint : hand.joints) joint.position += by;
    return hand;
}

Result<HandClip> HandClip::make(cv::Size size, float horizontalFov) {
    HandClip clip;
    if (Status s = platform::Headless::open().moveTo(clip.context_); !s) return s.error();
    if (Status s = app::CreatureModels::load({}, {}, "", render::Reflectance::Coded, render::Detail::Full)
                       .moveTo(clip.creatureModels_);
        !s)
        return s.error();
    if (Status s = render::ObjectPass::make().moveTo(clip.pass_); !s) return s.error();
    const ImageRgb8 light = room();
    light::EnvironmentLight made;
    light::LightMaker({256, clip.creatureModels_->minRoughness()})
        .make({light.at(0, 0), light.width, light.height, ptrdiff_t{3} * light.width, false}, made);
    light::PackedLight packed;
    light::packLight(made, light::MirrorMaps::Mirrors, packed);
    clip.environment_.emplace();
    clip.environment_->uploadLight(packed);
    clip.target_.emplace(size.width, size.height, 4);
    clip.size_ = size;
    for (size_t i = 0; i < clip.behind_.size(); ++i)
        clip.behind_[i] = background(static_cast<Behind>(i), size);
    clip.verticalFov_ = 2 * std::atan(std::tan(horizontalFov / 2) * static_cast<float>(size.height) /
                                      static_cast<float>(size.width));
    return clip;
}

ImageRgba8 HandClip::hands(const std::array<std::optional<HandPose>, 2>& poses) {
    Hash key;
    for (size_t side = 0; side < 2; ++side)
        if (poses[side])
            for (const Joint& joint : poses[side]->joints)
                for (const float value : {static_cast<float>(side), joint.position.x, joint.position.y,
                                          joint.position.z, joint.orientation.w, joint.orientation.x,
                                          joint.orientation.y, joint.orientation.z, joint.radius})
                    key.bytes(&value, sizeof value);
    if (const auto known = drawn_.find(key.value()); known != drawn_.end()) return known->second;
    game::Snapshot snapshot;
    for (size_t side = 0; side < 2; ++side) {
        snapshot.hands[side].visible = poses[side].has_value();
        if (poses[side]) snapshot.hands[side].joints = poses[side]->joints;
    }
    target_->bind();
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    pass_->begin();
    creatureModels_->show(snapshot, {}, {}, *pass_);
    const render::View view{.verticalFov = verticalFov_,
                            .aspect = static_cast<float>(size_.width) / static_cast<float>(size_.height),
                            .heightPixels = size_.height};
    if (Status drawn = pass_->draw({.environment = *environment_,
                                    .view = view,
                                    .exposure = {.exposure_ev = 0.8f},
                                    .canvas = *target_},
                                   {}, render::Glossy::Prefiltered);
        !drawn)
        return {};
    ImageRgba8 picture = target_->read();
    constexpr size_t kKept = 100; // 1.2 MB each
    if (drawn_.size() < kKept) drawn_.emplace(key.value(), picture);
    return picture;
}

cv::Mat HandClip::picture(const ImageRgba8& hands, Behind behind,
                          const std::function<void(cv::Mat&)>& paint) {
    cv::Mat out = behind_[static_cast<size_t>(behind)].clone(), noise(out.size(), CV_16SC3);
    if (paint) paint(out);
    for (int y = 0; y < out.rows; ++y)
        for (int x = 0; x < out.cols; ++x) {
            const uint8_t* hand = hands.at(x, y);
            cv::Vec3b& pixel = out.at<cv::Vec3b>(y, x);
            for (int c = 0; c < 3; ++c)
                pixel[c] = cv::saturate_cast<uchar>(hand[2 - c] + pixel[c] * (255 - hand[3]) / 255);
        }
    random_.fill(noise, cv::RNG::NORMAL, 0, 2.5);
    cv::add(out, noise, out, {}, CV_8U);
    return out;
}

} // namespace shoal::hands::test
