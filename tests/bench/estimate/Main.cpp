// bench_estimate make FOLDER : writes made films and their true depth there.
// bench_estimate measure NAME FILM TRUTH FROM_S : estimates the depth of the film, which begins at that
// second of the truth, and prints a line for each frame of the track: name, time, shares and factors, and
// the processor's seconds a frame of the track.
#include "content/make/depth/DepthTrackWriter.h"
#include "content/make/depth/FilmDepth.h"
#include "engine/math/LatLong.h"
#include "engine/math/Quantile.h"
#include "engine/media/DepthTrack.h"
#include "tests/bench/compose/Encode.h"

#include <random>

namespace {

using namespace shoal;
using namespace shoal::bench;

// --- Synthetic films of known depth: a ray caster draws textured spheres and a floor. Each scene has one
// thing that makes depth hard to estimate.

// Properties that make depth hard to estimate; Sideways is the reference for all others.
enum class Hardship {
    Sideways,    // a camera that moves to the right
    Forward,     // along the line of sight, its own axis
    Rotation,    // it only turns
    Still,       // it stands
    Caustics,    // sideways, patterns of light run over everything
    Animal,      // sideways, a large animal swims by
    Featureless, // sideways, only a quarter of the objects has any texture
    Darkness,    // sideways, a twentieth of the light, with noise
    Exposure,    // sideways, the exposure changes with time and from row to row
    SeamPoles,   // sideways, texture only at the seam and at both poles
    Stereo,      // omnidirectional stereo, 64 mm, left eye above right; the camera stands
};
// Names of the scenes, in this order.
constexpr const char* kNames[] = {"sideways",    "forward",  "rotation", "still",      "caustics", "animal",
                                  "featureless", "darkness", "exposure", "seam_poles", "stereo"};

constexpr int kWidth = 1024, kHeight = 512; // of one eye
constexpr int kFrames = 48, kFps = 24;
constexpr int kTrackWidth = 256, kTrackHeight = 128, kStep = 2; // as shoal-depth makes tracks
constexpr float kPace_m = 0.03f;                                // the camera's, each frame
constexpr float kBaseline_m = 0.064f;
constexpr float kFloor_m = -1.6f, kWater_m = 60;

struct Sphere {
    glm::vec3 centre;
    float radius;
    bool isPlain = false;
};

// Constant pseudo-random value of a lattice point, 0 to 1.
float lattice(int x, int y, int z) {
    uint32_t h = static_cast<uint32_t>(x) * 73856093u ^ static_cast<uint32_t>(y) * 19349663u ^
                 static_cast<uint32_t>(z) * 83492791u;
    h ^= h >> 15, h *= 2246822519u, h ^= h >> 13, h *= 3266489917u, h ^= h >> 16;
    return static_cast<float>(h & 0xffff) / 65535.0f;
}

float valueNoise(const glm::vec3& at) {
    const glm::vec3 cell{std::floor(at.x), std::floor(at.y), std::floor(at.z)};
    const glm::vec3 f = at - cell, s = f * f * (3.0f - 2.0f * f);
    float sum = 0;
    for (int k = 0; k < 8; ++k) {
        const int dx = k & 1, dy = k >> 1 & 1, dz = k >> 2;
        sum += (dx ? s.x : 1 - s.x) * (dy ? s.y : 1 - s.y) * (dz ? s.z : 1 - s.z) *
               lattice(static_cast<int>(cell.x) + dx, static_cast<int>(cell.y) + dy,
                       static_cast<int>(cell.z) + dz);
    }
    return sum;
}

// Returns noise with octaves down to the detail that a pixel resolves at that distance.
float texture(const glm::vec3& at, float distance) {
    float sum = 0, share = 0.5f;
    for (float period = 0.8f; period > 0.012f * distance && period > 0.01f; period *= 0.5f, share *= 0.8f)
        sum += share * (valueNoise(at / period) - 0.5f);
    return std::clamp(0.45f + 0.6f * sum, 0.02f, 1.0f);
}

float causticsAt(const glm::vec3& at, float time_s) {
    const float a = std::sin(5 * at.x + 3 * at.y + 4 * time_s) + std::sin(4 * at.z - 3.1f * time_s + at.x);
    const float ridge = 1 - std::min(std::abs(a), 1.0f);
    return 0.7f + 0.9f * ridge * ridge;
}

class World {
  public:
    explicit World(Hardship hardship) : hardship_(hardship) {
        std::mt19937 random(11);
        std::uniform_real_distribution<float> uniform(0, 1);
        for (int i = 0; i < 26; ++i) {
            const float angle =
                2 * std::numbers::pi_v<float> * (static_cast<float>(i) + uniform(random)) / 26;
            const float away = 2 + 7 * uniform(random);
            spheres_.push_back(
                {{away * std::sin(angle), -1.6f + 3.2f * uniform(random), -away * std::cos(angle)},
                 0.3f + 0.1f * away,
                 hardship == Hardship::Featureless && i % 4 != 0});
        }
        spheres_.push_back({{0.4f, 3.5f, 0.3f}, 1.2f}); // above
        if (hardship == Hardship::SeamPoles) {
            for (Sphere& each : spheres_) each.isPlain = true;
            spheres_.back().isPlain = false;
            spheres_.push_back({{0.5f, -1.4f, 0.2f}, 0.5f});
            for (const float x : {-1.2f, 0.3f, 1.6f}) spheres_.push_back({{x, 0.1f, 2.6f}, 0.8f});
        }
        if (hardship == Hardship::Animal) spheres_.push_back({{0, 0, 0}, 0.9f});
    }

