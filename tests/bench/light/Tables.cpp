#include "tests/bench/light/Tables.h"

#include <cstdarg>
#include <cstdio>

namespace shoal::bench {

using light::rivals::Role;

namespace {

constexpr size_t kGlossyLobes = std::size(kRoughnesses);
constexpr size_t kNarrowLobes = 4; // roughness 0.1 to 0.4

[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
    char buffer[2048];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(buffer, sizeof buffer, format, arguments);
    va_end(arguments);
    return buffer;
}

std::string nameOf(const Measured& method) {
    const char* mark = method.label.role == Role::Default  ? " **(default)**"
                       : method.label.role == Role::Thesis ? " *(thesis)*"
                                                           : "";
    return method.label.name + mark;
}

const char* roleOf(const Measured& method) {
    return method.label.role == Role::Default  ? "default"
           : method.label.role == Role::Thesis ? "thesis"
                                               : "rival";
}

std::string percent(double value) { return text(value < 0.0995 ? "%.2f" : "%.1f", 100 * value); }

std::string diffuseTable(const Chart& chart) {
    std::string out =
        "| method | update, us | times a plain read | ns a pixel | error, % | without suns | worst direction "
        "| source |\n|---|--:|--:|--:|--:|--:|--:|---|\n";
    for (const Measured& each : chart.diffuse) {
        const Pool all = pooled(chart, each, Suns::With, 0, 1);
        out +=
            text("| %s | %.0f | %.1f | %.0f | %s | %s | %s | %s |\n", nameOf(each).c_str(),
                 each.cost.update_us, each.cost.update_us / chart.read_us, each.cost.shade_ns,
                 percent(all.rms()).c_str(), percent(pooled(chart, each, Suns::Without, 0, 1).rms()).c_str(),
                 percent(all.worst()).c_str(), each.label.source.c_str());
    }
    return out;
}

std::string glossyTable(const Chart& chart) {
    std::string out = "| method | update, us | ns a pixel | both, us | times a plain read | error, % | "
                      "roughness 0.1 to 0.4 "
                      "| 0.5 to 1 | worst direction | with suns: error, % | worst | source |\n"
                      "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|\n";
    for (const Measured& each : chart.glossy) {
        const Pool all = pooled(chart, each, Suns::Without, 0, kGlossyLobes);
        const Pool suns = pooled(chart, each, Suns::Only, 0, kGlossyLobes);
        const double both = frame_us(each.cost, kGlossyPixels);
        out += text(
            "| %s | %.0f | %.0f | %.0f | %.1f | %s | %s | %s | %s | %s | %s | %s |\n", nameOf(each).c_str(),
            each.cost.update_us, each.cost.shade_ns, both, both / chart.read_us, percent(all.rms()).c_str(),
            percent(pooled(chart, each, Suns::Without, 0, kNarrowLobes).rms()).c_str(),
            percent(pooled(chart, each, Suns::Without, kNarrowLobes, kGlossyLobes - kNarrowLobes).rms())
                .c_str(),
            percent(all.worst()).c_str(), percent(suns.rms()).c_str(), percent(suns.worst()).c_str(),
            each.label.source.c_str());
    }
    return out;
}

std::string roughnessTable(const Chart& chart) {
    std::string out = "| method |", rule = "|---|";
    for (const float roughness : kRoughnesses) {
        out += text(" %.1f |", static_cast<double>(roughness));
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
            for (const SurroundError& error : errors) pool.add(error);
        out += text("| %s | %.0f | %.1f | %s | %s |\n", nameOf(each).c_str(), each.cost.update_us,
                    each.cost.update_us / chart.read_us, percent(pool.rms()).c_str(),
                    percent(pool.worst()).c_str());
    }
    return out;
}

std::string toneMapTable(const Chart& chart) {
    std::string out = "| operator | diffuse, % | glossy 0.5, % |", rule = "|---|--:|--:|";
    for (const std::string& name : chart.toneMapSurrounds) {
        out += " " + name.substr(name.find(' ') + 1) + " |";
        rule += "--:|";
    }
    out += " source |\n" + rule + "---|\n";
    for (const Measured& each : chart.toneMaps) {
        Pool diffuse, glossy;
        for (const auto& errors : each.errors) diffuse.add(errors[0]), glossy.add(errors[1]);
        out += "| " + nameOf(each) + " | " + percent(diffuse.rms()) + " | " + percent(glossy.rms()) + " |";
        for (const auto& errors : each.errors)
            out += " " + percent(errors[0].rms) + " and " + percent(errors[1].rms) + " |";
        out += " " + each.label.source + " |\n";
    }
    return out;
}

std::string plainCsv(const std::vector<Measured>& methods, const std::vector<std::string>& surrounds) {
    std::string out = "method,role,us,surround,lobe,rms,worst\n";
    for (const Measured& each : methods)
        for (size_t s = 0; s < each.errors.size(); ++s)
            for (size_t k = 0; k < each.errors[s].size(); ++k)
                out += text("\"%s\",%s,%.1f,\"%s\",%s,%.6g,%.6g\n", each.label.name.c_str(), roleOf(each),
                            each.cost.update_us, surrounds[s].c_str(), k ? "glossy 0.5" : "diffuse",
                            each.errors[s][k].rms, each.errors[s][k].worst);
    return out;
}

std::string csv(const Chart& chart, const std::vector<Measured>& methods, size_t lobes, double pixels) {
    std::string out = "method,family,role,update_us,shade_ns,frame_us,plain_reads,rms,worst,rms_without_suns,"
                      "worst_without_suns,rms_only_suns,worst_only_suns\n";
    for (const Measured& each : methods) {
        const double frame = frame_us(each.cost, pixels);
        out +=
            text("\"%s\",\"%s\",%s,%.1f,%.2f,%.1f,%.3f", each.label.name.c_str(), each.label.family.c_str(),
                 roleOf(each), each.cost.update_us, each.cost.shade_ns, frame, frame / chart.read_us);
        for (const Suns suns : {Suns::With, Suns::Without, Suns::Only}) {
            const Pool pool = pooled(chart, each, suns, 0, lobes);
            out += text(",%.6g,%.6g", pool.rms(), pool.worst());
        }
        out += "\n";
    }
    return out;
}

std::string surroundCsv(const Chart& chart) {
    std::string out = "surround,point_sun,kind,roughness,method,rms,worst\n";
    for (size_t s = 0; s < chart.surrounds.size(); ++s)
        for (const bool glossy : {false, true})
            for (const Measured& each : glossy ? chart.glossy : chart.diffuse)
                for (size_t k = 0; k < each.errors[s].size(); ++k)
                    out += text("\"%s\",%d,%s,%s,\"%s\",%.6g,%.6g\n", chart.surrounds[s].name.c_str(),
                                chart.surrounds[s].pointSun, glossy ? "glossy" : "diffuse",
                                glossy ? text("%.1f", static_cast<double>(kRoughnesses[k])).c_str() : "",
                                each.label.name.c_str(), each.errors[s][k].rms, each.errors[s][k].worst);
    return out;
}

std::string surroundList(const Chart& chart) {
    std::string out;
    for (const SurroundFact& each : chart.surrounds)
        out += "- " + each.name + (each.coded ? ", 8 bits" : ", linear") +
               (each.pointSun ? ", **point sun**" : "") + "\n";
    return out;
}

} // namespace

Pool pooled(const Chart& chart, const Measured& method, Suns suns, size_t firstLobe, size_t lobes) {
    Pool pool;
    for (size_t s = 0; s < chart.surrounds.size(); ++s) {
        const bool sun = chart.surrounds[s].pointSun;
        if ((suns == Suns::Without && sun) || (suns == Suns::Only && !sun)) continue;
        for (size_t k = firstLobe; k < firstLobe + lobes; ++k) pool.add(method.errors[s][k]);
    }
    return pool;
}

double frame_us(const Cost& cost, double pixels) { return cost.update_us + 1e-3 * cost.shade_ns * pixels; }

Status writeTables(const Chart& chart, const Path& folder) {
    std::string md = "# Speed against accuracy\n\n![The chart](chart.png)\n\n";
    md += text(
        "One core; the shortest of many runs, warm; a 2048x1024 video frame. A plain read of that frame's "
        "bytes "
        "takes %.0f us, its radiance pyramid %.0f us; a method that reads the pyramid is charged with it. "
        "\"ns a pixel\" is the processor's time to shade one pixel. Errors are relative root mean squares "
        "over directions, each surround (and roughness) weighing the same. Truth is the integral in double "
        "precision over every texel at full resolution. A surround has a point sun where a ten-thousandth "
        "of the sphere gives more than a twentieth of the light.\n\n",
        chart.read_us, chart.pyramid_us);
    md += "## Diffuse\n\n" + diffuseTable(chart) + "\n## Glossy\n\n";
    md += text("\"both\" is one update and %.0f shaded pixels. Where not said otherwise, surrounds without "
               "point suns.\n\n",
               kGlossyPixels);
    md += glossyTable(chart) + "\nError in % by roughness, surrounds without point suns:\n\n" +
          roughnessTable(chart);
    md += "\n## The radiance pyramid\n\nOf the 8-bit surrounds: the diffuse light integrated over the "
          "pyramid's level "
          "of 128x64, against the truth.\n\n" +
          pyramidTable(chart);
    md += "\n## Inverse tone mapping\n\nThe HDR pictures exposed so that a tenth of their pixels lies above "
          "0.8, "
          "clipped at 1, kept as sRGB in 8 bits, then expanded. Light against that of the original, each "
          "after the one "
          "factor that brings it nearest; for each picture diffuse and glossy 0.5.\n\n" +
          toneMapTable(chart);
    md += "\n## Surrounds\n\n" + surroundList(chart);

    std::vector<std::string> names;
    for (const SurroundFact& each : chart.surrounds) names.push_back(each.name);
    const std::pair<const char*, std::string> files[] = {
        {"chart.md", md},
        {"diffuse.csv", csv(chart, chart.diffuse, 1, 0)},
        {"glossy.csv", csv(chart, chart.glossy, kGlossyLobes, kGlossyPixels)},
        {"pyramids.csv", plainCsv(chart.pyramids, names)},
        {"tonemaps.csv", plainCsv(chart.toneMaps, chart.toneMapSurrounds)},
        {"surrounds.csv", surroundCsv(chart)},
    };
    for (const auto& [name, content] : files)
        if (auto written = writeFileWhole(folder / name, content); !written) return written;
    return Done{};
}

} // namespace shoal::bench
