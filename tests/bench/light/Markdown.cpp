#include "tests/bench/light/Measure.h"

#include <fmt/format.h>

namespace shoal::bench {

using light::baselines::Role;

namespace {

constexpr size_t kNarrowLobes = 4; // roughness 0.1 to 0.4

std::string nameOf(const Measured& method) {
    const char* mark = method.label.role == Role::Default  ? " **(default)**"
                       : method.label.role == Role::Thesis ? " *(thesis)*"
                                                           : "";
    return method.label.name + mark;
}

std::string percent(double value) {
    if (std::isnan(value)) return "not measured";
    return fmt::format("{:.{}f}", 100 * value, value < 0.0995 ? 2 : 1);
}

std::string diffuseTable(const Chart& chart) {
    std::string out =
        "| method | update, us | times a plain read | ns a pixel | error, % | without suns | worst direction "
        "| source |\n|---|--:|--:|--:|--:|--:|--:|---|\n";
    for (const Measured& each : chart.diffuse) {
        const Pool all = pooled(chart, each, Suns::With, 0, 1);
        out += fmt::format("| {} | {:.0f} | {:.1f} | {:.0f} | {} | {} | {} | {} |\n", nameOf(each),
                           each.cost.update_us, each.cost.update_us / chart.read_us, each.cost.shade_ns,
                           percent(all.rms()), percent(pooled(chart, each, Suns::Without, 0, 1).rms()),
                           percent(all.worst()), each.label.source);
    }
    return out;
}

std::string glossyTable(const Chart& chart) {
    std::string out =
        "| method | update, us | ns a pixel | both, us | times a plain read | error, % | roughness "
        "0.1 to 0.4 | 0.5 to 1 | worst direction | with suns: error, % | worst | source |\n"
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|\n";
    for (const Measured& each : chart.glossy) {
        const Pool all = pooled(chart, each, Suns::Without, 0, kGlossyLobes);
        const Pool suns = pooled(chart, each, Suns::Only, 0, kGlossyLobes);
        const double both = each.cost.frame_us(kGlossyPixels);
        out += fmt::format(
            "| {} | {:.0f} | {:.0f} | {:.0f} | {:.1f} | {} | {} | {} | {} | {} | {} | {} |\n", nameOf(each),
            each.cost.update_us, each.cost.shade_ns, both, both / chart.read_us, percent(all.rms()),
            percent(pooled(chart, each, Suns::Without, 0, kNarrowLobes).rms()),
            percent(pooled(chart, each, Suns::Without, kNarrowLobes, kGlossyLobes - kNarrowLobes).rms()),
            percent(all.worst()), percent(suns.rms()), percent(suns.worst()), each.label.source);
    }
    return out;
}

std::string roughnessTable(const Chart& chart) {
    std::string out = "| method |", rule = "|---|";
    for (const float roughness : kRoughnesses) {
        out += fmt::format(" {:.1f} |", roughness);
        rule += "--:|";
    }
    out += "\n" + rule + "\n";
    for (const Measured& each : chart.glossy) {
        out += "| " + nameOf(each) + " |";
        for (size_t k = 0; k < kGlossyLobes; ++k)
            out += " " + percent(pooled(chart, each, Suns::Without, k, 1).rms()) + " |";
        out += "\n";
    }
    return out;
}

std::string pyramidTable(const Chart& chart) {
    std::string out =
        "| pyramid | us | times a plain read | error of the diffuse light, % | worst direction |\n"
        "|---|--:|--:|--:|--:|\n";
    for (const Measured& each : chart.pyramids) {
        Pool pool;
        for (const auto& errors : each.errors)
            for (const EnvironmentError& error : errors) pool.add(error);
        out += fmt::format("| {} | {:.0f} | {:.1f} | {} | {} |\n", nameOf(each), each.cost.update_us,
                           each.cost.update_us / chart.read_us, percent(pool.rms()), percent(pool.worst()));
    }
    return out;
}

std::string toneMapTable(const Chart& chart) {
    std::string
        out = "| operator | ms | HDRs: diffuse, % | glossy 0.5, % | our film: diffuse, % | glossy 0.5, % | "
              "apart: diffuse, % | glossy 0.5, % |",
        rule = "|---|--:|--:|--:|--:|--:|--:|--:|";
    for (const std::string& name : chart.toneMapEnvironments) {
        out += " " + name.substr(name.find(' ') + 1) + " |";
        rule += "--:|";
    }
    out += " source |\n" + rule + "---|\n";
    for (const Measured& each : chart.toneMaps) {
        out += "| " + nameOf(each) +
               (each.cost.update_us > 0 ? fmt::format(" | {:.1f} |", each.cost.update_us / 1e3) : " | |");
        for (const auto which : {ToneMapped::Clipped, ToneMapped::Film, ToneMapped::Apart})
            for (const size_t lobe : {0, 1})
                out += " " + percent(medianOfToneMap(chart, each, which, lobe)) + " |";
        for (const auto& errors : each.errors)
            out += " " + percent(errors[0].rms) + " and " + percent(errors[1].rms) + " |";
        out += " " + each.label.source + " |\n";
    }
    return out;
}

std::string environmentList(const Chart& chart) {
    std::string out;
    for (const EnvironmentFact& each : chart.environments)
        out += "- " + each.name + (each.coded ? ", 8 bits" : ", linear") +
               (each.pointSun ? ", **point sun**" : "") + "\n";
    return out;
}

} // namespace

Status writeMarkdown(const Chart& chart, const Path& folder) {
    std::string md = "# Speed against accuracy\n\n![The chart](chart.svg)\n\n";
    md += fmt::format(
        R"(Time: one core, warm, the shortest of many runs, for a 2048x1024 frame of the game's video. A plain read of that
frame's bytes takes {:.0f} us (as compiled for any x86-64; {:.0f} us by the widest registers), its radiance pyramid {:.0f} us; a
method that reads the pyramid is charged with it. "ns a pixel" is the processor's time to shade one pixel of a ball, by
the lookups of engine/light/Lookup.h where there are any. All of Shoal's light for the surfaces of the game's own dive
(diffuse, and glossy from roughness {:.2f} up) takes {:.0f} us: {:.1f} reads.

Error: against the integral over every texel at full resolution in double precision, relative root mean square over
directions spread evenly and the six axes; environments and roughnesses weigh the same however bright they are. "Worst
direction": the largest relative difference in any one direction of any environment, where it is darker than a tenth of the
root mean square relative to that. An environment has a point sun where a ten-thousandth of the sphere gives more than a
twentieth of the light.

)",
        chart.read_us, chart.wideRead_us, chart.pyramid_us, kReefRoughness, chart.reef_us,
        chart.reef_us / chart.read_us);
    md += "## Diffuse\n\n" + diffuseTable(chart);
    md += fmt::format(R"(
## Glossy

"both" is one update and {:.0f} shaded pixels. Errors are those of environments without point suns, but for the last two
columns of figures.

)",
                      kGlossyPixels);
    md += glossyTable(chart) +
          "\n![With point suns](suns.svg)\n\nError in %, by roughness, environments without point suns:\n\n" +
          roughnessTable(chart);
    md += R"(
