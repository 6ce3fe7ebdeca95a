#include "game/app/ProgramStates.h"

#include "engine/core/Log.h"

#include <algorithm>

namespace shoal::app {

ProgramStates::ProgramStates(GameSession& session, Screens& screens, Mode mode, bool keepsScores)
    : session_(session), screens_(screens), mode_(mode), keepsScores_(keepsScores), before_(state()) {
    screens_.facts.freeSwim = mode_ != Mode::Dive;
    screens_.facts.firstSteps = mode_ == Mode::FirstSteps;
    screens_.close();
    entered(before_);
}

ProgramStates::State ProgramStates::state() const {
    if (mode_ == Mode::Title) return State::Title;
    if (session_.after.phase == game::Phase::Results) return State::Results;
    // A pause is the decision of the player, the headset, or the script or replay that plays.
    return (byPerson() ? session_.paused : session_.after.paused) ? State::Paused : State::Diving;
}

void ProgramStates::input(const Controls& controls, bool lostFocus, bool& leaving) {
    const bool pause = controls.was(Action::Pause);
    if (!byPerson()) { // a script or replay pauses and ends by itself
        leaving |= pause;
        return;
    }
    if (state() == State::Diving && (pause || lostFocus)) session_.paused = true;
}

void ProgramStates::update() {
    const State now = state();
    if (now == before_) return;
    before_ = now;
    entered(now);
}

void ProgramStates::entered(State state) {
    screens_.facts.results = session_.after;
    screens_.facts.seed = session_.dive.seed();
    keepGuide();
    if (state == State::Diving) return screens_.close();
    if (state == State::Results) keepScore();
    screens_.open(state == State::Title    ? Screen::Title
                  : state == State::Paused ? Screen::Paused
                                           : Screen::Results);
}

void ProgramStates::keepScore() {
    const std::string& dive = session_.dive.file().name;
    screens_.facts.scores = readScores(dive);
    // Only a person's dives count.
    if (!keepsScores_ || !byPerson()) return;
    if (Status saved = addScore(dive, session_.after.score); !saved) log::warn("{}", saved.error().message());
}

void ProgramStates::keepGuide() {
    std::vector<std::string>& met = screens_.facts.met;
    const size_t before = met.size();
    const auto& tally = session_.after.tally;
    for (size_t i = 0; i < tally.size(); ++i) {
        const std::string& name = session_.dive.species()[i].name;
        if (tally[i].touched && std::ranges::find(met, name) == met.end()) met.push_back(name);
    }
    if (met.size() == before || !keepsScores_ || !byPerson()) return;
    if (Status saved = saveGuide(met); !saved) log::warn("{}", saved.error().message());
}

} // namespace shoal::app
