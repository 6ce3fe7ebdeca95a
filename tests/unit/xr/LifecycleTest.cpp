// What each state of a session asks of the game, as OpenXR 1.0 orders it (chapter "Session Lifecycle").
#include "engine/xr/Lifecycle.h"

#include <gtest/gtest.h>

namespace shoal::xr {
namespace {

struct Row {
    SessionState state;
    Step step;
    bool frames, drawn, plays;
};

TEST(Lifecycle, EachStateHasItsDuty) {
    for (const Row& row : {
             Row{SessionState::None, Step::Nothing, false, false, false},
             Row{SessionState::Idle, Step::Nothing, false, false, false},
             Row{SessionState::Ready, Step::Begin, true, false, false},
             Row{SessionState::Synchronized, Step::Nothing, true, false, false},
             Row{SessionState::Visible, Step::Nothing, true, true, false},
             Row{SessionState::Focused, Step::Nothing, true, true, true},
             Row{SessionState::Stopping, Step::End, false, false, false},
             Row{SessionState::LossPending, Step::Lost, false, false, false},
             Row{SessionState::Exiting, Step::Leave, false, false, false},
         }) {
        const Duty& duty = dutyIn(row.state);
        EXPECT_EQ(duty.step, row.step) << static_cast<int>(row.state);
        EXPECT_EQ(duty.frames, row.frames) << static_cast<int>(row.state);
        EXPECT_EQ(duty.drawn, row.drawn) << static_cast<int>(row.state);
        EXPECT_EQ(duty.plays, row.plays) << static_cast<int>(row.state);
    }
}

TEST(Lifecycle, OnlyWhoSeesPlaysAndOnlyWhoRunsSees) {
    for (const Duty& duty : kDuties) {
        EXPECT_TRUE(!duty.plays || duty.drawn);
        EXPECT_TRUE(!duty.drawn || duty.frames);
    }
}

} // namespace
} // namespace shoal::xr
