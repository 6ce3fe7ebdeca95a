// bench_player FOLDER [SEEDS [FIRST [PLAYER [DIVE]]]]: plays dives by modelled persons over many seeds, by
// PLAYER alone unless it is "all", in the reef if no dive is named. Prints a table and how often each of the
// dive's goals is reached, and writes FOLDER/players.tsv, with a row for each dive.
#include "engine/math/Quantile.h"
#include "tests/bench/Bench.h"
#include "tests/bench/player/PlayedDive.h"
#include "tests/playthrough/Rooms.h"

#include <fmt/format.h>

#include <string_view>

using namespace shoal;

namespace {

struct Kind {
    const char* name;
    player::PlayerSetup setup;
    int atLeast, atMost; // catches, in 9 of 10 dives
    float firstBefore_s; // the same of the first catch
};

std::vector<Kind> kinds() {
    using namespace player;
    using game::Assist;
    const game::DiveRules none{Assist::None}, normal, strong{Assist::Strong};
    const auto withMussels = [&](Device by) {
        return PlayerSetup{Skill::Practised, by, normal, 1, 1.2f, 1, true};
    };
    return {
        {"mouse, novice", {Skill::Novice, Device::Mouse, normal}, 4, 1000, 45},
        {"mouse, practised", {Skill::Practised, Device::Mouse, normal}, 10, 18, 90},
        {"mouse, practised, assist none", {Skill::Practised, Device::Mouse, none}, 4, 1000, 90},
        {"mouse, novice, assist strong", {Skill::Novice, Device::Mouse, strong}, 4, 1000, 45},
        {"mouse, practised, with mussels", withMussels(Device::Mouse), 10, 1000, 90},
        {"hands, novice", {Skill::Novice, Device::Hands, normal}, 4, 1000, 45},
        {"hands, practised", {Skill::Practised, Device::Hands, normal}, 10, 18, 90},
        {"hands, practised, with mussels", withMussels(Device::Hands), 10, 1000, 90},
        {"hands, practised, arms of 0.7 m", {Skill::Practised, Device::Hands, normal, 1, 0.7f}, 10, 18, 90},
        {"hands, practised, assist none", {Skill::Practised, Device::Hands, none}, 4, 1000, 90},
    };
}

void report(const Kind& kind, const std::vector<player::PlayedDive>& dives) {
    std::vector<int> caught;
    int met = 0, first = 0;
    double closings = 0, escapes = 0, lost = 0, startles = 0;
    std::array<double, 6> misses{};
    std::array<double, player::kDoings> spent_s{};
    std::vector<double> firsts;
    for (const player::PlayedDive& dive : dives) {
        caught.push_back(dive.caught);
        firsts.push_back(dive.firstCatch_s);
        met += dive.caught >= kind.atLeast && dive.caught <= kind.atMost;
        first += dive.firstCatch_s <= kind.firstBefore_s;
        closings += dive.closings, escapes += dive.escapes, lost += dive.lost, startles += dive.startles;
        for (size_t i = 0; i < misses.size(); ++i) misses[i] += dive.misses[i];
        for (size_t i = 0; i < spent_s.size(); ++i) spent_s[i] += dive.spent_s[i];
    }
    const auto n = static_cast<double>(dives.size());
    std::printf(
        "%-30s caught %2d %2d %2d (10, 50, 90 %%)  in goal %3.0f %%  first %4.1f %4.1f s (50, 90 %%), "
        "in time %3.0f %%\n    a dive: %.1f closings, %.1f escapes, %.1f lost, %.1f startled; "
        "missed: nothing %.1f, far %.1f, fast %.1f, early %.1f, behind %.1f\n"
        "    seconds: looking %.0f, waiting %.0f, chasing %.0f, holding %.0f, resting %.0f\n",
        kind.name, math::quantile(caught, 0.1), math::median(caught), math::quantile(caught, 0.9),
        100 * met / n, math::median(firsts), math::quantile(firsts, 0.9), 100 * first / n, closings / n,
        escapes / n, lost / n, startles / n, misses[1] / n, misses[2] / n, misses[3] / n, misses[4] / n,
        misses[5] / n, spent_s[0] / n, spent_s[1] / n, spent_s[2] / n, spent_s[3] / n, spent_s[4] / n);
}

} // namespace

int main(int count, char** arguments) {
    if (bench::lacksArguments(count, 1, "bench_player FOLDER [SEEDS [FIRST [PLAYER [DIVE]]]]")) return 2;
    const int seeds = count > 2 ? std::max(1, std::atoi(arguments[2])) : 50;
    const int from = count > 3 ? std::max(1, std::atoi(arguments[3])) : 1;
    auto files = game::loadDiveFiles(count > 5 ? arguments[5] : "reef");
    const auto rig = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json");
    Status found = !files ? Status(files.error()) : game::roomOf(files->dive.video).moveTo(files->dive.space);
    if (!rig) found = rig.error();
    if (!found) return bench::exitStatus("bench_player", found);
    std::string table =
        "player\tseed\tcaught\tfirst_s\tlost\tpoints\tclosings\tescapes\tlooking_s\twaiting_s\tchasing_s\n";
    const std::string_view wanted = count > 4 ? arguments[4] : "all";
    for (const Kind& kind : kinds()) {
        if (wanted != "all" && kind.name != wanted) continue;
        std::vector<player::PlayedDive> dives;
        const std::vector<game::Goal>& goals = files->dive.goals;
        std::vector<int> reached(goals.size()); // dives in which each goal is
        for (int seed = from; seed < from + seeds; ++seed) {
            player::PlayerSetup setup = kind.setup;
            setup.seed = static_cast<uint64_t>(seed);
            std::vector<bool> reaches(goals.size());
            const auto watch = [&](const game::DiveState& state, const game::Events&) {
                for (size_t i = 0; i < goals.size(); ++i)
                    reaches[i] = reaches[i] ||
                                 game::isReached(goals[i], state.score, state.phase == game::Phase::Results);
            };
            const player::PlayedDive& dive = dives.emplace_back(player::play(*files, *rig, setup, watch));
            for (size_t i = 0; i < goals.size(); ++i) reached[i] += reaches[i];
            table += fmt::format("{}\t{}\t{}\t{:.2f}\t{}\t{}\t{}\t{}\t{:.1f}\t{:.1f}\t{:.1f}\n", kind.name,
                                 seed, dive.caught, std::min(dive.firstCatch_s, files->dive.duration_s),
                                 dive.lost, dive.points, dive.closings, dive.escapes, dive.spent_s[0],
                                 dive.spent_s[1], dive.spent_s[2]);
        }
        report(kind, dives);
        for (size_t i = 0; i < goals.size(); ++i) {
            const game::Goal& goal = goals[i];
            std::printf("    goal of level %d, %s %d %s: in %3d %% of dives\n", goal.level,
                        game::kGoalNames[static_cast<size_t>(goal.kind)], goal.count,
                        goal.species < 0 ? "" : files->species[goal.species].name.c_str(),
                        100 * reached[i] / seeds);
        }
    }
    return bench::exitStatus("bench_player", writeFileWhole(Path(arguments[1]) / "players.tsv", table));
}
