#include "tests/bench/Names.h"
#include "tests/bench/occlusion/Measure.h"

#include <fmt/format.h>

namespace shoal::bench {

namespace {

enum class Under { Reef, NoSuns, Suns };

// Root mean square over the environments, each weighing the same.
double pooledError(const OcclusionChart& chart, const OcclusionMeasured& method, size_t scene, Under which,
                   double SceneError::*part = &SceneError::all) {
    double squares = 0;
    int count = 0;
    for (size_t s = 0; s < chart.environments.size(); ++s) {
        const bool fits = which == Under::Reef   ? chart.environments[s] == kReef
                          : which == Under::Suns ? chart.pointSun[s]
                                                 : !chart.pointSun[s];
        const double error = method.errors[scene][s].*part;
        if (!fits || !std::isfinite(error)) continue;
        squares += error * error;
        ++count;
    }
    return std::sqrt(squares / count);
}

std::string percent(double value) {
    if (!std::isfinite(value)) return "-";
    return fmt::format("{:.{}f}", 100 * value, value < 0.0995 ? 2 : 1);
}

constexpr const char* kMoves[] = {"free", "bodies", "rebuilt"}; // by OcclusionMethod::Moves

std::string sceneTable(const OcclusionChart& chart, size_t scene) {
    std::string out =
        "| method | reef video, % | without suns | shaded points | with suns | ns a receiver | kB | "
        "us a rebuilt body | moves | source |\n|---|--:|--:|--:|--:|--:|--:|--:|---|---|\n";
    for (const OcclusionMeasured& each : chart.methods)
        out += fmt::format("| {} | {} | {} | {} | {} | {:.0f} | {:.1f} | {:.0f} | {} | {} |\n",
                           each.label.name, percent(pooledError(chart, each, scene, Under::Reef)),
                           percent(pooledError(chart, each, scene, Under::NoSuns)),
                           percent(pooledError(chart, each, scene, Under::NoSuns, &SceneError::shaded)),
                           percent(pooledError(chart, each, scene, Under::Suns)), each.receiver_ns[scene],
                           static_cast<double>(each.bytes[scene]) * 1e-3, each.body_us[scene],
                           kMoves[static_cast<size_t>(each.moves)], each.label.source);
    return out;
}

double worstNoise(const OcclusionChart& chart, size_t scene, bool suns) {
    double maximum = 0;
    for (size_t s = 0; s < chart.environments.size(); ++s)
        if (chart.pointSun[s] == suns) maximum = std::max(maximum, chart.noise[scene][s]);
    return maximum;
}

std::string layerTable(const std::vector<LayerQuality>& layers) {
    std::string out = R"(
## Layered fragment buffers by themselves

Rays from the body's surface to where it mirrors the eye. "Gaps": rays that hit where they should not, or the reverse.
"Picture": what the body as a mirror shows of an environment with detail down to a tenth of a radian, relative root mean
square, the truth being followed for as many bounces.

| body | method | views | pixels | kB | gaps, % | picture with 1 bounce, % | 2 | 8 | ns a ray | ms to build |
|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|
)";
    for (const LayerQuality& each : layers)
        out +=
            fmt::format("| {} | {} | {} | {} | {:.0f} | {} | {} | {} | {} | {:.0f} | {:.0f} |\n", each.body,
                        each.method, each.views, each.resolution, static_cast<double>(each.bytes) * 1e-3,
                        percent(each.gaps), percent(each.bounced[0]), percent(each.bounced[1]),
                        percent(each.bounced[2]), each.ray_ns, each.build_ms);
    return out;
}

std::string glossyTable(const OcclusionChart& chart) {
    std::string out =
        fmt::format("\n## Glossy light, roughness {:.2f}\n\nEnvironments without point suns; error in % and "
                    "ns a receiver, for each scene. Noise of the truth:",
                    kGlossyRoughness);
    for (const double noise : chart.glossy.noise) out += " " + percent(noise);
    out += " %.\n\n| method |";
    std::string rule = "|---|";
    for (const std::string& scene : chart.scenes) {
        out += " " + scene + ", % | ns |";
        rule += "--:|--:|";
    }
    out += "\n" + rule + "\n";
    for (const GlossyMeasured& each : chart.glossy.methods) {
        out += "| " + each.name + " |";
        for (size_t k = 0; k < chart.scenes.size(); ++k)
            out += fmt::format(" {} | {:.0f} |", percent(each.errors[k]), each.receiver_ns[k]);
        out += "\n";
    }
    return out;
}

std::string groundTable(const OcclusionChart& chart) {
    std::string out = fmt::format(R"(
## Shadows on the ground

Level ground that a film shows, 0.95 m below the shark's scene: how much of its light is taken, in the {} environments in which the
game finds a light that casts shadows. Error: root mean square over texels of the film's distances, of what is truly taken, which
rays through every cell tell. Differential rendering (Debevec 1998): the ground with the bodies over the ground without, a ray
against triangles to each of the lights, as bright as each other, that the environment is cut into. Time: a shaded texel; of
differential rendering without the second picture.

| method | error, % | in the reef's film, % | ns a texel |
|---|--:|--:|--:|
)",
                                  chart.groundEnvironments);
    for (const GroundMeasured& each : chart.ground)
        out += fmt::format("| {} | {} | {} | {:.0f} |\n", each.name,
                           percent(std::sqrt(each.squares / chart.groundEnvironments)), percent(each.reef),
                           each.spent_ns / std::max(each.texels, 1.0));
    return out;
}

