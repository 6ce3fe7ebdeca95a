// bench_contact FOLDER: how right contacts between bones and fish are, and their cost, beside Bullet 3.
// Writes contact.tsv there: method, scene, bone's speed, ticks a second, measure, mean, number of values.
#include "engine/core/Random.h"
#include "engine/math/Quantile.h"
#include "tests/LevelFloor.h"
#include "tests/bench/Bench.h"
#include "tests/bench/contact/Simulations.h"

#include <fmt/core.h>
#include <glm/gtc/quaternion.hpp>

namespace {

using namespace shoal;
using namespace shoal::bench;
using glm::dvec3;

constexpr Method kMethods[] = {
    {.name = "Shoal"},
    {.name = "Shoal, every pair", .everyPair = true},
    {.name = "Shoal, moved at once", .atOnce = true},
    {.name = "capsules, 1 step", .substeps = 1},
    {.name = "capsules, 4 steps", .substeps = 4},
    {.name = "capsules, 16 steps", .substeps = 16},
    {.name = "capsules, continuous", .substeps = 1, .continuous = true},
    {.name = "capsules, 4 steps, in metres", .substeps = 4, .scale = 1},
    {.name = "ellipsoids, 1 step", .substeps = 1, .ellipsoids = true},
    {.name = "ellipsoids, 4 steps", .substeps = 4, .ellipsoids = true},
    {.name = "ellipsoids, 16 steps", .substeps = 16, .ellipsoids = true},
    {.name = "ellipsoids, 4 steps, in metres", .substeps = 4, .ellipsoids = true, .scale = 1},
};
constexpr float kBoneRadius_m = 0.008f, kBoneHalf_m = 0.020f, kRadii_m = kFishRadius_m + kBoneRadius_m;
constexpr int kRounds = 40, kTimedRounds = 15;

double degreesBetween(dvec3 a, dvec3 b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

// Lays a scene anywhere near the origin and in any direction, so that no axis is special.
struct Frame {
    glm::mat3 turn;
    vec3 origin;
    explicit Frame(Random& random)
        : turn(glm::mat3_cast(glm::normalize(glm::quat(random.between(-1, 1), random.between(-1, 1),
                                                       random.between(-1, 1), random.between(-1, 1))))),
          origin(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)) {}
    Capsule bone(dvec3 middle, dvec3 axis) const {
        const vec3 at = origin + turn * vec3(middle), reach = turn * vec3(axis) * kBoneHalf_m;
        return {at - reach, at + reach, kBoneRadius_m};
    }
    dvec3 inside(vec3 world) const { return dvec3(glm::transpose(turn) * world); }
};

// Returns the distance before a fish, and the direction of the push, at which a bone along y that moves along
// x first touches the side of a fish along z. An ellipsoid's is where a curve beside an ellipse has that z.
std::pair<double, dvec3> firstContact(bool ellipsoid, double z) {
    if (!ellipsoid) return {double{kFishRadius_m} + double{kBoneRadius_m}, {1, 0, 0}};
    const double a = kFishRadius_m, c = a + double{kFishHalf_m}, side = z < 0 ? -1 : 1;
    double low = 0, high = std::numbers::pi / 2;
    for (int i = 0;; ++i) {
        const double angle = (low + high) / 2;
        const dvec3 normal = glm::normalize(dvec3(std::cos(angle) / a, 0, std::sin(angle) / c));
        const dvec3 at = dvec3(a * std::cos(angle), 0, c * std::sin(angle)) + normal * double{kBoneRadius_m};
        if (i == 60) return {at.x, {normal.x, 0, -side * normal.z}};
        (at.z < std::abs(z) ? low : high) = angle;
    }
}

class Measuring {
  public:
    explicit Measuring(const Method& method) : method_(method) {}

