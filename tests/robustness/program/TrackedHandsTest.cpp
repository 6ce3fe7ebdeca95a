// Runs the program with a tracking service that fails as real ones do. A hand over the device closes on a
// fish; the service drops, stalls, sends invalid data and restarts meanwhile, and the game plays on. Time is
// that of the frames' stamps, so nothing waits for a clock.
#include "game/session/HandSource.h"
#include "input/hands/HandFilter.h"
#include "input/hands/leap/LeapMessage.h"
#include "tests/TestRig.h"
#include "tests/playthrough/Play.h"
#include "tests/robustness/program/Program.h"
#include "tests/unit/leap_service/Recordings.h"
#include "tests/unit/leap_service/Server.h"

#include <fmt/core.h>

#include <regex>

namespace shoal {
namespace {

namespace fs = std::filesystem;
using hands::test::Server;

using tests::rig;

struct Fist {
    glm::vec3 grasp{0}; // viewer's frame, when it closes for the first time
    double closes_s = -1, ends_s = 0;
};

// Returns where the hand of a recording closes, as our own reader finds it.
Fist fistIn(const std::vector<std::string>& messages) {
    hands::LeapTracks tracks(rig(), hands::kDeskMount);
    hands::HandFilter filter;
    Fist fist;
    int64_t first_us = -1;
    for (const std::string& message : messages) {
        const auto read = hands::readLeapMessage(message);
        if (!read) continue;
        const auto& leap = std::get<hands::LeapFrame>(*read);
        const hands::HandFrame frame = tracks.frame(leap, leap.time_us.value_or(0));
        if (first_us < 0) first_us = frame.time_us;
        filter.step(frame.hands[1], frame.identity[1], frame.time_us);
        fist.ends_s = static_cast<double>(frame.time_us - first_us) * 1e-6;
        if (fist.closes_s >= 0 || filter.gesture() != hands::Gesture::Fist) continue;
        fist.closes_s = fist.ends_s;
        fist.grasp = hands::graspCentre(filter.pose().joints);
    }
    return fist;
}

// Returns the recording slowed down, by stretched time stamps.
std::vector<std::string> slowed(const std::vector<std::string>& messages, double times) {
    static const std::regex stamp("\"timestamp\":([0-9]+)");
    std::vector<std::string> out;
    for (const std::string& message : messages) {
        std::smatch found;
        if (!std::regex_search(message, found, stamp)) continue;
        const auto us = static_cast<int64_t>(std::stod(found[1]) * times);
        out.push_back(found.prefix().str() + "\"timestamp\":" + std::to_string(us) + found.suffix().str());
    }
    return out;
}

class TrackedHands : public tests::Program {
  protected:
    void SetUp() override {
        environment_ = "SHOAL_DATA=" + folder_.string();
        fs::create_directories(folder_ / "content" / "dives");
        const Path source = tests::sourceFolder();
        fs::create_directory_symlink(source / "shaders", folder_ / "shaders");
        for (const auto& entry : fs::directory_iterator(source / "content"))
            if (entry.path().filename() != "dives")
                fs::create_symlink(entry.path(), folder_ / "content" / entry.path().filename());
    }

    // Writes a dive with clownfish in a narrow ring through the place where the fist closes, and no shark.
    // Returns the seed, of a hundred, with which a clownfish is nearest to that place when the fist closes.
    uint64_t putFishAt(const Fist& fist) const {
        const glm::vec3 at = fist.grasp;
        const float radius = std::hypot(at.x, at.z);
        std::ofstream(folder_ / "content/dives/ring.toml")
            << "title = \"Ring\"\nvideo = \"video/reef.mp4\"\nduration = 60\n\n[[school]]\nspecies = "
               "\"clownfish\"\ncount = 40\nradius = ["
            << std::max(radius - 0.05f, 0.6f) << ", " << radius + 0.05f << "]\nheight = [" << at.y - 0.05f
            << ", " << at.y + 0.05f << "]\n";
        const auto files = game::loadDiveFiles("ring", folder_ / "content");
        EXPECT_TRUE(files);
        uint64_t best = 1;
        float minimum = 10;
        for (uint64_t seed = 1; seed <= 100; ++seed) {
            game::Dive dive(files->species, files->dive, seed);
            std::vector<game::Event> events;
            game::Snapshot now;
            for (double t = 0; t < fist.closes_s; t += static_cast<double>(sim::kTick_s))
                dive.step({}, events);
            dive.snapshot(now);
            for (const game::CreatureView& creature : now.creatures)
                if (const float distance = glm::distance(creature.position, at); distance < minimum)
                    minimum = distance, best = seed;
        }
        EXPECT_LT(minimum, 0.04f);
        return best;
    }

    // Plays with the service at that port, which must succeed.
    void play(const char* hands, int port, double seconds, uint64_t seed) const {
        ASSERT_EQ(
            run(fmt::format("play --headless --size 64x36 --skip objects --no-depth --dive ring --hands {} "
                            "--leap 127.0.0.1:{} --seed {} --at {:.2f} --record run.replay",
                            hands, port, seed, seconds))
                .status,
            0)
            << err();
    }