// The two scenes that the game's default is judged by.
bool isJudged(const std::string& scene) { return scene.starts_with("hand") || scene.starts_with("shark"); }

// Names the cheapest method with an error of at most `limit` in both judged scenes.
std::string answer(const OcclusionChart& chart, Under which, double limit) {
    const OcclusionMeasured* best = nullptr;
    double minimum = 1e30;
    for (const OcclusionMeasured& each : chart.methods) {
        double cost = 0, worst = 0;
        for (size_t k = 0; k < chart.scenes.size(); ++k)
            if (isJudged(chart.scenes[k])) {
                cost = std::max(cost, each.receiver_ns[k]);
                worst = std::max(worst, pooledError(chart, each, k, which));
            }
        const bool kept = each.label.part != Part::Exact && each.moves != OcclusionMethod::Moves::Rebuilt;
        if (!kept || worst > limit || cost >= minimum || each.label.part == Part::Off) continue;
        minimum = cost;
        best = &each;
    }
    return best ? fmt::format("{} ({:.0f} ns)", best->label.name, minimum) : "none";
}

} // namespace

Status writeOcclusionMarkdown(const OcclusionChart& chart, const std::vector<LayerQuality>& layers,
                              const Path& folder) {
    std::string md = R"(# Light where something stands in its way

![Error over cost](occlusion.svg)

![Off, methods, truth](occlusion_sheet.jpg)

Error of diffuse light: relative root mean square over points spread by area over the bodies (half of them on each of the
two kinds where there are two), against rays through every cell of the environment; environments weigh the same however bright
they are. "Shaded points": only those of whose light a tenth or more is taken, environments without point suns. Time: one core,
warm, the shortest of many runs, a receiver's unoccluded light included. "Moves": free, the method follows bending bodies
as they are; bodies, it follows bodies but not their bending; rebuilt, it holds for the scene as it was built. "Exact": rays
against the triangles, so that what is left is the error of so few directions. "Colours": bodies send back their share of the light, in truth over four matte bounces; of the
methods only ellipsoids do, over one; elsewhere bodies are black.

)";
    for (const double limit : {0.05, 0.10, 0.20})
        md += fmt::format(
            "Cheapest that moves and is at most {:.0f} % wrong in both the hand's and the shark's scene: {}; "
            "in the reef's video: {}.\n",
            100 * limit, answer(chart, Under::NoSuns, limit), answer(chart, Under::Reef, limit));
    for (size_t k = 0; k < chart.scenes.size(); ++k) {
        md += fmt::format(
            "\n## {}\n\n{:.1f} % of the hemisphere is free on the mean. Noise of the truth at most {} %, "
            "with point suns {} %.\n\n",
            chart.scenes[k], 100 * chart.open[k], percent(worstNoise(chart, k, false)),
            percent(worstNoise(chart, k, true)));
        md += sceneTable(chart, k);
    }
    md += glossyTable(chart) + groundTable(chart) + layerTable(layers);
    return writeFileWhole(folder / "occlusion.md", md);
}

