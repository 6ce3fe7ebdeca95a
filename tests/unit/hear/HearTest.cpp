#include "game/Hear.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace shoal::game {
namespace {

constexpr float kTick_s = 1.0f / 120;

TEST(Hear, EveryKindOfEventIsHeard) {
    for (size_t kind = 0; kind < kEventNames.size(); ++kind) {
        Hear hear;
        const Event event{.kind = static_cast<Event::Kind>(kind), .strength = 1, .position = {1, 0, 0}};
        hear.listen({}, {&event, 1}, kTick_s);
        EXPECT_EQ(hear.shots().size(), 1u) << kEventNames[kind];
    }
}

TEST(Hear, TheBedNeverEnds) {
    Hear hear;
    for (int i = 0; i < 3; ++i) {
        hear.listen({}, {}, kTick_s);
        ASSERT_EQ(hear.emitters().size(), 1u);
        EXPECT_TRUE(hear.emitters()[0].everywhere);
    }
}

TEST(Hear, AHeldFishStruggles) {
    Snapshot shown;
    shown.creatures.resize(3);
    for (uint32_t i = 0; i < 3; ++i) shown.creatures[i].id = i;
    shown.creatures[1].heldBy = 0;
    shown.creatures[1].position = {0.2f, 0, -0.5f};
    Hear hear;
    hear.listen(shown, {}, kTick_s);
    ASSERT_EQ(hear.emitters().size(), 2u);
    EXPECT_EQ(hear.emitters()[1].position, shown.creatures[1].position);
}

TEST(Hear, AFishIsHeardPassingOnce) {
    Snapshot shown;
    shown.creatures.resize(1);
    shown.creatures[0].position = {0, 0, -0.5f};
    shown.creatures[0].velocity = {1, 0, 0};
    Hear hear;
    size_t passes = 0;
    for (int i = 0; i < 120; ++i) {
        hear.listen(shown, {}, kTick_s);
        passes += hear.shots().size();
    }
    EXPECT_EQ(passes, 1u);
}

TEST(Hear, TheLastFiveSecondsAreCounted) {
    Hear hear;
    Snapshot shown;
    int counts = 0;
    for (int i = 0; i < 8 * 120; ++i) {
        shown.timeLeft_s = 7.5f - static_cast<float>(i) * kTick_s;
        hear.listen(shown, {}, kTick_s);
        counts += static_cast<int>(hear.shots().size());
    }
    EXPECT_EQ(counts, 5);
}

TEST(Hear, CaptionsTellWhatAndWhereAndGo) {
    Hear hear;
    const Event event{.kind = Event::Kind::SharkNear, .position = {3, 0, 1}};
    hear.listen({}, {&event, 1}, kTick_s);
    ASSERT_EQ(hear.captions().size(), 1u);
    EXPECT_EQ(hear.captions()[0].position, event.position);
    for (int i = 0; i < 300; ++i) hear.listen({}, {}, kTick_s);
    EXPECT_TRUE(hear.captions().empty());
}

TEST(Sounds, AreAllThereAndNeitherClipNorClick) {
    for (const SoundRow& row : kSounds) {
        auto clip = audio::readClip(dataRoot() / "content" / "sounds" / (std::string(row.file) + ".flac"));
        ASSERT_TRUE(clip) << clip.error().sentence();
        EXPECT_EQ(clip->rate_Hz, 48000) << row.file;
        const auto& s = clip->samples;
        int peak = 0, step = 0;
        for (size_t i = 1; i < s.size(); ++i) {
            peak = std::max(peak, std::abs(static_cast<int>(s[i])));
            step = std::max(step, std::abs(s[i] - s[i - 1]));
        }
        EXPECT_LT(peak, 23200) << row.file << " peaks above -3 dB";
        EXPECT_GT(peak, 1000) << row.file << " cannot be heard";
        const bool loops =
            std::string_view(row.file).starts_with("bed") || std::string_view(row.file) == "struggle";
        // The seam of a loop is no steeper than the sound itself.
        if (loops) {
            EXPECT_LE(std::abs(s.front() - s.back()), step) << row.file;
        }
    }
}

} // namespace
} // namespace shoal::game
