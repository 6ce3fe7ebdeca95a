#include "game/feedback/Feedback.h"
#include "tests/Test.h"

namespace shoal::game {
namespace {

constexpr float kFrame_s = 1.0f / 120;

// Returns one event of each kind, with a place and a speed if the kind has them.
Events oneOfEach() {
    Events events;
    for (const EventRow& row : kEventRows)
        if (row.kind == EventKind::DiveStart || row.kind == EventKind::DiveOver)
            events.push_back({.kind = row.kind});
        else
            events.push_back({.kind = row.kind, .position = glm::vec3(1, 0, 0), .closing_mps = 1});
    return events;
}

int count(const SoundCues& hear, Sound sound) {
    const auto shots = hear.shots();
    return static_cast<int>(std::count_if(shots.begin(), shots.end(), [&](const audio::Sound& shot) {
        return shot.clip == static_cast<int>(sound);
    }));
}

const audio::Sound* find(const SoundCues& hear, Sound sound) {
    for (const audio::Sound& emitter : hear.emitters())
        if (emitter.clip == static_cast<int>(sound)) return &emitter;
    return nullptr;
}

void happens(SoundCues& hear, const Event& event) { hear.listen({}, {&event, 1}, kFrame_s); }
SoundCues after(const Event& event) {
    SoundCues hear;
    happens(hear, event);
    return hear;
}

// Returns how often a creature that goes straight on is heard passing within `seconds`.
int passes(Sound sound, CreatureView creature, float seconds, const glm::vec3& headWorld = {}) {
    SoundCues hear;
    Snapshot shown{.headWorld = headWorld};
    shown.creatures = {creature};
    int heard = 0;
    for (int i = 0; i < static_cast<int>(seconds / kFrame_s); ++i) {
        hear.listen(shown, {}, kFrame_s);
        heard += count(hear, sound);
        shown.creatures[0].position += shown.creatures[0].velocity * kFrame_s;
    }
    return heard;
}

TEST(SoundCues, EveryKindOfEventIsHeardWhereItHappens) {
    for (const Event& event : oneOfEach()) {
        const SoundCues hear = after(event);
        ASSERT_EQ(hear.shots().size(), 1u) << rowOf(event.kind).name;
        const audio::Sound& shot = hear.shots()[0];
        EXPECT_EQ(shot.clip, static_cast<int>(rowOf(event.kind).sound)) << rowOf(event.kind).name;
        if (!shot.everywhere) {
            EXPECT_EQ(shot.position, event.position) << rowOf(event.kind).name;
        }
        EXPECT_GT(shot.gain, 0.1f) << rowOf(event.kind).name;
        EXPECT_LE(shot.gain, 1.0f) << rowOf(event.kind).name;
    }
}

bool hasCaption(const SoundCues& hear, EventKind kind) {
    return std::ranges::find(hear.captions(), *rowOf(kind).caption, &Caption::text) != hear.captions().end();
}

TEST(SoundCues, ANewDiveHasNoCaptionsOfTheLast) {
    SoundCues hear = after({.kind = EventKind::DiveOver});
    EXPECT_TRUE(hasCaption(hear, EventKind::DiveOver));
    happens(hear, {.kind = EventKind::DiveStart});
    EXPECT_FALSE(hasCaption(hear, EventKind::DiveOver));
    EXPECT_TRUE(hasCaption(hear, EventKind::DiveStart));
}

class HeardDive : public testing::Test {
  protected:
    void listen() { hear.listen(shown, {}, kFrame_s); }
    // Listens for as long; returns how often the sound begins.
    int begins(Sound sound, int seconds) {
        int heard = 0;
        for (int i = 0; i < seconds * 120; ++i) {
            listen();
            heard += count(hear, sound);
        }
        return heard;
    }
    SoundCues hear;
    Snapshot shown;
};

TEST_F(HeardDive, EverySoundIsPlayedOfSomething) {
    shown.creatures.resize(3);
    shown.creatures[0].heldBy = 0;
    shown.creatures[1] = {.id = 1, .position = {-2, 0, -0.5f}, .velocity = {1, 0, 0}, .length = 0.2f};
    shown.creatures[2] = {.id = 2, .position = {-4, 0, -1.5f}, .velocity = {1, 0, 0}, .length = 2.5f};
    std::set<int> heard;
    const auto note = [&] {
        for (const audio::Sound& shot : hear.shots()) heard.insert(shot.clip);
        for (const audio::Sound& emitter : hear.emitters()) heard.insert(emitter.clip);
    };
    for (const Event& event : oneOfEach()) {
        hear.listen(shown, {&event, 1}, kFrame_s);
        note();
    }
    shown.timeLeft_s = 10; // breaths, passes, the tunnel, the last seconds
    for (int i = 0; i < 10 * 120; ++i) {
        shown.timeLeft_s -= kFrame_s;
        shown.enclosure = 0.5f;
        for (size_t c = 1; c < 3; ++c) shown.creatures[c].position += shown.creatures[c].velocity * kFrame_s;
        listen();
        note();
    }
    for (size_t sound = 0; sound < kSounds.size(); ++sound)
        EXPECT_TRUE(heard.contains(static_cast<int>(sound))) << kSounds[sound].file;
}

TEST(SoundCues, EachSoundHasAFileAndEachEventItsName) {
    std::set<std::string_view> files, names;
    for (const SoundRow& row : kSounds) files.insert(row.file);
    EXPECT_EQ(files.size(), kSounds.size());
    for (const EventRow& row : kEventRows) names.insert(row.name);
    EXPECT_EQ(names.size(), kEventRows.size());
}

TEST(SoundCues, AHarderTouchIsLouderAndAllBonesAreOneTouch) {
    const auto gain = [](float strength) {
        return after({.kind = EventKind::Touch, .position = glm::vec3(0), .closing_mps = strength})
            .shots()[0]
            .gain;
    };
    EXPECT_GT(gain(1), gain(0.1f));
    SoundCues hear;
    const Events bones(5, Event{.kind = EventKind::Touch, .position = glm::vec3(0), .closing_mps = 1});
    hear.listen({}, bones, kFrame_s);
    EXPECT_EQ(count(hear, Sound::Touch), 1);
}

// A pause silences the device; the bed is still asked for, or it would begin anew afterwards.
TEST_F(HeardDive, TheBedNeverEnds) {
    for (const bool paused : {false, true, false}) {
        shown.paused = paused;
        listen();
        const audio::Sound* bed = find(hear, Sound::BedOpen);
        ASSERT_TRUE(bed);
        EXPECT_TRUE(bed->everywhere);
        EXPECT_FLOAT_EQ(bed->gain, rowOf(Sound::BedOpen).gain);
    }
}

TEST_F(HeardDive, TheBedsCrossOverInATunnel) {
    listen();
    EXPECT_FALSE(find(hear, Sound::BedTunnel));
    shown.enclosure = 1;
    for (int i = 0; i < 120; ++i) { // half way: both, and their powers still add to one
        listen();
        const auto power = [&](Sound sound) {
            const audio::Sound* bed = find(hear, sound);
            const float full = rowOf(sound).gain;
            return bed ? bed->gain * bed->gain / (full * full) : 0;
        };
        ASSERT_NEAR(power(Sound::BedOpen) + power(Sound::BedTunnel), 1, 1e-5);
    }
    EXPECT_TRUE(find(hear, Sound::BedOpen) && find(hear, Sound::BedTunnel));
    for (int i = 0; i < 240; ++i) listen();
    EXPECT_FALSE(find(hear, Sound::BedOpen));
}

TEST_F(HeardDive, AHeldFishStrugglesWhereItIs) {
    shown.creatures.resize(3);
    for (uint32_t i = 0; i < 3; ++i) shown.creatures[i].id = i;
    shown.creatures[1].heldBy = 0;
    shown.creatures[1].position = {0.2f, 0, -0.5f};
    listen();
    const audio::Sound* struggle = find(hear, Sound::Struggle);
    ASSERT_TRUE(struggle);
    EXPECT_EQ(struggle->position, shown.creatures[1].position);
    EXPECT_NE(struggle->id, find(hear, Sound::BedOpen)->id);
    shown.creatures[1].heldBy = -1;
    listen();
    EXPECT_FALSE(find(hear, Sound::Struggle));
}

TEST(SoundCues, AFishIsHeardPassingOnceAndOnlyNearAndFast) {
    const auto from = [](const glm::vec3& position, const glm::vec3& velocity, float length_m = 0.2f) {
        return CreatureView{.position = position, .velocity = velocity, .length = length_m};
    };
    EXPECT_EQ(passes(Sound::FishPassSmall, from({-2, 0, -0.5f}, {1, 0, 0}), 4), 1);
    EXPECT_EQ(passes(Sound::FishPassSmall, from({-2, 0, -1.2f}, {1, 0, 0}), 4), 0);    // too far
    EXPECT_EQ(passes(Sound::FishPassSmall, from({-1, 0, -0.5f}, {0.4f, 0, 0}), 5), 0); // too slow
    EXPECT_EQ(passes(Sound::FishPassSmall, from({0.1f, 0, -0.5f}, {1, 0, 0}), 1), 0);  // already past
    EXPECT_EQ(passes(Sound::FishPassLarge, from({-4, 0, -1.5f}, {1, 0, 0}, 2.5f), 8), 1);
    EXPECT_EQ(passes(Sound::FishPassSmall, from({-4, 0, -1.5f}, {1, 0, 0}, 2.5f), 8), 0);
    const glm::vec3 head(0, 0.5f, 1.5f); // of a player who stepped back
    EXPECT_EQ(passes(Sound::FishPassSmall, from({-2, 0.5f, 1}, {1, 0, 0}), 4, head), 1);
    EXPECT_EQ(passes(Sound::FishPassSmall, from({-2, 0, -0.5f}, {1, 0, 0}), 4, head), 0);
}

TEST_F(HeardDive, APassingIsNotRepeatedWithinSeconds) {
    shown.creatures.resize(1);
    shown.creatures[0].position = {0, 0, -0.5f};
    shown.creatures[0].velocity = {1, 0, 0};        // nearest now, for ever
    EXPECT_EQ(begins(Sound::FishPassSmall, 10), 3); // at 0, 4 and 8 s
}

TEST_F(HeardDive, TheLastFiveSecondsAreCounted) {
    int counts = 0;
    for (int i = 0; i < 8 * 120; ++i) {
        shown.timeLeft_s = 7.5f - static_cast<float>(i) * kFrame_s;
        listen();
        counts += count(hear, Sound::Countdown);
    }
    EXPECT_EQ(counts, 5);
}

TEST_F(HeardDive, TheDiverBreathes) {
    const int breaths = begins(Sound::Bubbles, 60);
    EXPECT_GE(breaths, 6); // a minute of breaths of six to nine seconds
    EXPECT_LE(breaths, 10);
}

TEST_F(HeardDive, CaptionsTellWhatAndWhereAndGo) {
    for (const glm::vec3 place :
         {glm::vec3(3, 0, 1), glm::vec3(-3, 0, 0)}) { // the same again only becomes new
        happens(hear, {.kind = EventKind::SharkNear, .position = place});
        ASSERT_EQ(hear.captions().size(), 1u);
        EXPECT_EQ(hear.captions()[0].text, rowOf(EventKind::SharkNear).caption);
        EXPECT_EQ(hear.captions()[0].position, place);
    }
    for (int i = 0; i < 300; ++i) listen();
    EXPECT_TRUE(hear.captions().empty());
}

// Two lines at once are read by nobody. Of those that come too soon the last one waits.
TEST_F(HeardDive, CaptionsComeOneASecond) {
    const auto inSight = [&] {
        std::vector<Text> texts;
        for (const Caption& caption : hear.captions())
            if (caption.age_s >= 0) texts.push_back(caption.text);
        return texts;
    };
    for (const EventKind kind : {EventKind::SharkNear, EventKind::Escape, EventKind::Catch})
        happens(hear, {.kind = kind, .position = glm::vec3(0, 0, -1)});
    const Text near = *rowOf(EventKind::SharkNear).caption, caught = *rowOf(EventKind::Catch).caption;
    EXPECT_EQ(inSight(), std::vector{near});
    for (float time_s = 0; time_s < 1.1f; time_s += kFrame_s) listen();
    EXPECT_EQ(inSight(), (std::vector{caught, near}));
}

TEST(SoundCues, EachEventThatMattersHasACaption) {
    // Somebody who hears nothing must learn what happens out of sight, and that a catch counted.
    for (const EventRow& row :
         {rowOf(EventKind::Catch), rowOf(EventKind::Escape), rowOf(EventKind::SharkNear),
          rowOf(EventKind::SharkSteal), rowOf(EventKind::SharkBump), rowOf(EventKind::DiveOver)})
        EXPECT_TRUE(row.caption) << row.name;
    EXPECT_FALSE(rowOf(EventKind::Release).caption); // the catch before it had one
    SoundCues held;
    held.listen({.creatures = {{.heldBy = 0}}}, {}, kFrame_s);
    ASSERT_EQ(held.captions().size(), 1u);
    EXPECT_EQ(held.captions()[0].text, Text("it struggles"));
    SoundCues late;
    late.listen({.timeLeft_s = 4.5f}, {}, kFrame_s);
    ASSERT_EQ(late.captions().size(), 1u);
    EXPECT_EQ(late.captions()[0].text, Text("the last seconds"));
}

TEST(SoundCues, PauseIsSilentAndKeepsTheCaptions) {
    const Event event{.kind = EventKind::Catch, .position = glm::vec3(0)};
    SoundCues hear = after(event);
    Snapshot shown{.paused = true, .creatures = {{.heldBy = 1}}};
    for (int i = 0; i < 1200; ++i) hear.listen(shown, {&event, 1}, kFrame_s);
    EXPECT_TRUE(hear.shots().empty());
    EXPECT_EQ(hear.emitters().size(), 1u); // the bed
    EXPECT_EQ(hear.captions().size(), 1u);
}

// Returns a dive in which one creature moves so, at this distance before the head.
Snapshot withCreature(Motion motion, float away_m) {
    Snapshot shown{.timeLeft_s = 60, .headWorld = {0, 0.4f, 1}};
    shown.creatures = {{.position = shown.headWorld - glm::vec3(0, 0, away_m), .gait = {.motion = motion}}};
    return shown;
}

TEST(Tension, FollowsTheShark) {
    const auto cruising = [](float away_m) { return tensionOf(withCreature(Motion::Cruise, away_m)); };
    EXPECT_EQ(cruising(4.2f), 0); // on its circle
    EXPECT_GT(cruising(2), 0);
    EXPECT_GT(cruising(1.5f), cruising(2));
    Snapshot threat = withCreature(Motion::Cruise, 2);
    threat.creatures[0].shape.finsDown = 0.65f;
    EXPECT_GT(tensionOf(threat), cruising(0));
    for (const Motion motion : {Motion::Lunge, Motion::Bite})
        EXPECT_EQ(tensionOf(withCreature(motion, 6)), 1);
    for (const Motion motion : {Motion::Swim, Motion::Dart, Motion::Struggle}) // a fish
        EXPECT_EQ(tensionOf(withCreature(motion, 0.3f)), 0);
    threat.phase = Phase::Results;
    EXPECT_EQ(tensionOf(threat), 0);
}

TEST(Tension, GrowsInTheLastTenSeconds) {
    const auto at = [](float left_s) { return tensionOf({.timeLeft_s = left_s}); };
    EXPECT_EQ(at(10), 0);
    EXPECT_GT(at(9), 0);
    EXPECT_GT(at(1), at(9));
    EXPECT_LT(at(0), 1); // less than a strike
    EXPECT_EQ(tensionOf({.freeSwim = true, .timeLeft_s = 1}), 0);
}

class HeardMusic : public HeardDive {
  protected:
    using Gains = std::array<float, kMusicLayers.size()>;