    void moveTo(int frame) {
        time_s_ = static_cast<float>(frame) / kFps;
        if (hardship_ == Hardship::Animal)
            spheres_.back().centre = {-2.5f + 2 * time_s_, 0.2f, -2.5f + 0.4f * time_s_};
    }

    float timeNow_s() const { return time_s_; }

    // Returns the grey value, 0 to 1, of the surface that a ray hits, and its distance from the ray's origin.
    float look(const glm::vec3& from, const glm::vec3& dir, float& distance) const {
        distance = kWater_m;
        const Sphere* met = nullptr;
        for (const Sphere& each : spheres_) {
            const glm::vec3 to = each.centre - from;
            const float along = glm::dot(to, dir),
                        square = along * along - glm::dot(to, to) + each.radius * each.radius;
            if (square <= 0) continue;
            const float at = along - std::sqrt(square);
            if (at > 0.05f && at < distance) distance = at, met = &each;
        }
        bool isFloor = false;
        if (dir.y < -1e-3f)
            if (const float at = (kFloor_m - from.y) / dir.y; at < distance) distance = at, isFloor = true;
        const float water = 0.5f + 0.3f * dir.y;
        if (!met && !isFloor) return water;
        const glm::vec3 at = from + distance * dir;
        const bool isPlain =
            isFloor ? hardship_ == Hardship::Featureless || hardship_ == Hardship::SeamPoles : met->isPlain;
        float grey = isPlain ? 0.4f : texture(isAnimal(met) ? at - met->centre : at, distance);
        if (hardship_ == Hardship::Caustics) grey *= causticsAt(at, time_s_);
        const float clear = std::exp(-0.06f * distance);
        return grey * clear + water * (1 - clear);
    }

  private:
    bool isAnimal(const Sphere* met) const {
        return hardship_ == Hardship::Animal && met == &spheres_.back();
    }

