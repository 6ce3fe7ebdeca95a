// Measurements of every method over every scene and environment, and what is written of them.
#pragma once

#include "tests/bench/occlusion/Cells.h"
#include "tests/bench/occlusion/Method.h"
#include "tests/bench/occlusion/Scene.h"
#include "tests/bench/occlusion/Truth.h"

namespace shoal::bench {

// Glossy light under occlusion.
constexpr float kGlossyRoughness = 0.25f; // of the smoothest surface in the game's dive

struct GlossyMeasured {
    std::string name;
    std::vector<double> errors; // [scene]: relative RMS over environments without point suns, equal weights
    std::vector<double> receiver_ns; // [scene]
};

struct GlossyChart {
    std::vector<double> noise; // [scene]: of the truth, the largest of any environment
    std::vector<GlossyMeasured> methods;
};

// Adds a scene to the chart.
void measureGlossy(GlossyChart& chart, const Scene& scene, const Rays& rays,
                   std::span<const Receiver> receivers, std::span<const Lit> environments);

// Relative root mean square errors in one scene and environment; NaN: not measured.
struct SceneError {
    double all = 0;    // over all receivers
    double shaded = 0; // over receivers that lose a tenth of their light or more
};

struct OcclusionMeasured {
    OcclusionLabel label;
    OcclusionMethod::Moves moves = OcclusionMethod::Moves::Free;
    std::vector<std::vector<SceneError>> errors; // [scene][environment]
    std::vector<double> receiver_ns;             // [scene]
    std::vector<double> body_us;                 // [scene]: time to build its structures, for each body
    std::vector<size_t> bytes;                   // [scene]
};

// Darkening of the ground below bodies; sums over environments.
struct GroundMeasured {
    std::string name;
    double squares = 0;              // of relative root mean square errors
    double spent_ns = 0, texels = 0; // time for how many shaded texels
    double reef = 0;                 // relative root mean square error in the light of the reef's film
};

constexpr std::string_view kReef = "video: reef"; // in OcclusionChart::environments

struct OcclusionChart {
    std::vector<std::string> scenes, environments;
    std::vector<bool> pointSun;             // [environment]
    std::vector<std::vector<double>> noise; // [scene][environment]: of the truth
    std::vector<double> open;               // [scene]: mean free share of the hemisphere
    std::vector<OcclusionMeasured> methods; // the first ignores occlusion
    GlossyChart glossy;
    std::vector<GroundMeasured> ground; // below the shark
    int groundEnvironments = 0;         // those with a light that casts shadows
};

void measureGround(OcclusionChart& chart, const Scene& scene, std::span<const Lit> environments,
                   const Cells& cells, bool quick);

OcclusionChart measureOcclusion(std::span<const Scene> scenes, bool quick);

// Quality of layered fragment buffers by their size: gaps, and errors in the picture of a body as a mirror.
struct LayerQuality {
    std::string body, method;
    int views = 0, resolution = 0;
    size_t bytes = 0;
    double gaps = 0;        // share of rays that hit where they should not, or the reverse
    double bounced[3] = {}; // relative RMS of the mirror's picture: 1, 2, 8 bounces allowed, as in the truth
    double ray_ns = 0, build_ms = 0;
};

// Measures the bodies that stand alone, by the thesis' method and the cured one, over views and resolutions.
std::vector<LayerQuality> measureLayers(std::span<const Scene> scenes, bool quick);

Status writeOcclusionMarkdown(const OcclusionChart& chart, const std::vector<LayerQuality>& layers,
                              const Path& folder);                             // occlusion.md
Status writeOcclusionPicture(const OcclusionChart& chart, const Path& folder); // occlusion.data.gp

constexpr size_t kShownScenes = 6; // those of black bodies

// Draws every scene side by side: without occlusion, by the methods, and the truth. Writes
// occlusion_sheet.png, without text: a row for each scene, columns as sheet.gp names them.
Status writeSheet(std::span<const Scene> scenes, const Path& folder);

} // namespace shoal::bench