## The radiance pyramid

Of the 8-bit environments: the diffuse light integrated over the pyramid's level of 128x64, against the truth.

)";
    md += pyramidTable(chart);
    md += R"(
## Inverse tone mapping

The HDR pictures exposed so that a tenth of their pixels lies above 0.8, clipped at 1, kept as sRGB in 8 bits, then
expanded. Light against that of the original, each after the one factor that brings it nearest: how bright the frame was
exposed is not the operator's to know. For each picture diffuse and glossy 0.5. The films of high dynamic range keep the same
exposure, 1 at 203 cd/m2, in 10 bits: what they lose lies above 10000 cd/m2 (PQ) and 1000 (HLG).

The constants of the default were fitted to 42 pictures of Poly Haven, whose names were not kept. "Apart": the first four
pictures, which are known not to be among them. The others come from Poly Haven too, so any of them may be.

)";
    md += toneMapTable(chart);
    md += R"(
## Balls in the film

A matte ball of albedo 0.5, and one that mirrors half at roughness 0.5, in frames of our films: root mean square difference of
what is displayed (0 to 1) to the same ball in the light that the frame was filmed in, which is as bright as the frame's
unclipped pixels. Nothing is scaled. Shadow: how much of the light on level ground comes from the strongest light, which is what
its shadow takes away.

![Matte and glossy balls: thesis, linear, auto, their true light](balls.jpg)

)";
    md += ballTable(chart.balls) + "\n## Environments\n\n" + environmentList(chart);
    return writeFileWhole(folder / "chart.md", md);
}

} // namespace shoal::bench
