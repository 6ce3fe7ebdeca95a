#include "game/views/Environment.h"

#include "engine/media/SphericalMetadata.h"

#include <chrono>

namespace shoal::app {

render::Reflectance reflectanceIn(const environment::Source& source) {
    return source.isHdr() || source.light != light::FrameRadiance::Thesis ? render::Reflectance::Linear
                                                                          : render::Reflectance::Coded;
}

Path filmFor(const Path& film, FilmChoice choice, bool slowComputer) {
    Path small = film;
    small.replace_extension(".small" + film.extension().string());
    const bool wanted = choice == FilmChoice::Small || (choice == FilmChoice::Auto && slowComputer);
    std::error_code missing;
    return wanted && std::filesystem::exists(small, missing) ? small : film;
}

Result<std::unique_ptr<Environment>> Environment::open(const EnvironmentSetup& setup,
                                                       const environment::Wait& wait) {
    std::unique_ptr<Environment> environment(new Environment(setup));
    if (Status s = environment::Player::open(setup.player, wait).moveTo(environment->player_); !s)
        return s.error();
    if (setup.player.planes)
        if (Status s = render::PlanesPass::make().moveTo(environment->planes_); !s) return s.error();
    environment->upload();
    return environment;
}

void Environment::upload() {
    const auto began = std::chrono::steady_clock::now();
    const environment::Frame& frame = player_->frame();
    if (frame.planes) planes_->setFrame(*frame.planes);
    for (int eye = 0; eye < (eyesSeeTheSame() ? 1 : 2); ++eye) {
        render::EnvironmentGpu& on = gpu_[eye];
        if (player_->isHdr()) {
            on.setFrame(frame.radianceLin);
        } else {
            const ImageRgba8& picture = frame.picture;
            const glm::ivec2 size =
                frame.planes ? frame.planes->size : glm::ivec2(picture.width, picture.height);
            const media::EyePart part = media::eyePart(player_->layout(), eye, size.x, size.y);
            if (frame.planes)
                on.setFrame({nullptr, part.width, part.height, 0, &*planes_, {part.x, part.y}});
            else
                on.setFrame({picture.at(part.x, part.y), part.width, part.height, picture.width});
        }
        if (!frame.depth.inverse.empty()) on.setDepth({&frame.depth, &frame.widened, &frame.depthRange});
        on.uploadLight(frame.found.light, frame.found.smooth);
        if (setup_.player.cameraResponse && !player_->isHdr()) on.uploadScattered(frame.found.glare.spread);
    }
    upload_ms_ = std::chrono::duration<float, std::milli>(std::chrono::steady_clock::now() - began).count();
}

glm::mat3 Environment::envFromWorld() const {
    return glm::mat3_cast(media::filmFromWorld(player_->envFromFilm(), glm::radians(setup_.yaw_deg)));
}

render::Exposure Environment::exposure(Tone chosen, float exposure_ev) const {
    using enum render::ToneCurve;
    const auto curve = chosen == Tone::Linear                     ? Linear
                       : chosen == Tone::Aces || player_->isHdr() ? Aces
                                                                  : InverseOfVideo;
    const bool thesis = setup_.player.source.light == light::FrameRadiance::Thesis;
    return {curve, exposure_ev, thesis ? render::FrameCoding::Thesis : render::FrameCoding::Srgb};
}

game::Text Environment::lightName() const {
    static constexpr std::array<game::Text, 5> kNames = {
        "decoded sRGB, clipped light estimated, GGX prefiltered",
        "thesis inverse tone mapping, GGX prefiltered", "decoded sRGB, GGX prefiltered",
        "inverse tone mapping by Akyuz, GGX prefiltered",
        "inverse tone mapping by Landis, GGX prefiltered"}; // by FrameRadiance
    return player_->isHdr() || player_->frame().found.measured
               ? "as measured, GGX prefiltered"
               : kNames[static_cast<size_t>(setup_.player.source.light)];
}

const game::Notice* Environment::notice() const {
    static const std::array<game::Notice, 3> kNotices = {{
        {"The film is damaged here: its last good picture stays"},
        {"The live video has stopped: its last picture stays"},
        {"The live video is lost: its last picture stays until it comes back"},
    }}; // by Trouble, from Damaged on
    const auto trouble = static_cast<size_t>(player_->trouble());
    return trouble > 0 ? &kNotices[trouble - 1] : nullptr;
}

} // namespace shoal::app
