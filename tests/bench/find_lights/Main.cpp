// Prints tables: errors of the directions of found lights, and the cost of finding them.
#include "tests/bench/Bench.h"
#include "tests/bench/light/Environments.h"
#include "tests/unit/light/LightWatcher.h"

using namespace shoal;
using namespace shoal::light;

namespace {

double degreesOf(float radians) { return glm::degrees(static_cast<double>(radians)); }

void sayNearest(const FoundLights& found, const glm::vec3& towards) {
    size_t nearest = 0;
    for (size_t i = 1; i < found.count; ++i)
        if (glm::dot(found.lights[i].direction, towards) > glm::dot(found.lights[nearest].direction, towards))
            nearest = i;
    if (found.count == 0) {
        std::printf(" none | | |");
        return;
    }
    const FoundLight& light = found.lights[nearest];
    std::printf(" %.1f | %.1f | %.1f%s |", degreesBetween(light.direction, towards), degreesOf(light.radius),
                100 * static_cast<double>(light.share),
                nearest == 0   ? ""
                : nearest == 1 ? " (second)"
                               : " (third)");
}

void madeTable() {
    struct Made {
        const char* name;
        glm::dvec2 uv;
        double radius_deg, within, without;
    };
    std::printf(
        "| made environment | off, degrees | radius, degrees | share of the light, %% | as a video: off "
        "| radius "
        "| share |\n|---|--:|--:|--:|--:|--:|--:|\n");
    LightWatcher eye;
    for (const Made& made : {Made{"sun of four texels, zenith", {0.5, 0}, 0.4, 1e4, 1},
                             {"sun of four texels, beside the pole", {0.3, 0.015}, 0.4, 1e4, 1},
                             {"sun of four texels, horizon", {0.5, 0.5}, 0.4, 1e4, 1},
                             {"sun of four texels, seam", {0, 0.5}, 0.4, 1e4, 1},
                             {"cap of 10 degrees", {0.2, 0.3}, 10, 12, 0.5},
                             {"cap of 25 degrees, seam", {0.99, 0.2}, 25, 12, 0.5},
                             {"Snell's window, 48.6 degrees", {0.5, 0}, 48.6, 6, 0.4}}) {
        const glm::dvec3 middle = directionFromLatLong(made.uv);
        const ImageRgbF image = paint(1024, 512, [&](const glm::dvec3& d) {
            return glm::dvec3(degreesBetween(d, middle) < made.radius_deg ? made.within : made.without);
        });
        std::printf("| %s |", made.name);
        sayNearest(eye.look(image), middle);
        sayNearest(eye.look(filmed(image, 0.2)), middle);
        std::printf("\n");
    }
    const auto none = [&](const char* name, const ImageRgbF& image) {
        std::printf("| %s |", name);
        sayNearest(eye.look(image), {0, 1, 0});
        sayNearest(eye.look(filmed(image, 0.2)), {0, 1, 0});
        std::printf("\n");
    };
    none("uniform", uniform(1024, glm::dvec3(1)));
    none("gradient", paint(1024, 512, [](const glm::dvec3& d) { return glm::dvec3(1 + 0.8 * d.y); }));
    none("half black, half white", paint(1024, 512, [](const glm::dvec3& d) { return glm::dvec3(d.x > 0); }));
}

void clippedTable(bool quick) {
    std::printf("\n| picture of high dynamic range: its strongest light | share, %% | clipped, mean at 10 %% "
                "of white: off, "
                "degrees | radius | share | mean at 20 %%: off | radius | share "
                "|\n|---|--:|--:|--:|--:|--:|--:|--:|\n");
    LightWatcher eye;
    for (const auto& source : quick ? bench::apartSources() : bench::clippedSources()) {
        const auto environment = source.load();
        if (!environment) continue;
        const FoundLights truth = eye.look(environment->radianceLin);
        if (truth.count == 0) continue;
        std::printf("| %s | %.1f |", environment->name.c_str(),
                    100 * static_cast<double>(truth.lights[0].share));
        for (const double key : {0.1, 0.2})
            sayNearest(eye.look(filmed(environment->radianceLin, key)), truth.lights[0].direction);
        std::printf("\n");
    }
}

void truthTable(bool quick) {
    std::printf("\n| frame of the film: its true light | radius, degrees | share, %% | found in the video: "
                "off, degrees "
                "| radius | share |\n|---|--:|--:|--:|--:|--:|\n");
    LightWatcher eye;
    std::vector<double> times_us;
    auto sources = bench::filmedSources();
    if (quick) sources.resize(std::min<size_t>(sources.size(), 2));
    for (const auto& source : sources) {
        const auto environment = source.load();
        if (!environment) continue;
        const FoundLights truth = eye.look(environment->radianceLin);
        if (truth.count == 0) continue;
        std::printf("| %s | %.1f | %.1f |", environment->name.c_str(), degreesOf(truth.lights[0].radius),
                    100 * static_cast<double>(truth.lights[0].share));
        sayNearest(eye.look(environment->view()), truth.lights[0].direction);
        std::printf("\n");
        for (int i = 0; i < 20; ++i) {
            const double began_us = bench::now_us();
            eye.found();
            times_us.push_back(bench::now_us() - began_us);
        }
    }
    if (times_us.empty()) return;
    std::ranges::sort(times_us);
    std::printf("\nFinding them takes %.0f us a frame (median; 90th percentile %.0f).\n",
                times_us[times_us.size() / 2], times_us[times_us.size() * 9 / 10]);
}

} // namespace

int main(int argc, char**) {
    madeTable();
    clippedTable(argc > 1); // --quick
    truthTable(argc > 1);
}
