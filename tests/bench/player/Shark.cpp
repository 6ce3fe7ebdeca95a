// Measures the shark in whole dives of modelled players, and of a scripted one who offers it fish, in open
// water and the films' rooms, or in one film or another dive's file: bench_shark [SEEDS [FIRST [DIVE]]].
#include "tests/bench/player/PlayedDive.h"
#include "tests/bench/player/SharkWatch.h"
#include "tests/playthrough/Play.h"
#include "tests/playthrough/Rooms.h"

#include <cstdio>
#include <cstdlib>

using namespace shoal;

namespace {

void report(const char* who, const player::SharkWatch& w) {
    const double n = w.dives, ticks = w.ticks / 100;
    std::printf(
        "  %-24s loses a fish in %.2f of the dives; a dive: %.2f steals of %.2f strikes, %.2f threats, %.1f "
        "grabs; %.2f bumps; farther out than the median fish %.0f %% (with room %.0f %% of %.0f %%), near "
        "%.2f (its middle %.2f) %%; circles %.0f, visits %.0f, threatens %.0f, strikes %.0f, leaves %.0f "
        "%%\n",
        who, w.divesWithLoss / n, w.steals / n, w.strikes / n, w.threats / n, w.grabs / n, w.bumps / n,
        w.farther / ticks, 100 * w.fartherWithRoom / std::max(1.0, w.roomTicks), w.roomTicks / ticks,
        w.near / ticks, w.middleNear / ticks, w.inState[0] / ticks, w.inState[1] / ticks,
        w.inState[2] / ticks, w.inState[3] / ticks, w.inState[4] / ticks);
    std::fflush(stdout);
}

struct Person {
    const char* name;
    player::Skill skill;
    player::Device device;
    float heeds = 0;
};
constexpr Person kPeople[] = {{"mouse, novice", player::Skill::Novice, player::Device::Mouse},
                              {"hands, novice", player::Skill::Novice, player::Device::Hands},
                              {"mouse, practised", player::Skill::Practised, player::Device::Mouse, 0.5f},
                              {"hands, practised", player::Skill::Practised, player::Device::Hands, 0.5f},
                              {"mouse, obeys warnings", player::Skill::Practised, player::Device::Mouse, 1},
                              {"hands, obeys warnings", player::Skill::Practised, player::Device::Hands, 1}};

} // namespace

int main(int count, char** arguments) {
    const int seeds = count > 1 ? std::max(1, std::atoi(arguments[1])) : 20;
    const int from = count > 2 ? std::max(1, std::atoi(arguments[2])) : 1;
    const auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    const auto offers = game::loadScript(dataRoot() / "tests/playthrough/shark_steals.toml");
    if (!rig || !offers) return 1;
    for (const std::string film : {"open water", "reef", "night", "kelp"}) {
        if (count > 3 && arguments[3] != film && !std::string_view(arguments[3]).ends_with(".toml")) continue;
        auto files = game::loadDiveFiles(count > 3 ? arguments[3] : film == "open water" ? "reef" : film);
        if (!files) return std::fprintf(stderr, "%s\n", files.error().message().c_str()), 1;
        if (film != "open water") {
            auto room = game::roomOf(film);
            if (!room) return 1;
            files->dive.space = *room;
        }
        std::printf("%s:\n", film.c_str());
        const auto watching = [&](player::SharkWatch& watch) {
            watch.begin();
            return [&](const game::DiveState& s, const game::Events& events) {
                watch.see(s, events, files->dive, files->species);
            };
        };
        for (const Person& person : kPeople) {
            player::SharkWatch watch;
            for (int seed = from; seed < from + seeds; ++seed)
                player::play(*files, *rig,
                             {.skill = person.skill,
                              .device = person.device,
                              .heedsShark = person.heeds,
                              .seed = static_cast<uint64_t>(seed)},
                             watching(watch));
            report(person.name, watch);
        }
        player::SharkWatch watch;
        for (int seed = from; seed < from + seeds; ++seed) {
            game::Script script = *offers;
            script.seed = static_cast<uint64_t>(seed);
            game::playScript(script, *rig, *files, {}, watching(watch));
        }
        report("offers fish", watch);
    }
    return 0;
}
