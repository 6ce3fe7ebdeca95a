// Measurements of every method over every environment, single figures from them, and what is written of them.
#pragma once

#include "tests/baselines/light/Baselines.h"
#include "tests/baselines/light/Reference.h"
#include "tests/bench/light/Environments.h"

namespace shoal::bench {

constexpr float kRoughnesses[] = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f, 0.8f, 1.0f};

// [direction][lobe]
using Truth = std::vector<std::vector<glm::dvec3>>;

inline std::vector<glm::dvec3> column(const Truth& truth, size_t lobe) {
    std::vector<glm::dvec3> values;
    for (const auto& row : truth) values.push_back(row[lobe]);
    return values;
}

// Returns light::referenceRadiance() over every texel, computed on all cores.
Truth integrals(const ImageRgbF& radianceLin, std::span<const glm::dvec3> dirs,
                std::span<const light::Lobe> lobes);

// Errors over the directions of one environment, relative to the truth.
struct EnvironmentError {
    double rms = 0;   // root of sum |got - want|^2 over sum |want|^2
    double worst = 0; // largest |got - want| / |want|; where it is darker than a tenth of the root mean
                      // square, relative to that
};

inline EnvironmentError errorOf(const std::vector<glm::dvec3>& got, const std::vector<glm::dvec3>& want) {
    double off = 0, whole = 0;
    for (size_t i = 0; i < got.size(); ++i) {
        off += glm::dot(got[i] - want[i], got[i] - want[i]);
        whole += glm::dot(want[i], want[i]);
    }
    const double minimum = 0.1 * std::sqrt(whole / static_cast<double>(want.size()));
    EnvironmentError error{std::sqrt(off / whole), 0};
    for (size_t i = 0; i < got.size(); ++i)
        error.worst =
            std::max(error.worst, glm::length(got[i] - want[i]) / std::max(glm::length(want[i]), minimum));
    return error;
}

// Returns the error after the best single factor: how bright a frame was exposed nothing can know.
inline EnvironmentError errorAfterScaling(std::vector<glm::dvec3> got, const std::vector<glm::dvec3>& want) {
    double both = 0, own = 0;
    for (size_t i = 0; i < got.size(); ++i)
        both += glm::dot(got[i], want[i]), own += glm::dot(got[i], got[i]);
    for (glm::dvec3& each : got) each *= both / own;
    return errorOf(got, want);
}

// Errors over several environments or lobes, each with the same weight however bright it is.
class Pool {
  public:
    void add(const EnvironmentError& error) {
        squares_ += error.rms * error.rms;
        worst_ = std::max(worst_, error.worst);
        ++count_;
    }
    // NaN if nothing was measured.
    double rms() const { return std::sqrt(squares_ / count_); }
    double worst() const { return count_ ? worst_ : std::nan(""); }

  private:
    double squares_ = 0, worst_ = 0;
    int count_ = 0;
};

// Times on one core with warm caches, shortest of many runs, for a 2048x1024 frame.
struct Cost {
    double update_us = 0; // for each frame, with the pyramid if the method reads it
    double shade_ns = 0;  // a pixel

    double frame_us(double pixels) const { return update_us + 1e-3 * shade_ns * pixels; }
};

struct Measured {
    light::baselines::Label label;
    Cost cost;
    std::vector<std::vector<EnvironmentError>> errors; // [environment][lobe]; a diffuse method has one lobe
};

struct EnvironmentFact {
    std::string name;
    bool coded = false, pointSun = false;
};

// Root mean square differences from the display values under the true light, 0 to 1, over a ball lit by each
// light::FrameRadiance.
struct BallErrors {
    std::string frame;
    std::vector<double> matte, glossy; // thesis, linear, auto
    // Share of the light on level ground that comes from the strongest light, and that its shadow takes: by
    // those three, and by the true light.
    std::vector<double> shadow;
};

constexpr float kReefRoughness = 0.25f; // of the smoothest surface in the game's dive

struct Chart {
    double read_us = 0;     // one plain read of the frame's bytes, compiled for any x86-64
    double wideRead_us = 0; // the same, compiled for the processor's widest registers
    double reef_us = 0;     // all light of a frame for the game's own surfaces
    double pyramid_us = 0;  // added to the cost of each method that reads it
    std::vector<EnvironmentFact> environments;
    std::vector<Measured> diffuse, glossy; // glossy lobes: kRoughnesses
    std::vector<Measured> pyramids;        // one lobe: the diffuse one; only coded environments count
    // Errors of two lobes (diffuse, roughness 0.5) over toneMapEnvironments: its first toneMapsClipped are
    // clippedSources(), of which the first toneMapsApart are apartSources(); the rest are filmedSources().
    std::vector<Measured> toneMaps;
    size_t toneMapsApart = 0, toneMapsClipped = 0;
    std::vector<std::string> toneMapEnvironments;
    std::vector<BallErrors> balls; // one for each of filmedSources()
};

// Measures the costs of all methods; the chart has their labels in the same order.
void timeMethods(Chart& chart, std::vector<light::baselines::DiffuseMethod>& diffuse,
                 std::vector<light::baselines::GlossyMethod>& glossy,
                 std::vector<light::baselines::PyramidMethod>& pyramids, bool quick);

// Fills toneMaps and toneMapEnvironments.
void measureToneMaps(Chart& chart, bool quick, std::span<const glm::dvec3> dirs);

// Measures the whole chart. Reports its progress on standard error.
Chart measure(bool quick);

constexpr size_t kGlossyLobes = std::size(kRoughnesses);
constexpr double kGlossyPixels = 100000; // shaded in a frame, for one figure of a glossy method's cost

// Chooses environments.
enum class Suns { With, Without, Only };
Pool pooled(const Chart& chart, const Measured& method, Suns suns, size_t firstLobe, size_t lobes);

// Returns the median of one lobe's root mean square errors by an inverse tone mapping, over the clipped HDR
// pictures, those of them that are apart, or our film. NaN if nothing was measured.
enum class ToneMapped { Clipped, Apart, Film };
double medianOfToneMap(const Chart& chart, const Measured& method, ToneMapped which, size_t lobe);

// Draws balls of known reflectance in frames of the game's own films, whose true light is known: in the light
// made from the coded frame, and in the true light. sheet: a JPEG of five frames, a row each: thesis, linear,
// auto, the true light; matte, then glossy.
Result<std::vector<BallErrors>> lightBalls(const Path& sheet);
// Returns a table whose last row is the medians over all frames.
std::string ballTable(const std::vector<BallErrors>& balls);

Status writeMarkdown(const Chart& chart, const Path& folder); // chart.md
Status writePicture(const Chart& chart, const Path& folder);  // what chart.gp and tonemaps.gp draw

} // namespace shoal::bench