    Hardship hardship_;
    std::vector<Sphere> spheres_;
    float time_s_ = 0;
};

// Place of the camera, and how far it has turned about +Y.
struct CameraPose {
    glm::vec3 at{0};
    float turned_rad = 0;
};

CameraPose poseAt(Hardship hardship, int frame) {
    const auto n = static_cast<float>(frame);
    if (hardship == Hardship::Still || hardship == Hardship::Stereo) return {};
    if (hardship == Hardship::Rotation) return {{0, 0, 0}, 0.01f * n};
    if (hardship == Hardship::Forward) return {{0, 0, -kPace_m * n}, 0};
    return {{kPace_m * n - 0.7f, 0.05f * std::sin(0.2f * n), 0}, 0.002f * n};
}

glm::vec3 turned(const glm::vec3& dir, float by_rad) {
    const float c = std::cos(by_rad), s = std::sin(by_rad);
    return {c * dir.x + s * dir.z, dir.y, -s * dir.x + c * dir.z};
}

// Omnidirectional stereo: the eyes lie on a circle, at right angles to each column's view.
glm::vec3 eyeOffset(Hardship hardship, const glm::vec3& dir, int eye) {
    if (hardship != Hardship::Stereo) return glm::vec3(0);
    const glm::vec3 right = glm::normalize(glm::vec3(-dir.z, 0, dir.x));
    return right * (eye == 0 ? -kBaseline_m / 2 : kBaseline_m / 2);
}

float gainAt(Hardship hardship, float time_s, int y) {
    if (hardship == Hardship::Darkness) return 0.05f;
    if (hardship != Hardship::Exposure) return 1;
    const float row = static_cast<float>(y) / kHeight;
    return 0.8f + 0.25f * std::sin(2 * std::numbers::pi_v<float> * (3 * time_s + row));
}

ImageRgb8 filmed(const World& world, Hardship hardship, int frame) {
    const int eyes = hardship == Hardship::Stereo ? 2 : 1;
    const CameraPose pose = poseAt(hardship, frame);
    ImageRgb8 picture(kWidth, kHeight * eyes);
    std::mt19937 random(static_cast<uint32_t>(frame) + 5);
    std::normal_distribution<float> noise(0, 1.5f); // grey values
    for (int row = 0; row < kHeight * eyes; ++row)
        for (int x = 0; x < kWidth; ++x) {
            const int y = row % kHeight;
            const glm::vec3 own = texelDirection(x, y, kWidth, kHeight);
            float distance = 0;
            const float grey = world.look(pose.at + eyeOffset(hardship, own, row / kHeight),
                                          turned(own, pose.turned_rad), distance);
            const float value = 255 * grey * gainAt(hardship, world.timeNow_s(), y) + noise(random);
            uint8_t* pixel = picture.at(x, row);
            pixel[0] = pixel[1] = pixel[2] = static_cast<uint8_t>(std::clamp(value, 0.0f, 255.0f));
        }
    return picture;
}

// Returns the true depth of a frame, for stereo that of the left eye, as in tracks.
media::DepthFrame truthOf(const World& world, Hardship hardship, int frame) {
    media::DepthFrame depth{kTrackWidth, kTrackHeight, {}, {}};
    const CameraPose pose = poseAt(hardship, frame);
    for (int y = 0; y < kTrackHeight; ++y)
        for (int x = 0; x < kTrackWidth; ++x) {
            const glm::vec3 own = texelDirection(x, y, kTrackWidth, kTrackHeight);
            float distance = 0;
            world.look(pose.at + eyeOffset(hardship, own, 0), turned(own, pose.turned_rad), distance);
            depth.inverse.push_back(
                distance < kWater_m ? media::depthCode(1 / distance, media::kExactDepthSteps) : uint16_t{0});
        }
    depth.confidence.assign(depth.inverse.size() / 4, media::kMaxDepthCode);
    return depth;
}

Status makeScene(Hardship hardship, const Path& film, const Path& truthFile) {
    World world(hardship);
    std::vector<ImageRgb8> frames;
    std::vector<media::DepthFrame> truth;
    for (int frame = 0; frame < kFrames; ++frame) {
        world.moveTo(frame);
        frames.push_back(filmed(world, hardship, frame));
        if (frame % kStep == 0) truth.push_back(truthOf(world, hardship, frame));
    }
    if (Status s = encode(film, frames, kFps); !s) return s;
    const auto identity = media::filmIdentity(film);
    if (!identity) return identity.error();
    auto writer = media::DepthTrackWriter::make(
        {kTrackWidth, kTrackHeight, kFrames / kStep, static_cast<double>(kFrames) / kFps}, {{*identity}});
    if (!writer) return writer.error();
    for (const media::DepthFrame& each : truth)
        if (Status s = writer->add(each); !s) return s;
    return writer->finish(truthFile);
}

// Writes NAME.mp4 and the truth, NAME.truth.mkv, of each scene to the folder, where they are not there yet.
Status makeScenes(const Path& folder) {
    for (size_t i = 0; i < std::size(kNames); ++i) {
        const std::string name = kNames[i];
        const Path truthFile = folder / (name + ".truth.mkv");
        std::error_code ignored;
        if (std::filesystem::exists(truthFile, ignored)) continue;
        if (Status s = makeScene(static_cast<Hardship>(i), folder / (name + ".mp4"), truthFile); !s) return s;
    }
    return Done{};
}

// --- The accuracy of estimates

constexpr double kConfident = 0.6;     // confidence at which depth is believed in full (content/README.md)
constexpr double kNear_perM = 0.1;     // 10 m
constexpr double kBeyond_perM = 0.002; // half of the first code; the truth has no distance below

struct Texel {
    double truth_perM, estimated_perM, weight;
    bool isConfident;
};

std::vector<Texel> texelsOf(const media::DepthFrame& estimated, const media::DepthFrame& truth) {
    std::vector<Texel> texels;
    for (int y = 0; y < estimated.height; ++y) {
        const double weight = std::cos((0.5 - (y + 0.5) / estimated.height) * std::numbers::pi);
        for (int x = 0; x < estimated.width; ++x) {
            const int tx = x * truth.width / estimated.width, ty = y * truth.height / estimated.height;
            const auto sure = estimated.confidence[static_cast<size_t>(y / 2) * estimated.width / 2 +
                                                   static_cast<size_t>(x / 2)];
            texels.push_back({truth.inverse_perM(tx, ty), estimated.inverse_perM(x, y), weight,
                              sure >= kConfident * media::kMaxDepthCode});
        }
    }
    return texels;
}

// Returns the median of estimated over true distances, of all confident texels.
double factorOf(const std::vector<std::vector<Texel>>& frames) {
    std::vector<double> factors;
    for (const auto& texels : frames)
        for (const Texel& each : texels)
            if (each.isConfident && each.truth_perM > kBeyond_perM && each.estimated_perM > 0)
                factors.push_back(each.truth_perM / each.estimated_perM);
    return factors.empty() ? 1 : math::median(factors);
}

double rightShare(const std::vector<Texel>& texels, double factor) {
    double right = 0, all = 0;
    for (const Texel& each : texels) {
        if (!each.isConfident) continue;
        all += each.weight;
        const double estimated = each.estimated_perM * factor;
        if (each.truth_perM <= kBeyond_perM)
            right += estimated < 2.5 * kBeyond_perM ? each.weight : 0; // beyond 200 m
        else if (estimated > 0 && std::abs(each.truth_perM / estimated - 1) <= 0.1)
            right += each.weight;
    }
    return all > 0 ? right / all : 0;
}

double coveredShare(const std::vector<Texel>& texels) {
    double covered = 0, all = 0;
    for (const Texel& each : texels) {
        if (each.truth_perM < kNear_perM) continue;
        all += each.weight;
        covered += each.isConfident ? each.weight : 0;
    }
    return all > 0 ? covered / all : 0;
}

// Prints for each frame: share of confident texels within 10 % of the truth after one factor for the film,
// the same after a factor of the frame's own, share of texels nearer than 10 m that are confident, the
// frame's factor over the film's, and the film's. Shares are of solid angle; a factor is the median of
// estimated over true distances. The film begins at from_s of the truth, which may be longer. all_s: for all
// frames.
Status printAccuracy(const std::string& name, const Path& estimated, const Path& truth, double from_s,
                     double all_s) {
    auto made = media::DepthTrack::open(estimated);
    if (!made) return made.error();
    auto known = media::DepthTrack::open(truth);
    if (!known) return known.error();
    std::vector<std::vector<Texel>> frames;
    std::vector<double> times_s;
    media::DepthFrame ours, theirs;
    for (int i = 0; i < made->info().frameCount; ++i) {
        times_s.push_back(made->info().duration_s * i / made->info().frameCount);
        if (!made->read(i, ours) || !known->read(known->frameAt(from_s + times_s.back()), theirs))
            return Error{estimated.string(), "cannot be compared: a frame of it or of the truth is damaged"};
        frames.push_back(texelsOf(ours, theirs));
    }
    const double factor = factorOf(frames);
    for (size_t i = 0; i < frames.size(); ++i) {
        const double own = factorOf({frames[i]});
        std::printf("%s\t%.3f\t%.4f\t%.4f\t%.4f\t%.4f\t%.4f\t%.3f\n", name.c_str(), times_s[i],
                    rightShare(frames[i], factor), rightShare(frames[i], own), coveredShare(frames[i]),
                    own / factor, factor, all_s / static_cast<double>(frames.size()));
    }
    return Done{};
}

Status measure(const std::string& name, const Path& film, const Path& truth, double from_s) {
    const Path track = film.string() + ".depth.mkv";
    depth::FilmDepthOptions options;
    if (name == "stereo") options.layout = media::Layout::TopBottom;
    const double began_ms = processor_ms();
    const auto made = depth::makeFilmDepth(film, track, options);
    if (!made) return made.error();
    if (*made == depth::FilmDepth::CannotBeKnown) {
        std::printf("%s\tcannot be known\n", name.c_str());
        return Done{};
    }
    return printAccuracy(name, track, truth, from_s, 1e-3 * (processor_ms() - began_ms));
}

} // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "";
    Status done = Error{"", "wrong arguments"};
    if (what == "make" && argc == 3) done = makeScenes(argv[2]);
    if (what == "measure" && argc == 6) done = measure(argv[2], argv[3], argv[4], std::atof(argv[5]));
    return exitStatus("bench_estimate", done);
}
