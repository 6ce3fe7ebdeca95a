// Prints tables of what is found in pictures: lights, the surroundings of a photo, water; errors and cost.
#include "engine/math/Quantile.h"
#include "engine/panorama/Steps.h"
#include "tests/bench/find_lights/Tables.h"
#include "tests/bench/light/Environments.h"
#include "tests/unit/light/LightWatcher.h"

using namespace shoal;
using namespace shoal::light;

namespace {

double degreesOf(float radians) { return glm::degrees(static_cast<double>(radians)); }

// A light this far off is another one, as LightOverTime has it.
bool areSame(const glm::vec3& found, const FoundLight& truth) {
    return degreesBetween(found, truth.direction) < std::max(15.0, 0.7 * degreesOf(truth.radius));
}

// A way to find lights, over all frames.
struct Way {
    const char* name;
    std::vector<double> off_deg{}, times_us{};
    int missed = 0, phantoms = 0, first = 0; // first: phantoms that are the strongest light found

    // found: the strongest first.
    void add(std::span<const glm::vec3> found, std::span<const FoundLight> truths) {
        double nearest_deg = INFINITY;
        for (const glm::vec3& each : found) {
            const bool phantom = std::ranges::none_of(truths, [&](auto& at) { return areSame(each, at); });
            phantoms += phantom, first += phantom && &each == found.data();
            if (!truths.empty() && areSame(each, truths[0]))
                nearest_deg = std::min(nearest_deg, degreesBetween(each, truths[0].direction));
        }
        if (nearest_deg < INFINITY)
            off_deg.push_back(nearest_deg);
        else
            missed += !truths.empty();
    }
};

class Finders {
  public:
    // Finds lights in a frame of 8 bits and prints a row. truths: its lights, the strongest first.
    void look(const std::string& name, const ImageRgb8& frame, std::span<const FoundLight> truths) {
        eye_.look(frame);
        FoundLights found;
        ours_.times_us.push_back(bench::shortest_us(0, [&] { found = eye_.found(); }));
        std::vector<glm::vec3> directions;
        for (size_t i = 0; i < found.count; ++i) directions.push_back(found.lights[i].direction);
        ours_.add(directions, truths);

        cv::Mat coded;
        cv::Mat(frame.height, frame.width, CV_8UC3, const_cast<uint8_t*>(frame.pixels.data()))
            .convertTo(coded, CV_32F, 1 / 255.0);
        cv::Point2d at;
        thesis_.times_us.push_back(bench::shortest_us(0, [&] { at = panorama::findMainLight(coded).place; }));
        const auto main =
            glm::vec3(directionFromLatLong(glm::dvec2(at.x / frame.width, at.y / frame.height)));
        thesis_.add({&main, 1}, truths);

        ++frames_, lights_ += !truths.empty();
        std::printf("| %s |", name.c_str());
        if (truths.empty()) {
            std::printf(" none | | %s | | | |\n", found.count ? "a phantom" : "none");
            return;
        }
        say(truths[0]);
        const auto ours = std::ranges::min_element(
            directions, {}, [&](auto& to) { return degreesBetween(to, truths[0].direction); });
        if (ours == directions.end()) {
            std::printf(" none | | |");
        } else {
            std::printf(" %.1f |", degreesBetween(*ours, truths[0].direction));
            say(found.lights[ours - directions.begin()]);
        }
        std::printf(" %.1f |\n", degreesBetween(main, truths[0].direction));
    }

    void print() {
        std::printf(R"(
All %d frames, of which %d have a light. A light is missed, and what is found is a phantom, if it lies more than 15 degrees away,
or 0.7 of the light's radius if that is more. Time: ours beside the pyramid, which all light is made from; the thesis' of a frame in
floats.

| way | off, degrees: median | 90 of 100 below | missed, %% of the strongest lights | strongest is a phantom, %% of frames | phantoms, per 100 frames | us a frame |
|---|--:|--:|--:|--:|--:|--:|
)",
                    frames_, lights_);
        for (Way* way : {&ours_, &thesis_})
            std::printf("| %s | %.1f | %.1f | %.0f | %.0f | %.0f | %.0f |\n", way->name,
                        math::median(way->off_deg), math::quantile(way->off_deg, 0.9),
                        100.0 * way->missed / lights_, 100.0 * way->first / frames_,
                        100.0 * way->phantoms / frames_, math::median(way->times_us));
    }

  private:
    static void say(const FoundLight& light) {
        std::printf(" %.1f | %.1f |", degreesOf(light.radius), 100 * light.share);
    }

    LightWatcher eye_;
    Way ours_{"**ours** (the game)"}, thesis_{"the thesis' main light of a photo, section 5.3"};
    int frames_ = 0, lights_ = 0;
};

void findLights(bool quick) {
    std::printf(R"(# Lights, surroundings and water that are found in pictures

![Error over cost](lights.svg)

## Light sources

Lights in frames of 8 bits: the strongest true one, and the one found nearest to it. Pictures of high dynamic range are clipped with
their mean at 10 and at 20 %% of white. True lights of these and of the film are those that ours finds before they are clipped.

| frame | true radius, degrees | share of the light, %% | found: off, degrees | radius | share | the thesis' main light: off |
|---|--:|--:|--:|--:|--:|--:|
)");
    Finders finders;
    LightWatcher eye;
    struct Made {
        const char* name;
        glm::dvec2 uv;
        double radius_deg, within, without;
    };
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
        FoundLight truth = eye.look(image).lights[0];
        truth.direction = middle, truth.radius = static_cast<float>(glm::radians(made.radius_deg));
        finders.look(made.name, filmed(image, 0.2), {&truth, 1});
    }
    finders.look("uniform", filmed(uniform(1024, glm::dvec3(1)), 0.2), {});
    finders.look("gradient",
                 filmed(paint(1024, 512, [](const glm::dvec3& d) { return glm::dvec3(1 + 0.8 * d.y); }), 0.2),
                 {});
    finders.look("half black, half white",
                 filmed(paint(1024, 512, [](const glm::dvec3& d) { return glm::dvec3(d.x > 0); }), 0.2), {});
    for (const auto& source : quick ? bench::apartSources() : bench::clippedSources())
        if (const auto environment = source.load()) {
            const FoundLights truth = eye.look(environment->radianceLin);
            for (const double key : {0.1, 0.2})
                finders.look(source.name + (key < 0.15 ? ", 10 %" : ", 20 %"),
                             filmed(environment->radianceLin, key),
                             std::span(truth.lights).first(truth.count));
        }
    auto films = bench::filmedSources();
    if (quick) films.resize(std::min<size_t>(films.size(), 2));
    for (const auto& source : films)
        if (const auto environment = source.load()) {
            const FoundLights truth = eye.look(environment->radianceLin);
            finders.look(source.name, environment->frame, std::span(truth.lights).first(truth.count));
        }
    finders.print();
}

} // namespace

int main(int argc, char**) {
    const bool quick = argc > 1; // --quick
    findLights(quick);
    bench::growPhotos(quick);
    bench::findWater(quick);
}
