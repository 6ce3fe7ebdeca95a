// How often animals are behind what the films of the three dives show, over whole dives with nobody there,
// without and with the grid of distances: bench_space [SEEDS [PLAYER_SEEDS]]. Judged by the tracks' own
// frames, not by the grid. Then what modelled players catch, likewise.
#include "engine/math/LatLong.h"
#include "engine/media/DepthTrack.h"
#include "game/rules/Dive.h"
#include "game/views/FilmSpaceOf.h"
#include "tests/bench/player/PlayedDive.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

using namespace shoal;

namespace {

constexpr float kPenetration_m = 0.02f;
constexpr int kLook_ticks = 12; // ten looks a second

float distance_m(const media::DepthFrame& frame, const glm::vec3& dirEnv) {
    const glm::vec2 uv = latLongFromDirection(dirEnv);
    const int x = std::clamp(static_cast<int>(uv.x * static_cast<float>(frame.width)), 0, frame.width - 1);
    const int y = std::clamp(static_cast<int>(uv.y * static_cast<float>(frame.height)), 0, frame.height - 1);
    const bool sure =
        frame.confidence[static_cast<size_t>(y / 2) * (frame.width / 2) + x / 2] >= media::kMaxDepthCode / 2;
    return sure ? 1 / std::max(frame.inverse_perM(x, y), 1e-3f) : 1e3f;
}

float depthOf(const physics::Capsule& body, const media::DepthFrame& frame) {
    float deepest = 0;
    for (int i = 0; i <= 4; ++i) {
        const glm::vec3 at = body.a + (body.b - body.a) * (0.25f * static_cast<float>(i));
        const float length = glm::length(at);
        deepest = std::max(deepest, length + body.radius - distance_m(frame, at / length));
    }
    return deepest;
}

struct Penetration {
    double fish_s = 0, shark_s = 0; // creature-seconds
    float fishDeepest_m = 0, sharkDeepest_m = 0;
    const game::Species* deepest = nullptr; // of fish...
    float deepestAt_m = 0;                  // ...and how far it was from the eyes
    float fastest_mps = 0;                  // of a free fish
    double radius_m = 0;                    // sum over looks, of free fish
    int looks = 0;

    void look(const game::DiveState& s, const game::SpeciesTable& species, const media::DepthFrame& frame) {
        constexpr double kLook_s = kLook_ticks / static_cast<double>(sim::kTickRate_Hz);
        for (const game::Fish& f : s.fish) {
            if (!f.free()) continue;
            const float depth = depthOf(capsuleOf(f, species[f.species]), frame);
            if (depth > kPenetration_m) fish_s += kLook_s;
            if (depth > fishDeepest_m) {
                fishDeepest_m = depth;
                deepest = &species[f.species];
                deepestAt_m = glm::length(f.position);
            }
            fastest_mps = std::max(fastest_mps, glm::length(f.velocity));
            radius_m += static_cast<double>(glm::length(f.position));
            ++looks;
        }
        if (!s.shark.present) return;
        const float depth = depthOf(capsuleOf(s.shark, species[s.shark.species]), frame);
        if (depth > kPenetration_m) shark_s += kLook_s;
        sharkDeepest_m = std::max(sharkDeepest_m, depth);
    }
};

// All seeds at once: each frame of the track is decoded once.
Penetration swim(const game::DiveFiles& files, media::DepthTrack& track, int seeds) {
    std::vector<game::Dive> dives;
    for (int seed = 1; seed <= seeds; ++seed)
        dives.emplace_back(files.species, files.dive, static_cast<uint64_t>(seed));
    Penetration found;
    game::Events events;
    media::DepthFrame frame;
    const int ticks = static_cast<int>(files.dive.duration_s * sim::kTickRate_Hz);
    for (int tick = 1; tick <= ticks; ++tick) {
        const bool looks = tick % kLook_ticks == 0;
        if (looks) track.read(track.frameAt(static_cast<double>(tick) / sim::kTickRate_Hz), frame);
        for (game::Dive& dive : dives) {
            events.clear();
            dive.step({}, events);
            if (looks) found.look(dive.state(), files.species, frame);
        }
    }
    return found;
}

void play(const game::DiveFiles& files, const hands::HandRig& rig, int seeds) {
    using namespace player;
    for (const Skill skill : {Skill::Novice, Skill::Practised})
        for (const Device device : {Device::Mouse, Device::Hands}) {
            std::vector<int> caught;
            for (int seed = 1; seed <= seeds; ++seed) {
                PlayerSetup setup{.skill = skill, .device = device};
                setup.seed = static_cast<uint64_t>(seed);
                caught.push_back(player::play(files, rig, setup).caught);
            }
            std::sort(caught.begin(), caught.end());
            const bool novice = skill == Skill::Novice;
            const auto met =
                std::ranges::count_if(caught, [&](int n) { return novice ? n >= 4 : n >= 10 && n <= 18; });
            std::printf("    %s, %s: caught %d %d %d (least, median, most), in goal %d of %d\n",
                        device == Device::Mouse ? "mouse" : "hands", novice ? "novice" : "practised",
                        caught.front(), caught[caught.size() / 2], caught.back(), static_cast<int>(met),
                        seeds);
        }
}

} // namespace

int main(int count, char** arguments) {
    const int seeds = count > 1 ? std::max(1, std::atoi(arguments[1])) : 4;
    const int playerSeeds = count > 2 ? std::atoi(arguments[2]) : 0;
    const auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    for (const char* name : {"reef", "night", "kelp"}) {
        auto files = game::loadDiveFiles(name);
        if (!files || !rig) return 1;
        const Path film = dataRoot() / "content" / files->dive.video;
        auto track = media::DepthTrack::open(media::depthTrackOf(film), film);
        if (!track) {
            std::fprintf(stderr, "%s\n", track.error().message().c_str());
            return 1;
        }
        const auto began = std::chrono::steady_clock::now();
        const auto space = app::filmSpaceOf(film, 0);
        const auto made_ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began);
        if (!space) return 1;
        std::printf("%s: a grid of %d steps, %.1f MB, made in %.0f ms\n", name, space->steps(),
                    1e-6 * static_cast<double>(space->bytes()), made_ms.count());
        const double minutes = seeds * static_cast<double>(files->dive.duration_s) / 60;
        for (const bool with : {false, true}) {
            files->dive.space = with ? space : nullptr;
            const Penetration p = swim(*files, *track, seeds);
            std::printf("  %-7s fish %7.2f creature-seconds a minute, deepest %.2f m (%s, %.2f m from the "
                        "eyes); shark %6.2f, %.2f m; fish "
                        "%.2f m from the eyes, at most %.1f m/s\n",
                        with ? "with" : "without", p.fish_s / minutes, static_cast<double>(p.fishDeepest_m),
                        p.deepest ? p.deepest->name.c_str() : "none", static_cast<double>(p.deepestAt_m),
                        p.shark_s / minutes, static_cast<double>(p.sharkDeepest_m), p.radius_m / p.looks,
                        static_cast<double>(p.fastest_mps));
            if (playerSeeds > 0) play(*files, *rig, playerSeeds);
            std::fflush(stdout);
        }
    }
    return 0;
}
