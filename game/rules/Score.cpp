#include "game/rules/Score.h"

#include <algorithm>
#include <bit>

namespace shoal::game {

int Score::combo() const { return std::min(std::popcount(run), kMaxCombo); }

int Score::countCatch(int kind, int kindPoints) {
    const uint64_t bit = uint64_t{1} << kind;
    run = (run & bit) != 0 ? bit : run | bit;
    bestCombo = std::max(bestCombo, combo());
    ++caught;
    ++species[static_cast<size_t>(kind)].caught;
    const int given = kindPoints * combo();
    points += given;
    return given;
}

void Score::countLoss(int kind) {
    ++lost;
    ++species[static_cast<size_t>(kind)].lost;
    run = 0;
}

Score newScore(const SpeciesTable& species, const DiveFile& dive) {
    Score score;
    score.species.resize(species.size());
    score.reached.resize(dive.goals.size());
    return score;
}

int progressOf(const Goal& goal, const Score& score) {
    const auto progress = [&]() -> int {
        switch (goal.kind) {
        case GoalKind::Catch:
            return goal.species < 0 ? score.caught : score.species[static_cast<size_t>(goal.species)].caught;
        case GoalKind::Different:
            return static_cast<int>(std::ranges::count_if(score.species, &SpeciesTally::caught));
        case GoalKind::Score:
            return score.points;
        case GoalKind::NoLoss:
            return score.lost == 0 ? goal.count : 0;
        case GoalKind::Combo:
            return score.bestCombo;
        }
        return 0;
    };
    return std::min(progress(), goal.count);
}

bool isReached(const Goal& goal, const Score& score, bool over) {
    if (goal.kind == GoalKind::NoLoss && (!over || score.caught == 0)) return false;
    return progressOf(goal, score) >= goal.count;
}

} // namespace shoal::game
