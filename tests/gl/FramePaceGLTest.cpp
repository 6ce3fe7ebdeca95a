// Pace of frames, and the times of their parts.
#include "Spheres.h"
#include "engine/gl/FramePace.h"
#include "engine/gl/PassTimers.h"

namespace shoal {
namespace {

class FramePaceGL : public WithContext {};

int waits = 0; // calls of glClientWaitSync
PFNGLCLIENTWAITSYNCPROC waitSync = nullptr;

GLenum countedWait(GLsync sync, GLbitfield flags, GLuint64 timeout) {
    ++waits;
    return waitSync(sync, flags, timeout);
}

// A frame waits for the one before alone, so that one frame is in flight; a whole one waits for itself too.
TEST_F(FramePaceGL, WaitsForTheFrameBefore) {
    gl::FramePace pace;
    EXPECT_EQ(pace.card_ms(), 0);
    pace.begin();
    pace.end(); // resolves the entry points
    pace.begin();
    pace.end();
    waitSync = std::exchange(epoxy_glClientWaitSync, countedWait);
    waits = 0;
    for (int frame = 1; frame <= 3; ++frame) {
        pace.begin();
        pace.end();
        EXPECT_EQ(waits, frame);
        EXPECT_GE(pace.card_ms(), 0);
    }
    pace.begin();
    pace.end(true);
    EXPECT_EQ(waits, 5);
    pace.begin();
    pace.end();
    EXPECT_EQ(waits, 5); // nothing was in flight
    epoxy_glClientWaitSync = waitSync;
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

// Each moment of a frame counts for one part, the innermost; a part that a frame has not had takes no time.
TEST_F(FramePaceGL, PartsOfAFrameNest) {
    gl::PassTimers timers;
    timers.beginFrame(false);
    {
        const gl::PassTimers::Scope outer(&timers, "outer");
        const gl::PassTimers::Scope inner(&timers, "inner");
    }
    {
        const PartTimes::Scope again(&timers.onThread(), "outer");
        const PartTimes::Scope nobodyAsks(nullptr, "lost");
    }
    const auto names = [&] {
        std::vector<std::string> parts;
        for (const PartTimes::Time& time : timers.onThread().times()) {
            EXPECT_GE(time.ms, 0) << time.part;
            parts.emplace_back(time.part);
        }
        return parts;
    };
    const std::vector<std::string> expected{"other", "outer", "inner"};
    EXPECT_EQ(names(), expected);
    timers.beginFrame(false);
    EXPECT_EQ(names(), expected);
    EXPECT_EQ(timers.onThread().times()[1].ms, 0);
}

} // namespace
} // namespace shoal