    // A bone strikes a fish, or a fish is flung against a bone at rest.
    void strike(Random random, float speed, float rate, bool flung) {
        begin(flung ? "flung" : "strike", speed, rate);
        const Frame frame(random);
        const double z = random.between(-kFishHalf_m, kFishHalf_m), aside = random.between(-0.01f, 0.01f);
        const auto [before, normal] = firstContact(method_.ellipsoids, z);
        const double dt = 1.0 / rate, start = kRadii_m + speed * dt * (1 + random.unit());
        const double touched = (start - before) / speed;
        const vec3 way = frame.turn * vec3(speed, 0, 0);
        const auto bones = [&](double time) {
            return Bones{frame.bone({-start + (flung ? 0 : speed * time), aside, z}, {0, 1, 0})};
        };
        const auto world =
            makeSimulation(method_, {{frame.origin, frame.turn[2], flung ? -way : vec3(0)}}, bones(0));
        const int ticks = static_cast<int>((start + 0.06) / (speed * dt)) + 6;
        bool found = false;
        for (int i = 0; i < ticks; ++i) {
            tick(*world, bones((i + 1) * dt), dt);
            if (found || touches_.empty()) continue;
            found = true;
            const Touch& first = touches_[0];
            if (flung) continue; // a Bullet step looks at where the fish was, and where the bone is
            note("first touch, ms", 1e3 * std::abs(i * dt + double{first.time_s} - touched));
            note("direction, degrees", degreesBetween(frame.inside(first.normal), normal));
            const double beyond = speed * (i * dt + double{first.seen_s} - touched);
            if (beyond < 2 * before) // they still overlap
                note("depth, mm", 1e3 * std::abs(double{first.depth_m} - std::max(0.0, beyond * normal.x)));
        }
        const Fish fish = world->fish(0);
        const double goal = speed * normal.x;
        const bool passed =
            glm::dot(frame.inside(fish.velocity + (flung ? way : vec3(0))), normal) < goal / 2;
        note("not found, %", found ? 0 : 100);
        note("passed through, %", passed ? 100 : 0);
        note("speed gained, %", 100 * std::max(0.0, double{glm::length(fish.velocity)} / speed - 1));
        if (!passed && !flung)
            note("off its place, mm",
                 1e3 * std::abs(goal * (ticks * dt - touched) -
                                glm::dot(frame.inside(fish.place - frame.origin), normal)));
    }

