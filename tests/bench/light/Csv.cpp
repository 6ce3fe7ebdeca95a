#include "engine/core/WriteFile.h"
#include "tests/bench/light/Pooled.h"
#include "tests/bench/light/Tables.h"
#include "tests/bench/light/Text.h"

namespace shoal::bench {

using light::baselines::Role;

namespace {

const char* roleOf(const Measured& method) {
    return method.label.role == Role::Default  ? "default"
           : method.label.role == Role::Thesis ? "thesis"
                                               : "rival";
}

std::string methodsCsv(const Chart& chart, const std::vector<Measured>& methods, size_t lobes,
                       double pixels) {
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

std::string environmentCsv(const Chart& chart) {
    std::string out = "surround,point_sun,kind,roughness,method,rms,worst\n";
    for (size_t s = 0; s < chart.environments.size(); ++s)
        for (const bool glossy : {false, true})
            for (const Measured& each : glossy ? chart.glossy : chart.diffuse)
                for (size_t k = 0; k < each.errors[s].size(); ++k)
                    out += text("\"%s\",%d,%s,%s,\"%s\",%.6g,%.6g\n", chart.environments[s].name.c_str(),
                                chart.environments[s].pointSun, glossy ? "glossy" : "diffuse",
                                glossy ? text("%.1f", static_cast<double>(kRoughnesses[k])).c_str() : "",
                                each.label.name.c_str(), each.errors[s][k].rms, each.errors[s][k].worst);
    return out;
}

std::string plainCsv(const std::vector<Measured>& methods, const std::vector<std::string>& environments) {
    std::string out = "method,role,us,surround,lobe,rms,worst\n";
    for (const Measured& each : methods)
        for (size_t s = 0; s < each.errors.size(); ++s)
            for (size_t k = 0; k < each.errors[s].size(); ++k)
                out += text("\"%s\",%s,%.1f,\"%s\",%s,%.6g,%.6g\n", each.label.name.c_str(), roleOf(each),
                            each.cost.update_us, environments[s].c_str(), k ? "glossy 0.5" : "diffuse",
                            each.errors[s][k].rms, each.errors[s][k].worst);
    return out;
}

// For tonemaps.gp: milliseconds, medians of the diffuse error over HDRs and film in percent, name. Bounds
// have no time.
std::string toneMapPoints(const Chart& chart) {
    std::string out;
    for (const Measured& each : chart.toneMaps)
        out += text("%.3f %.2f %.2f \"%s\"\n", each.cost.update_us / 1e3,
                    100 * medianOfToneMap(chart, each, false, 0), 100 * medianOfToneMap(chart, each, true, 0),
                    each.label.name.c_str());
    return out;
}

} // namespace

Status writeCsv(const Chart& chart, const Path& folder) {
    std::vector<std::string> names;
    for (const EnvironmentFact& each : chart.environments) names.push_back(each.name);
    const std::pair<const char*, std::string> files[] = {
        {"diffuse.csv", methodsCsv(chart, chart.diffuse, 1, 0)},
        {"glossy.csv", methodsCsv(chart, chart.glossy, kGlossyLobes, kGlossyPixels)},
        {"pyramids.csv", plainCsv(chart.pyramids, names)},
        {"tonemaps.csv", plainCsv(chart.toneMaps, chart.toneMapEnvironments)},
        {"tonemaps.dat", toneMapPoints(chart)},
        {"surrounds.csv", environmentCsv(chart)},
    };
    for (const auto& [name, content] : files)
        if (auto written = writeFileWhole(folder / name, content); !written) return written;
    return Done{};
}

} // namespace shoal::bench