    // Listens for as long; returns the layers' gains, each of which changes by no more than a second's part.
    Gains hearFor(float seconds, std::span<const Event> events = {}) {
        for (int i = 0; i < static_cast<int>(seconds / kFrame_s); ++i) {
            hear.listen(shown, i == 0 ? events : std::span<const Event>(), kFrame_s, 1, 0.5f);
            for (size_t layer = 0; layer < gains.size(); ++layer) {
                const auto clip = static_cast<int>(kSounds.size() + layer);
                const auto found = std::ranges::find(hear.emitters(), clip, &audio::Sound::clip);
                if (found == hear.emitters().end()) return ADD_FAILURE() << "no layer", gains;
                EXPECT_TRUE(found->everywhere && found->inStep);
                EXPECT_LE(std::abs(found->gain - gains[layer]), 0.5f * kFrame_s);
                gains[layer] = found->gain;
            }
        }
        return gains;
    }
    Gains gains{};
};

TEST_F(HeardMusic, FollowsTheTensionWithoutSteps) {
    shown = withCreature(Motion::Cruise, 4.2f);
    const float calm = hearFor(3)[0];
    EXPECT_GT(calm, 0.3f);
    EXPECT_EQ(gains[1], 0);
    shown.creatures[0].gait.motion = Motion::Lunge;
    EXPECT_FLOAT_EQ(hearFor(3)[1], 0.5f); // all of the volume
    EXPECT_EQ(gains[0], calm);
    shown.paused = true; // goes on, so that it need not begin anew
    hearFor(1);
    shown.paused = false;
    shown.creatures[0].gait.motion = Motion::Cruise;
    EXPECT_EQ(hearFor(5)[1], 0);
}

TEST_F(HeardMusic, LiftsForAWhileAfterACatch) {
    shown = withCreature(Motion::Swim, 1);
    const float calm = hearFor(3)[0];
    const Event caught{.kind = EventKind::Catch, .position = glm::vec3(0)};
    EXPECT_GT(hearFor(2, {&caught, 1})[0], 1.2f * calm);
    EXPECT_EQ(hearFor(6)[0], calm);
}

} // namespace
} // namespace shoal::game