    // A bone at rest lies across a fish's axis, or just beside it.
    void crossed(Random random, bool exactly) {
        begin(exactly ? "crossed" : "nearly crossed", 0, 120);
        const Frame frame(random);
        const double beside = exactly ? 0 : random.between(1e-4f, 5e-3f), angle = random.between(0.5f, 1.57f);
        const dvec3 axis(0, std::sin(angle), std::cos(angle));
        const dvec3 middle = dvec3(-beside, 0, random.between(-0.5f, 0.5f) * kFishHalf_m) +
                             axis * double{random.between(-0.5f, 0.5f) * kBoneHalf_m};
        const Bones bones{frame.bone(middle, axis)};
        // The overlap along a direction, from both shapes' support functions; then the least by trial.
        const auto overlap = [&](dvec3 n) {
            const double a = kFishRadius_m, half = kFishHalf_m;
            const double fish =
                method_.ellipsoids ? glm::length(n * dvec3(a, a, a + half)) : half * std::abs(n.z) + a;
            return fish + kBoneHalf_m * std::abs(glm::dot(n, axis)) + kBoneRadius_m + glm::dot(n, middle);
        };
        dvec3 out(1, 0, 0);
        for (double step = 0.5; step > 1e-7;) {
            const dvec3 other = glm::normalize(
                out + step * dvec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)));
            if (overlap(other) < overlap(out))
                out = other;
            else
                step *= 0.97;
        }
        const auto world = makeSimulation(method_, {{frame.origin, frame.turn[2]}}, bones);
        for (int i = 0; i < 120; ++i) {
            tick(*world, bones, 1.0 / 120);
            if (i > 0 || touches_.empty()) continue;
            const dvec3 normal = frame.inside(touches_[0].normal);
            const double off = degreesBetween(normal, out);
            // Both ways out are as short if the axes cross.
            note("direction, degrees",
                 exactly ? std::min(off, degreesBetween(normal, out * dvec3(-1, 1, 1))) : off);
        }
        note("speed left, m/s", glm::length(world->fish(0).velocity));
    }

    // Two bones close on a fish from both sides, hold it for half a second, 16 mm deep in each side.
    void squeezed(Random random, float speed, float rate) {
        begin("squeezed", speed, rate);
        const Frame frame(random);
        const double z = random.between(-0.5f, 0.5f) * kFishHalf_m, away = kRadii_m + 0.02, nearest = 0.016;
        const auto bones = [&](double time) {
            const double x = std::max(nearest, away - speed * time);
            return Bones{frame.bone({-x, 0, z}, {0, 1, 0}), frame.bone({x, 0, z}, {0, 1, 0})};
        };
        const vec3 place = frame.origin + frame.turn[0] * random.between(-0.005f, 0.005f);
        const auto world = makeSimulation(method_, {{place, frame.turn[2]}}, bones(0));
        const double dt = 1.0 / rate, end = (away - nearest) / speed + 0.5;
        double fastest = 0;
        for (int i = 0; i * dt < end; ++i) {
            tick(*world, bones((i + 1) * dt), dt);
            fastest = std::max(fastest, double{glm::length(world->fish(0).velocity)});
        }
        note("speed gained, %", 100 * std::max(0.0, fastest / speed - 1));
        const dvec3 at = frame.inside(world->fish(0).place - frame.origin);
        const bool out = std::abs(at.x) > nearest || std::abs(at.z - z) > kFishHalf_m + kRadii_m;
        note("spat out, %", out ? 100 : 0);
    }

    // Two fists of 24 bones swing through forty fish for two seconds. Returns microseconds a tick.
    double fists(Random random) {
        begin("forty fish", 0, 120);
        std::vector<Fish> fish(40);
        for (Fish& f : fish) {
            const Frame frame(random);
            f = {frame.origin * vec3(0.4f, 0.3f, 0.4f), frame.turn[2], 0.2f * frame.turn[2]};
        }
        const auto world = makeSimulation(method_, fish, fistsAt(0));
        double spent_us = 0;
        for (int i = 0; i < 240; ++i) {
            const Bones to = fistsAt((i + 1) / 120.0);
            const double began = now_us();
            world->tick(to, 1.0f / 120, touches_);
            spent_us += now_us() - began;
            noteFlips();
            note("contacts a tick", static_cast<double>(last_.size()));
        }
        return spent_us / 240;
    }

    void noteCost(double us, double times) {
        us_.push_back(us);
        times_.push_back(times);
    }

    std::string rows() {
        begin("forty fish", 0, 120);
        note("us a tick", math::median(us_));
        note("cost, times ours", math::median(times_));
        std::string tsv;
        for (const auto& [key, all] : found_)
            tsv += fmt::format("{}\t{}\t{:.6g}\t{}\n", method_.name, key, all.sum / all.count, all.count);
        return tsv;
    }

  private:
    struct Values {
        double sum = 0;
        int count = 0;
    };

    void begin(const char* scene, float speed, float rate) {
        scene_ = fmt::format("{}\t{}\t{}", scene, speed, rate);
        last_.clear();
    }

    void note(const char* measure, double value) {
        Values& all = found_[scene_ + "\t" + measure];
        all.sum += value;
        ++all.count;
    }

    void tick(Simulation& world, const Bones& to, double dt) {
        world.tick(to, static_cast<float>(dt), touches_);
        noteFlips();
    }

    // Compares the last normal of each pair in this tick with that in the tick before.
    void noteFlips() {
        std::map<std::pair<int, int>, vec3> now;
        for (const Touch& touch : touches_) now[{touch.fish, touch.bone}] = touch.normal;
        for (const auto& [pair, normal] : now)
            if (const auto was = last_.find(pair); was != last_.end())
                note("flips, of 1000", glm::dot(normal, was->second) < 0 ? 1000 : 0);
        last_ = std::move(now);
    }

    static Bones fistsAt(double time) {
        constexpr float kLengths_m[] = {0.02f, 0.05f, 0.04f, 0.025f, 0.02f},
                        kBent[] = {0, 0, 1.57f, 3.1f, 4.3f};
        const auto t = static_cast<float>(2 * std::numbers::pi * time);
        Bones bones;
        for (const float side : {-1.0f, 1.0f}) {
            const vec3 wrist(0.35f * std::sin(t + side) + 0.15f * side, 0.2f * std::sin(0.7f * t),
                             0.35f * side * std::cos(0.9f * t));
            const glm::mat3 turn = glm::mat3_cast(glm::angleAxis(0.8f * std::sin(t), vec3(0.6f, 0.8f, 0)));
            for (int finger = 0; finger < 5; ++finger) {
                vec3 joint(0.018f * static_cast<float>(finger - 2), 0, 0);
                for (int i = 0; i < (finger == 0 ? 4 : 5); ++i) { // a thumb has a bone less
                    const vec3 next =
                        joint + kLengths_m[i] * vec3(0, -std::sin(kBent[i]), std::cos(kBent[i]));
                    bones.push_back({wrist + turn * joint, wrist + turn * next, kBoneRadius_m});
                    joint = next;
                }
            }
        }
        return bones;
    }

    const Method& method_;
    std::string scene_;
    std::map<std::string, Values> found_;
    std::map<std::pair<int, int>, vec3> last_;
    std::vector<Touch> touches_;
    std::vector<double> us_, times_;
};