    struct Story {
        std::vector<game::Event> events;
        int caught = 0;
        int handTicks = 0; // ticks in which the right hand was there
    };
    Story story() const {
        Story out;
        const auto recording = tests::valueOf(tests::readRecorded(folder_ / "run.replay"));
        const auto files = tests::valueOf(game::loadDiveFiles("ring", folder_ / "content"));
        const Status same =
            game::replay(recording, files, [&](const game::Snapshot& now, const auto& events) {
                out.events.insert(out.events.end(), events.begin(), events.end());
                out.caught = now.caught;
                out.handTicks += now.hands[1].visible && now.hands[1].joints[0].position.z < -0.3f;
            });
        EXPECT_TRUE(same) << same.error().message();
        return out;
    }
    static bool grabbed(const Story& story) {
        return std::ranges::any_of(story.events, [](const game::Event& event) {
            return event.kind == game::EventKind::Grab && event.hand == 1;
        });
    }
};

// At its own rate that fist opens after 0.9 s, and a fish counts after 1 s.
TEST_F(TrackedHands, TheRecordedFistCatchesAFishPutThere) {
    const Path file = hands::test::sharedRecording("grab");
    if (!fs::exists(file)) GTEST_SKIP() << "needs the reference data: " << file;
    const auto messages = hands::test::readRecordingMessages(file);
    for (const bool slow : {false, true}) {
        const auto said = slow ? slowed(messages, 1.5) : messages;
        const Fist fist = fistIn(said);
        ASSERT_GT(fist.closes_s, 0);
        const uint64_t seed = putFishAt(fist);
        Server server;
        server.say(said);
        play("leap", server.port(), fist.ends_s, seed);
        const Story told = story();
        EXPECT_TRUE(grabbed(told)) << "the fist closes at " << fist.closes_s << " s around " << fist.grasp.x
                                   << " " << fist.grasp.y << " " << fist.grasp.z;
        if (slow) {
            EXPECT_GE(told.caught, 1);
        }
    }
}

TEST_F(TrackedHands, TheSameServiceGivesTheSameGame) {
    const auto messages = hands::test::closingRecording(rig(), 5, 150);
    const uint64_t seed = putFishAt(fistIn(messages));
    std::vector<uint64_t> hashes[2];
    for (auto& run_ : hashes) {
        Server server;
        server.say(messages);
        play("leap", server.port(), 1.4, seed);
        const auto recording = tests::valueOf(tests::readRecorded(folder_ / "run.replay"));
        for (size_t i = 0; i < recording.ticks(); ++i) run_.push_back(recording.hash(i));
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST_F(TrackedHands, TheGamePlaysOnThroughWhateverTheServiceDoes) {
    const auto messages = hands::test::closingRecording(rig(), 6, 300);
    const uint64_t seed = putFishAt(fistIn(messages));
    Server server;
    for (size_t i = 0; i < messages.size(); ++i) {
        server.say(messages[i]);
        if (i == 60) server.drop();
        if (i == 120) server.close(1001); // goes on a version lower
        if (i == 160) server.say("{\"hands\":[{}],\"pointables\":\"none\",\"timestamp\":\"now\"");
        if (i == 170) server.say(std::string(1 << 20, '['));
        if (i == 180) server.sayBinary(std::string("\xff\xfe\x00", 3));
        if (i == 220) server.close(1000);
    }
    play("leap", server.port(), 2.9, seed);
    EXPECT_NE(err().find("Hands: Leap Motion"), std::string::npos) << err();
    EXPECT_EQ(server.paths().size(), 4u);
    const Story told = story();
    EXPECT_TRUE(grabbed(told));
    EXPECT_GE(told.caught, 1) << "gaps shorter than 0.3 s do not open the hand";
    EXPECT_GT(told.handTicks, 300);
}

TEST_F(TrackedHands, WithoutAServiceTheMouseHasTheHands) {
    putFishAt({{0, -0.1f, -0.7f}, 0, 0});
    int port = 0;
    { port = Server().port(); } // nobody listens there now
    play("auto", port, 1.5, 1);
    EXPECT_NE(err().find("Hands: mouse"), std::string::npos) << err();
    EXPECT_GT(story().handTicks, 100);
}

TEST_F(TrackedHands, DevicesListsThem) {
    Server server;
    server.say(hands::test::closingRecording(rig(), 6, 3));
    ASSERT_EQ(run("devices --leap 127.0.0.1:" + std::to_string(server.port())).status, 0);
    EXPECT_NE(out().find("mouse: always"), std::string::npos) << out();
    EXPECT_NE(out().find("leap: ready, protocol 6"), std::string::npos) << out();
}

TEST(HandsNotice, NamesTheDeviceThatAutoHasFoundAndSaysWhenItGoes) {
    std::optional<Server> server(std::in_place);
    app::HandOptions options;
    options.leap.port = static_cast<uint16_t>(server->port());
    app::TrackedHands tracked({app::HandSourceKind::Auto, {}}, options, rig(), true);
    ASSERT_TRUE(server->waitForHeard(2)); // the service is connected
    tracked.frame(0.01);
    ASSERT_TRUE(tracked.notice());
    EXPECT_EQ(tracked.notice()->in(game::Language::English), "Hands: Leap Motion");
    tracked.frame(5); // seconds
    EXPECT_FALSE(tracked.notice()) << "once";
    server.reset();
    const auto hangs = std::chrono::steady_clock::now() + std::chrono::minutes(10);
    while (!tracked.notice() && std::chrono::steady_clock::now() < hangs) tracked.frame(0.01);
    ASSERT_TRUE(tracked.notice());
    EXPECT_EQ(tracked.notice()->in(game::Language::English),
              "Leap Motion is gone: the mouse moves the hands");
}

} // namespace
} // namespace shoal
