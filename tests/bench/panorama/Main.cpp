// Grows made photos of 12 megapixels, and those named, and says what came of it.
#include "engine/media/Pictures.h"
#include "engine/panorama/Panorama.h"
#include "tests/bench/panorama/Scenes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

using namespace shoal;

namespace {

ImageRgb8 twice(const ImageRgb8& picture) {
    ImageRgb8 large(picture.width * 2, picture.height * 2);
    for (int y = 0; y < large.height; ++y)
        for (int x = 0; x < large.width; ++x) std::copy_n(picture.at(x / 2, y / 2), 3, large.at(x, y));
    return large;
}

bool measure(const Path& folder, const std::string& name, const ImageRgb8& photo,
             const std::optional<glm::dvec2>& light) {
    const auto began = std::chrono::steady_clock::now();
    const auto grown = panorama::panoramaFromPhoto(photo, {});
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (!grown) {
        std::fprintf(stderr, "%s: %s\n", name.c_str(), grown.error().reason.c_str());
        return false;
    }
    std::printf("%s\t%.1f\t%.1f\t", name.c_str(), photo.width * photo.height / 1e6, seconds);
    if (light)
        std::printf("%.3f\t",
                    glm::distance(*light, grown->lightInPhoto) / photo.width * bench::kSceneFov_deg);
    else
        std::printf("-\t");
    std::printf("%.2f\t%.2f\n", grown->wrapStep * 255, grown->usualStep * 255);
    std::fflush(stdout);
    const Status written = media::writePng(folder / (name + ".png"), grown->latLong);
    if (!written) std::fprintf(stderr, "%s\n", written.error().message().c_str());
    return written.ok();
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2) return std::fputs("bench_panorama FOLDER [PHOTO ...]\n", stderr), 2;
    const Path folder = argv[1];
    std::puts(
        "scene\tmegapixels\tseconds\tlight is off by, degrees\tjoint, levels of 255\tgradient exceeded by a "
        "tenth of the pixels, levels");
    bool good = true;
    for (const auto& [name, make] :
         {std::pair{"beach", &bench::beach}, std::pair{"forest", &bench::forest}}) {
        bench::Scene scene = make(2000, 1500);
        scene.photo = twice(scene.photo); // 12 megapixels, in a quarter of the time
        scene.light *= 2.0;
        good &= media::writePicture(folder / (std::string(name) + "_photo.jpg"), scene.photo).ok();
        good &= measure(folder, name, scene.photo, scene.light);
    }
    for (int k = 2; k < argc; ++k) {
        const auto photo = media::readPicture(argv[k]);
        if (!photo) std::fprintf(stderr, "%s\n", photo.error().message().c_str());
        good &= photo && measure(folder, Path(argv[k]).stem().string(), *photo, std::nullopt);
    }
    return good ? 0 : 1;
}