Status writeOcclusionPicture(const OcclusionChart& chart, const Path& folder) {
    std::string out;
    std::vector<std::string> families;
    for (const OcclusionMeasured& each : chart.methods)
        if (std::ranges::find(families, each.label.family) == families.end())
            families.push_back(each.label.family);
    out += "families = '";
    for (const std::string& each : families) out += "\"" + each + "\" ";
    out += "'\n";
    constexpr double kLine = 5; // percent: occlusion.gp draws a line there
    int panel = 0;
    for (size_t k = 0; k < chart.scenes.size(); ++k) {
        if (!isJudged(chart.scenes[k])) continue;
        ++panel;
        out += fmt::format("title{} = '{}'\n", panel, chart.scenes[k]);
        std::vector<double> costs, errors;
        std::vector<const OcclusionMeasured*> methods; // by family
        for (size_t f = 0; f < families.size(); ++f) {
            out += fmt::format("$points{}_{} << END\n", panel, f + 1);
            for (const OcclusionMeasured& each : chart.methods) {
                if (each.label.family != families[f]) continue;
                methods.push_back(&each);
                costs.push_back(each.receiver_ns[k]);
                errors.push_back(100 * pooledError(chart, each, k, Under::NoSuns));
                out += fmt::format("{:.6g} {:.6g}\n", costs.back(), errors.back());
            }
            out += "END\n";
        }
        // Error over memory of layered fragment buffers, by number of views.
        for (const char* kind : {"thesis", "cured"})
            for (const int pixels : {kUsualPixels / 2, kUsualPixels}) {
                out += fmt::format("$views{}_{}_{} << END\n", panel, kind, pixels);
                for (const OcclusionMeasured& each : chart.methods)
                    if (each.label.family == fmt::format("layered fragments, {}", kind) &&
                        each.label.name.ends_with(fmt::format("of {}, 256 directions", pixels)))
                        out += fmt::format("{:.6g} {:.6g}\n", static_cast<double>(each.bytes[k]) * 1e-6,
                                           100 * pooledError(chart, each, k, Under::NoSuns));
                out += "END\n";
            }
        errors.push_back(kLine);
        const Axis x = axisAround(costs, 800, 2), y = axisAround(errors, 410, 1.5); // occlusion.gp
        out += fmt::format("left{0} = {1:g}; right{0} = {2:g}; low{0} = {3:g}; high{0} = {4:g}\n", panel,
                           x.minimum, x.maximum, y.minimum, y.maximum);
        std::vector<Name> names;
        for (size_t i = 0; i < methods.size(); ++i) {
            const double kB = static_cast<double>(methods[i]->bytes[k]) * 1e-3;
            const std::string& brief = methods[i]->label.brief;
            names.push_back(
                {brief + (kB > 0 && !brief.empty() ? fmt::format(", {:.{}f} kB", kB, kB < 10 ? 1 : 0) : ""),
                 {x.toPixel(costs[i]), y.toPixel(errors[i])}});
        }
        placeNames(names, {{{400, y.toPixel(kLine)}, {400, 1}}}, {800, 410}, 6.6);
        out += fmt::format("$labels{} << END\n", panel);
        for (size_t i = 0; i < names.size(); ++i)
            out += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g} \"{}\" {}\n", costs[i], errors[i],
                               x.fromPixel(names[i].box.centre.x), y.fromPixel(names[i].box.centre.y),
                               names[i].text, names[i].apart() ? "apart" : "beside");
        out += "END\n";
    }
    return writeFileWhole(folder / "occlusion.data.gp", out);
}

} // namespace shoal::bench
