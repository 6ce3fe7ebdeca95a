#include "game/app/Surround.h"

#include "engine/core/Log.h"
#include "engine/light/MakeLight.h"
#include "engine/media/Pictures.h"
#include "engine/media/StereoView.h"
#include "engine/media/VideoPlayer.h"

#include <glm/gtc/quaternion.hpp>

#include <chrono>
#include <optional>

namespace shoal::app {

namespace {

// Width of the widest map that objects mirror, for a moving video: fish are rough and small, so half the video's own
// resolution already shows nothing missing. Stills keep what they have.
constexpr int kVideoLightWidth = 1024;

Result<media::Layout> layoutNamed(const std::string& name) {
    if (name == "auto") return media::Layout::Auto;
    if (name == "mono") return media::Layout::Mono;
    if (name == "top-bottom") return media::Layout::TopBottom;
    return media::Layout::LeftRight;
}

} // namespace

struct Surround::State {
    bool bothEyes = false;
    bool keepPyramid = false;
    float yaw = 0; // radians
    bool hdr = false;
    std::array<render::SurroundGpu, 2> gpu; // per eye; the second is used for stereo pictures only
    bool twoPictures = false;

    // Made on the decode thread, slot by slot, and handed over with the frame. Declared before the player, whose thread
    // writes them until it is gone.
    std::vector<light::EnvironmentLight> lights;
    std::unique_ptr<light::LightMaker> maker;
    std::optional<media::VideoPlayer> player;
    int64_t shownFrame = -1;
    float light_ms = 0, decode_ms = 0, upload_ms = 0;
    std::string notice;

    void uploadLight(const light::EnvironmentLight& light) {
        for (int eye = 0; eye < (twoPictures ? 2 : 1); ++eye) {
            gpu[static_cast<size_t>(eye)].uploadLight(light);
            if (keepPyramid) gpu[static_cast<size_t>(eye)].uploadPyramid(light.radiance);
        }
    }
};

} // namespace shoal::app
