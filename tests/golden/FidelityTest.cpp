// glTF models drawn by `shoal view`, against path-traced pictures of the same scenes and against other
// real-time renderers. The bound: no further from the path tracer than the median of the real-time renderers.
#include "engine/core/Files.h"
#include "tests/Test.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace shoal {
namespace {

Path sharedFolder() { return tests::sharedDataFolder() / "fidelity"; }

// Pictures have four channels, alpha last; empty: there is none, or of another kind.
cv::Mat withAlpha(cv::Mat picture) {
    if (picture.type() == CV_8UC3) cv::cvtColor(picture, picture, cv::COLOR_BGR2BGRA);
    return picture.type() == CV_8UC4 ? picture : cv::Mat();
}

cv::Mat readPng(const Path& file) {
    if (!std::filesystem::exists(file)) return {};
    return withAlpha(cv::imread(file.string(), cv::IMREAD_UNCHANGED));
}

// The goldens were kept as lossy WebP, which stores colour at half the resolution: along an edge between
// blue and black that costs more than two renderers differ by. So ours is kept so too, at the best quality.
cv::Mat colourAtHalfResolution(const cv::Mat& picture) {
    std::vector<uint8_t> webp;
    if (!cv::imencode(".webp", picture, webp, {cv::IMWRITE_WEBP_QUALITY, 100})) return {};
    return withAlpha(cv::imdecode(webp, cv::IMREAD_UNCHANGED));
}

// Root mean square of the coded values' differences, 0 to 1, where both pictures are fully covered.
double rmse(const cv::Mat& a, const cv::Mat& b) {
    double sum = 0;
    size_t count = 0;
    for (int i = 0; i < a.rows * a.cols; ++i) {
        const auto &p = a.at<cv::Vec4b>(i / a.cols, i % a.cols), &q = b.at<cv::Vec4b>(i / a.cols, i % a.cols);
        if (p[3] != 255 || q[3] != 255) continue;
        for (int c = 0; c < 3; ++c) {
            const double difference = (p[c] - q[c]) / 255.0;
            sum += difference * difference;
        }
        count += 3;
    }
    return count ? std::sqrt(sum / static_cast<double>(count)) : 1.0;
}

// Onto the goldens' size by a triangle filter as wide as the reduction, alpha-weighted. The goldens were
// reduced from the size they were drawn at by an unknown filter; of box, triangle and Lanczos this one
// matches the path tracer's best, without shift, in all scenarios alike.
cv::Mat reduced(const cv::Mat& large, int width, int height) {
    cv::Mat small(height, width, CV_8UC4);
    const double ratio = static_cast<double>(large.cols) / width;
    const auto range = [&](int at, int maximum) {
        const double centre = (at + 0.5) * ratio - 0.5;
        return std::array{std::max(0, static_cast<int>(std::ceil(centre - ratio))),
                          std::min(maximum - 1, static_cast<int>(std::floor(centre + ratio)))};
    };
    const auto weight = [&](int at, int source) {
        return std::max(0.0, 1 - std::abs(source - ((at + 0.5) * ratio - 0.5)) / ratio);
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            cv::Vec4d sum;
            double all = 0;
            const auto [top, bottom] = range(y, large.rows);
            const auto [left, right] = range(x, large.cols);
            for (int v = top; v <= bottom; ++v)
                for (int u = left; u <= right; ++u) {
                    const double share = weight(x, u) * weight(y, v);
                    const auto& pixel = large.at<cv::Vec4b>(v, u);
                    for (int c = 0; c < 3; ++c) sum[c] += share * pixel[c] * pixel[3];
                    sum[3] += share * pixel[3];
                    all += share;
                }
            auto& out = small.at<cv::Vec4b>(y, x);
            for (int c = 0; c < 3; ++c)
                out[c] = static_cast<uint8_t>(std::lround(sum[3] > 0 ? sum[c] / sum[3] : 0));
            out[3] = static_cast<uint8_t>(std::lround(sum[3] / all));
        }
    return small;
}

std::string number(const nlohmann::json& value) { return std::to_string(value.get<double>()); }

// Distances to the path tracer's picture of one scene.
struct Distances {
    double ours = 0;
    std::map<std::string, double> others;