// Twelve loose bodies sink to a floor or drift among forty fish for two seconds. Returns microseconds a tick.
double loose_us(Random random) {
    const auto place = [&](float high) { return vec3(random.between(-1, 1), high, random.between(-1, 1)); };
    std::vector<physics::Body> fish(40);
    for (physics::Body& f : fish) {
        const vec3 at = place(random.between(-0.5f, 0.5f)), half(0, 0, kFishHalf_m);
        f.id = static_cast<uint32_t>(&f - fish.data());
        f.before = f.after = {at - half, at + half, kFishRadius_m};
    }
    std::vector<physics::LooseBody> loose(12);
    for (physics::LooseBody& l : loose) {
        l.id = static_cast<uint32_t>(fish.size() + (&l - loose.data()));
        l.position = place(random.between(-0.5f, 0.2f));
    }
    physics::World world;
    std::vector<physics::Knock> knocks;
    const double began = now_us();
    for (int i = 0; i < 240; ++i) world.move(loose, fish, tests::levelFloor(-0.6f), 1.0f / 120, knocks);
    return (now_us() - began) / 240;
}

Status run(const Path& folder, int part) {
    std::vector<Measuring> all(std::begin(kMethods), std::end(kMethods));
    std::vector<double> loose;
    for (int round = 0; round < kTimedRounds / part; ++round) { // all methods in turn
        loose.push_back(loose_us(Random(round)));
        double ours = 0;
        for (Measuring& method : all) {
            const double us = method.fists(Random(round));
            if (&method == &all[0]) ours = us;
            method.noteCost(us, us / ours);
        }
    }
    std::string tsv = "method\tscene\tspeed\trate\tmeasure\tmean\tcount\n";
    for (Measuring& method : all) {
        for (uint64_t round = 0; round < static_cast<uint64_t>(kRounds / part); ++round) {
            uint64_t scene = 0;
            const auto random = [&] { return Random(round, ++scene); }; // the same scenes for each method
            for (const float rate : {60.0f, 120.0f, 240.0f}) {
                for (const float speed : {0.1f, 1.0f, 5.0f, 20.0f})
                    for (const bool flung : {false, true}) method.strike(random(), speed, rate, flung);
                for (const float speed : {0.1f, 0.5f, 2.0f}) method.squeezed(random(), speed, rate);
            }
            for (const bool exactly : {true, false}) method.crossed(random(), exactly);
        }
        tsv += method.rows();
    }
    tsv += fmt::format("Shoal\tloose\t0\t120\tus a tick\t{:.6g}\t{}\n", math::median(loose), loose.size());
    return writeFileWhole(folder / "contact.tsv", tsv);
}

} // namespace

int main(int argc, char** argv) {
    if (lacksArguments(argc, 1, "bench_contact FOLDER [--quick]")) return 2;
    return exitStatus("bench_contact", run(argv[1], argc == 3 ? 8 : 1));
}
