#include "engine/light/FindLights.h"
#include "engine/light/InverseToneMap.h"
#include "engine/light/Lookup.h"
#include "engine/light/MakeLight.h"
#include "engine/math/Colour.h"
#include "engine/math/LatLong.h"
#include "engine/math/Quantile.h"
#include "engine/media/Pictures.h"
#include "tests/bench/light/Measure.h"

#include <fmt/format.h>

namespace shoal::bench {

namespace {

constexpr int kTile = 160;           // pixels across
constexpr float kRadius = 0.38f;     // of a ball, in tiles
constexpr float kReflectance = 0.5f; // linear: albedo of the matte ball, reflectance of the glossy one
constexpr float kGlossyRoughness = 0.5f;
constexpr std::array kWays = {light::FrameRadiance::Thesis, light::FrameRadiance::Linear,
                              light::FrameRadiance::Auto};

enum class Ball { Matte, Glossy };

// Radiance that an eye far away, looking along -Z, gets from the ball at normal n, of unit reflectance.
glm::vec3 radianceAt(const light::EnvironmentLight& light, Ball ball, const glm::vec3& n) {
    if (ball == Ball::Matte) return light::lookUp(light.diffuse, n);
    return light::lookUpGlossy(light, glm::reflect(glm::vec3(0, 0, -1), n), kGlossyRoughness);
}

// The display value, as in the game: the thesis' light is between coded and linear and takes coded
// reflectances.
glm::vec3 shownOf(const glm::vec3& radiance, bool thesis) {
    if (thesis)
        return glm::clamp(light::displayFromRadiance(math::srgbFromLinear(kReflectance) * radiance), 0.0f,
                          1.0f);
    const glm::vec3 lin = glm::clamp(kReflectance * radiance, 0.0f, 1.0f);
    return {math::srgbFromLinear(lin.x), math::srgbFromLinear(lin.y), math::srgbFromLinear(lin.z)};
}

// Draws a ball before 90 degrees of the frame around -Z; visits the ball's pixels with their display values.
template <class Visit>
void drawBall(const light::EnvironmentLight& light, Ball ball, bool thesis, const Environment& environment,
              ImageRgb8& sheet, int left, int top, Visit&& visit) {
    for (int y = 0; y < kTile; ++y)
        for (int x = 0; x < kTile; ++x) {
            const glm::vec2 at((static_cast<float>(x) + 0.5f) / kTile - 0.5f,
                               0.5f - (static_cast<float>(y) + 0.5f) / kTile);
            const glm::vec2 on = at / kRadius;
            const float left2 = 1 - glm::dot(on, on);
            uint8_t* out = sheet.at(left + x, top + y);
            if (left2 <= 0) {
                const glm::dvec2 uv = latLongFromDirection(glm::normalize(glm::dvec3(2.0f * at, -1)));
                const ImageRgb8& frame = environment.frame;
                std::copy_n(frame.at(std::min(static_cast<int>(uv.x * frame.width), frame.width - 1),
                                     std::min(static_cast<int>(uv.y * frame.height), frame.height - 1)),
                            3, out);
                continue;
            }
            const glm::vec3 n(on, std::sqrt(left2));
            const glm::vec3 shown = shownOf(radianceAt(light, ball, n), thesis);
            visit(shown);
            for (int c = 0; c < 3; ++c) out[c] = static_cast<uint8_t>(std::lround(255 * shown[c]));
        }
}

// Factor on each channel of the true light that makes it as bright as the frame: exposure and
// white balance. Medians over what is neither clipped nor dark, because the lens scatters light and the codec
// leaves little of the darkest values.
glm::vec3 exposureOf(const Environment& filmed) {
    const ImageRgb8& frame = filmed.frame;
    const ImageRgbF& lit = filmed.radianceLin;
    std::array<std::vector<double>, 3> ratios;
    for (int y = 0; y < frame.height; y += 2)
        for (int x = 0; x < frame.width; x += 2)
            for (size_t c = 0; c < 3; ++c) {
                const uint8_t coded = frame.at(x, y)[c];
                const float light = lit.at(x * lit.width / frame.width, y * lit.height / frame.height)[c];
                if (coded > 20 && coded < 235 && light > 0)
                    ratios[c].push_back(math::linearOfByte()[coded] / light);
            }
    return {math::median(ratios[0]), math::median(ratios[1]), math::median(ratios[2])};
}

light::EnvironmentLight trueLight(const Environment& filmed) {
    ImageRgbF lit = filmed.radianceLin;
    const glm::vec3 exposure = exposureOf(filmed);
    for (size_t i = 0; i < lit.pixels.size(); ++i) lit.pixels[i] *= exposure[static_cast<int>(i % 3)];
    light::EnvironmentLight made;
    light::LightMaker({.minRoughness = 0.25f}).makeFromHdr(lit, made);
    return made;
}

light::EnvironmentLight lightOf(const Environment& filmed, light::FrameRadiance frames) {
    light::EnvironmentLight made;
    light::LightMaker({.baseWidth = 512, .minRoughness = 0.25f, .frames = frames}).make(filmed.view(), made);
    return made;
}

double shadowOf(const light::EnvironmentLight& light) {
    light::FoundLights found;
    light::LightFinder().find(light.radiance, found);
    if (found.count == 0) return 0;
    const light::FoundLight& first = found.lights[0];
    const float onGround = light::linearLuminance(first.irradiance) * std::max(first.direction.y, 0.0f);
    return onGround / light::linearLuminance(found.groundIrradiance);
}

} // namespace

Result<std::vector<BallErrors>> lightBalls(const Path& sheet) {
    constexpr size_t kEvery = 3; // the sheet shows the second of each so many frames
    constexpr int kColumns = 8;
    std::vector<BallErrors> balls;
    const std::vector<EnvironmentSource> sources = filmedSources();
    ImageRgb8 picture(kColumns * kTile, static_cast<int>(sources.size() / kEvery) * kTile),
        unseen(kColumns * kTile, kTile);
    for (size_t s = 0; s < sources.size(); ++s) {
        const auto filmed = sources[s].load();
        if (!filmed) return Error{sources[s].name, "film or true light cannot be read"};
        std::fprintf(stderr, "chart: balls, %s\n", sources[s].name.c_str());
        const bool onSheet = s % kEvery == 1 && s / kEvery < sources.size() / kEvery;
        ImageRgb8& on = onSheet ? picture : unseen;
        const int top = onSheet ? static_cast<int>(s / kEvery) * kTile : 0;
        const light::EnvironmentLight truth = trueLight(*filmed);
        BallErrors& errors = balls.emplace_back(sources[s].name);
        std::array<light::EnvironmentLight, kWays.size()> lights;
        for (size_t way = 0; way < kWays.size(); ++way) lights[way] = lightOf(*filmed, kWays[way]);
        for (const light::EnvironmentLight& each : lights) errors.shadow.push_back(shadowOf(each));
        errors.shadow.push_back(shadowOf(truth));
        for (const Ball ball : {Ball::Matte, Ball::Glossy}) {
            int left = ball == Ball::Matte ? 0 : kColumns / 2 * kTile;
            std::vector<glm::vec3> want;
            drawBall(truth, ball, false, *filmed, on, left + 3 * kTile, top,
                     [&](const glm::vec3& shown) { want.push_back(shown); });
            for (size_t way = 0; way < kWays.size(); ++way, left += kTile) {
                double sum = 0;
                size_t i = 0;
                drawBall(lights[way], ball, kWays[way] == light::FrameRadiance::Thesis, *filmed, on, left,
                         top, [&](const glm::vec3& shown) {
                             const glm::vec3 off = shown - want[i++];
                             sum += glm::dot(off, off);
                         });
                (ball == Ball::Matte ? errors.matte : errors.glossy)
                    .push_back(std::sqrt(sum / (3 * static_cast<double>(i))));
            }
        }
    }
    if (Status written = media::writePicture(sheet, picture); !written) return written.error();
    return balls;
}

std::string ballTable(const std::vector<BallErrors>& balls) {
    std::string out = "| frame | matte: thesis | linear | auto | glossy: thesis | linear | auto | shadow, %: "
                      "thesis | linear | auto | true |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    std::array<std::vector<double>, 2 * kWays.size()> columns;
    for (const BallErrors& each : balls) {
        out += "| " + each.frame + " |";
        for (size_t i = 0; i < columns.size(); ++i) {
            const double error = i < kWays.size() ? each.matte[i] : each.glossy[i - kWays.size()];
            out += fmt::format(" {:.3f} |", error);
            columns[i].push_back(error);
        }
        for (const double share : each.shadow) out += fmt::format(" {:.0f} |", 100 * share);
        out += "\n";
    }
    out += "| median |";
    for (auto& column : columns) out += fmt::format(" {:.3f} |", math::median(column));
    return out + " | | | |\n";
}

} // namespace shoal::bench