    double median() const {
        std::vector<double> sorted;
        for (const auto& [renderer, distance] : others) sorted.push_back(distance);
        std::sort(sorted.begin(), sorted.end());
        const size_t n = sorted.size();
        return n % 2 ? sorted[n / 2] : (sorted[n / 2 - 1] + sorted[n / 2]) / 2;
    }
};

// Draws the scene with `shoal view` and compares with the pictures beside it. Asserts what is missing.
void measure(const std::string& name, const std::string& pathTracer, Distances& distances) {
    const Path folder = sharedFolder();
    const auto text = readText(folder / "scenarios.json");
    if (!text) GTEST_SKIP() << "needs the reference data: " << text.error().message();
    const auto scenarios = nlohmann::json::parse(*text).at("scenarios");
    const auto found =
        std::find_if(scenarios.begin(), scenarios.end(), [&](const auto& s) { return s.at("name") == name; });
    ASSERT_NE(found, scenarios.end());
    const auto& scenario = *found;

    const auto& orbit = scenario.at("orbit");
    const auto& target = scenario.at("target");
    const Path picture = tests::cacheFolder() / (name + ".png"); // the average wants it too
    const std::string command = fmt::format(
        "XDG_CACHE_HOME='{}' '{}' view '{}' --env '{}' --env-yaw 90 --tone aces --orbit={},{},{} "
        "--target={},{},{} --fov {} --size {}x{} --background {} --out '",
        tests::cacheFolder().string(), tests::program(), (folder / scenario.at("model")).string(),
        (folder / scenario.at("lighting")).string(), number(orbit.at("theta")), number(orbit.at("phi")),
        number(orbit.at("radius")), number(target.at("x")), number(target.at("y")), number(target.at("z")),
        number(scenario.at("verticalFoV")), scenario.at("dimensions").at("width").get<int>(),
        scenario.at("dimensions").at("height").get<int>(),
        scenario.at("renderSkybox").get<bool>() ? "env" : "none");
    if (!std::filesystem::exists(picture)) {
        std::filesystem::create_directories(picture.parent_path());
        const Status drew = tests::writeWhole(picture, [&](const Path& out) -> Status {
            if (std::system((command + out.string() + "'").c_str()) == 0) return Done{};
            return Error{out.string(), command + " failed"};
        });
        ASSERT_TRUE(drew) << drew.error().message();
    }
    const cv::Mat drawn = readPng(picture);
    ASSERT_FALSE(drawn.empty());
    const cv::Mat ours = colourAtHalfResolution(
        reduced(drawn, scenario.at("golden_size")[0].get<int>(), scenario.at("golden_size")[1].get<int>()));
    ASSERT_FALSE(ours.empty());

    const auto golden = [&](const std::string& renderer) {
        return readPng(folder / name / ("golden_" + renderer + ".png"));
    };
    const cv::Mat truth = golden(pathTracer);
    ASSERT_FALSE(truth.empty());
    ASSERT_EQ(ours.size(), truth.size());
    for (const char* renderer : {"model-viewer", "filament", "babylon", "gltf-sample-viewer", "rhodonite"}) {
        const cv::Mat other = golden(renderer);
        if (other.size() != truth.size()) continue;
        // Its pose differs, so it is no measure of lighting.
        if (std::string(renderer) == "babylon" && name == "khronos-Fox") continue;
        distances.others[renderer] = rmse(other, truth);
    }
    ASSERT_FALSE(distances.others.empty());
    distances.ours = rmse(ours, truth);
}

constexpr auto kScenarios =
    std::to_array<const char*>({"DamagedHelmet", "Suzanne", "Duck", "Fox", "CesiumMan", "NormalTangentTest",
                                "VertexColorTest", "AnimatedMorphCube", "MetalRoughSpheresNoTextures"});

class Fidelity : public testing::TestWithParam<const char*> {};

TEST_P(Fidelity, NoFurtherFromThePathTracerThanTheMedianRealTimeRenderer) {
    const std::string name = std::string("khronos-") + GetParam();
    Distances distances;
    ASSERT_NO_FATAL_FAILURE(measure(name, "blender-cycles", distances));
    if (IsSkipped()) return;
    std::printf("[ FIDELITY ] %-36s ours %.4f  median %.4f |", name.c_str(), distances.ours,
                distances.median());
    for (const auto& [renderer, distance] : distances.others)
        std::printf("  %s %.4f", renderer.c_str(), distance);
    std::printf("\n");
    EXPECT_LE(distances.ours, distances.median());
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Fidelity, testing::ValuesIn(kScenarios),
                         [](const auto& each) { return std::string(each.param); });

// The mean over the scenes that a renderer has a picture of. The spheres against the other path tracer:
// Cycles' picture lacks a row of them.
TEST(FidelityOnAverage, AheadOfEveryRealTimeRenderer) {
    struct Mean {
        double ours = 0, theirs = 0;
        int scenes = 0;
    };
    std::map<std::string, Mean> means;
    for (const char* scenario : kScenarios) {
        const std::string name = std::string("khronos-") + scenario;
        Distances distances;
        ASSERT_NO_FATAL_FAILURE(measure(
            name, name == "khronos-MetalRoughSpheresNoTextures" ? "three-gpu-pathtracer" : "blender-cycles",
            distances));
        if (IsSkipped()) return;
        for (const auto& [renderer, distance] : distances.others) {
            Mean& mean = means[renderer];
            mean.ours += distances.ours;
            mean.theirs += distance;
            ++mean.scenes;
        }
    }
    for (const auto& [renderer, mean] : means) {
        std::printf("[ FIDELITY ] on average over %d scenes: ours %.4f  %s %.4f\n", mean.scenes,
                    mean.ours / mean.scenes, renderer.c_str(), mean.theirs / mean.scenes);
        EXPECT_LE(mean.ours, mean.theirs) << renderer;
    }
}

} // namespace
} // namespace shoal
