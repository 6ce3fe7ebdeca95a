// Films decoded at simulated costs, on a clock that counts their frames: it reads n when frame n is due.
#include "engine/media/VideoSource.h"
#include "tests/Test.h"

namespace shoal::media {
namespace {

constexpr double kLongest = 6; // a quarter of a second at 24 frames/s

struct Machine {
    double decode, show;   // costs of a picture while there is other load
    int keyFrames;         // their distance
    int references = 1;    // distance of the pictures that others refer to
    double loadEnds = 1e9; // from then on costs are a fiftieth
    double loadAt(double time) const { return time < loadEnds ? 1 : 0.02; }
    int64_t keyFrameBefore(int64_t index) const { return index - index % keyFrames; }
    // Counts the pictures that are decoded for a frame.
    int64_t decodedFor(int64_t made, const NextFrame& next) const {
        int64_t count = 0;
        for (int64_t i = std::max(made + 1, keyFrameBefore(next.index)); i <= next.index; ++i)
            count += !next.hurries || i % references == 0;
        return count;
    }
};

struct Played {
    double lateness = 0;   // greatest time for which a picture stayed while a later one was due
    double standstill = 0; // longest time from one picture to the next
};

// Returns how the film is shown from frame `from` to frame `to`.
Played play(const Machine& machine, int from, int to) {
    Played out;
    DecodingCost cost;
    int64_t made = -1, before = -1; // the frames made last
    double now = 0, shown = 0;      // shown: when frame `made` was
    while (now < to) {
        now = std::max(now, static_cast<double>(before)); // until then two frames wait, and there is no slot
        const NextFrame next = nextFrame(made, static_cast<int64_t>(now), cost, kLongest,
                                         [&](int64_t index) { return machine.keyFrameBefore(index); });
        EXPECT_GT(next.index, made);
        const double load = machine.loadAt(now);
        const double decoding = load * machine.decode * static_cast<double>(machine.decodedFor(made, next));
        cost.follow(next.index - made, decoding, load * machine.show);
        now += decoding + load * machine.show;
        const double shows = std::max(now, static_cast<double>(next.index));
        if (shown >= from) {
            out.lateness = std::max(out.lateness, shows - static_cast<double>(made + 1));
            out.standstill = std::max(out.standstill, shows - shown);
        }
        before = std::exchange(made, next.index);
        shown = shows;
    }
    return out;
}

// Bounds of what a machine shows, in frames.
struct Expected {
    double speed; // 1: decodes and shows each picture in real time
    double decodeShare;
    int keyFrames, references;
    double lateness, standstill;
};

const Expected kExpected[] = {{1.0, 0.5, 30, 1, 1, 1},
                              {1.0, 0.9, 250, 1, 1, 1},
                              // Leaving pictures unshown saves enough time.
                              {0.7, 0.1, 30, 1, 2, 2},
                              {0.7, 0.1, 250, 1, 2, 2},
                              {0.7, 0.5, 30, 1, 4, 3},
                              {0.7, 0.5, 250, 1, 4, 3},
                              {0.4, 0.1, 30, 1, 4, 3},
                              {0.4, 0.1, 250, 1, 4, 3},
                              // Decoding alone is too slow.
                              {0.7, 1.0, 30, 1, 12, 3},
                              {0.7, 1.0, 250, 1, 80, 3},
                              {0.4, 0.5, 30, 1, 18, 8},
                              {0.4, 0.5, 250, 1, 100, 8},
                              {0.4, 1.0, 30, 1, 24, 5},
                              {0.4, 1.0, 250, 1, 155, 5},
                              {0.1, 0.1, 30, 1, 40, 25},
                              {0.1, 0.1, 250, 1, 170, 25},
                              {0.1, 1.0, 30, 1, 40, 10},
                              {0.1, 1.0, 250, 1, 240, 10},
                              // All pictures are key frames.
                              {0.1, 0.5, 1, 1, 10, 10},
                              // Half of them are left out.
                              {0.7, 0.9, 250, 2, 8, 6}};

TEST(FramePacing, PicturesAreDroppedEvenlyAndFollowTheClock) {
    // Without a jump, a film that is decoded at a speed s < 1 is late by (1 - s) of the distance of key
    // frames, and by a step.
    for (const Expected& e : kExpected) {
        SCOPED_TRACE(e.speed);
        SCOPED_TRACE(e.keyFrames);
        const Machine machine{e.decodeShare / e.speed, (1 - e.decodeShare) / e.speed, e.keyFrames,
                              e.references};
        const Played played = play(machine, 500, 6000);
        EXPECT_LE(played.lateness, e.lateness) << e.decodeShare;
        EXPECT_LE(played.standstill, e.standstill) << e.decodeShare;
    }
}

TEST(FramePacing, AFilmIsOnTimeAgainSoonAfterTheLoadEnds) {
    for (const int keyFrames : {30, 250})
        for (const double decode : {0.9, 2.5, 10.0}) {
            const Played after = play({decode, decode, keyFrames, 1, 1100}, 1150, 3000);
            EXPECT_LE(after.lateness, 1) << decode;
            EXPECT_LE(after.standstill, 1) << decode;
        }
}

} // namespace
} // namespace shoal::media
