// Tests of the client against a real WebSocket server on a loopback port; they wait for frames and messages.
#include "input/hands/HandSourceSelector.h"
#include "input/hands/HandTracker.h"
#include "tests/Test.h"
#include "tests/TestRig.h"
#include "tests/unit/leap_service/Recordings.h"
#include "tests/unit/leap_service/Server.h"
#include "tests/unit/live_server/HttpServer.h"

namespace shoal::hands {
namespace {

using test::Server;
using tests::rig;

using Tracker = std::unique_ptr<HandTracker>;

Tracker connectTo(const Server& server, bool onHeadset = false, int retry_ms = 500) {
    return makeLeapTracker({"127.0.0.1", static_cast<uint16_t>(server.port()),
                            onHeadset ? LeapMount::Head : LeapMount::Desk, retry_ms},
                           rig());
}

// The next frame; fails the test where none comes.
HandFrame next(const Tracker& hands) {
    HandFrame frame;
    EXPECT_TRUE(hands->stream().take(frame, std::chrono::minutes(10)));
    return frame;
}

std::string frameAt(int64_t time_us, int64_t id = 1) {
    auto hand = test::closingHand(rig(), 1).front();
    hand.id = id;
    return test::madeFrame(6, time_us, time_us, {hand});
}

class LeapSession : public testing::Test {
  protected:
    Server server;
    const Tracker hands = connectTo(server);
};

TEST(LeapHands, AsksForTheNewestProtocolAndSendsExactlyTheseBytes) {
    for (const bool onHeadset : {false, true}) {
        std::vector<std::string> expected = {R"({"background":true})", R"({"focused":true})"};
        if (onHeadset) expected.insert(expected.begin() + 1, R"({"optimizeHMD":true})");
        Server server;
        const Tracker hands = connectTo(server, onHeadset);
        ASSERT_TRUE(server.waitForHeard(expected.size()));
        server.say(frameAt(1)); // any further message would have come before this frame
        next(hands);
        EXPECT_THAT(server.paths(), testing::ElementsAre("/v6.json"));
        EXPECT_EQ(server.heard(), expected);
        for (const std::string& message : expected) EXPECT_LE(message.size(), 31u);
    }
}

// A web proxy that is set for the whole session is not used for this machine's own services.
TEST(LeapHands, GoesThroughNoProxy) {
    setenv("http_proxy", "http://127.0.0.1:9", 1);
    Server server;
    const Tracker hands = connectTo(server);
    server.say(frameAt(5));
    EXPECT_EQ(next(hands).time_us, 5);
    unsetenv("http_proxy");
}

TEST(LeapHands, ConnectsToAnAddressInBrackets) {
    const int listening = socket(AF_INET6, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in6 address{.sin6_family = AF_INET6, .sin6_addr = IN6ADDR_LOOPBACK_INIT};
    auto* at = reinterpret_cast<sockaddr*>(&address);
    socklen_t size = sizeof address;
    if (bind(listening, at, size) != 0 || listen(listening, 8) != 0 ||
        getsockname(listening, at, &size) != 0) {
        close(listening);
        GTEST_SKIP() << "needs IPv6: there is no ::1";
    }
    const uint16_t port = ntohs(address.sin6_port);
    const auto hands = makeLeapTracker({"[::1]", port}, rig());
    pollfd waiting{listening, POLLIN, 0};
    EXPECT_EQ(poll(&waiting, 1, 600'000), 1);
    const int client = accept(listening, nullptr, nullptr);
    std::array<char, 4096> request{};
    EXPECT_GT(read(client, request.data(), request.size() - 1), 0);
    EXPECT_THAT(std::string(request.data()),
                testing::AllOf(testing::StartsWith("GET /v6.json "),
                               testing::HasSubstr(" [::1]:" + std::to_string(port) + "\r\n")));
    close(client);
    close(listening);
}

// A program that has the service's port cannot send the client elsewhere.
TEST(LeapHands, FollowsNoRedirect) {
    media::test::HttpServer other, port;
    const std::string url = port.url("");
    const auto hands = makeLeapTracker(
        {"127.0.0.1", static_cast<uint16_t>(std::stoi(url.substr(url.rfind(':') + 1))), LeapMount::Desk},
        rig());
    for (const char* code : {"301", "302", "307", "308"}) {
        ASSERT_TRUE(port.accept()) << "it asks the same port again";
        port.send("HTTP/1.1 " + std::string(code) + " There\r\nLocation: " + other.url("/secret") +
                  "\r\nContent-Length: 0\r\n\r\n");
        EXPECT_TRUE(port.waitForLeave());
        EXPECT_FALSE(other.wasTried()) << code;
    }
}

// Services from before 2014, below 5, send fingertips alone.
TEST(LeapHands, EveryVersionWithJointsGivesAWholeHandWhereItIs) {
    for (int version = 1; version <= 6; ++version) {
        Server server(0, version);
        const Tracker hands = connectTo(server);
        const auto made = test::closingHand(rig(), 1).front();
        server.say(test::madeFrame(version, 1, 1000, {made}));
        const HandFrame frame = next(hands);
        std::vector<std::string> asked; // down to the version that the service speaks
        for (int v = 6; v >= version; --v) asked.push_back("/v" + std::to_string(v) + ".json");
        EXPECT_EQ(server.paths(), asked);
        ASSERT_EQ(frame.hands[1].tracked, version >= 5) << version;
        EXPECT_FALSE(frame.hands[0].tracked) << version;
        if (version < 5) continue;
        EXPECT_TRUE(plausible(frame.hands[1])) << version;
        HandPose truth = made.pose;
        kDeskMount.apply(truth);
        for (int i = 0; i < kJointCount; ++i)
            // All joints are sent at 6; at 5 wrist and metacarpals come from the rig.
            EXPECT_NEAR(glm::distance(frame.hands[1].joints[i].position, truth.joints[i].position), 0,
                        version == 6 ? 1e-5f : 1e-3f)
                << version << " " << kJointNames[i];
    }
}

// The elbow is a direction, because a desk's mount moves hands farther apart than they are.
TEST(LeapHands, TheElbowIsWhereTheServiceSeesItOrNotKnown) {
    for (const bool onHeadset : {false, true}) {
        Server server;
        const Tracker hands = connectTo(server, onHeadset);
        auto made = test::closingHand(rig(), 1).front();
        const glm::vec3 wrist = made.pose.joints[kWristJoint].position, forearm(0.06f, -0.03f, 0.25f);
        made.elbow = wrist + forearm;
        server.say(test::madeFrame(6, 1, 1000, {made}));
        const glm::vec3 expected =
            (onHeadset ? kHeadMount : kDeskMount).viewerFromDevice * glm::normalize(forearm);
        EXPECT_LT(glm::distance(next(hands).towardsElbow[1], expected), 1e-4f); // of 0.25 m: 25 um
        made.elbow = wrist + 4.0f * forearm;                                    // no arm is so long
        server.say(test::madeFrame(6, 2, 2000, {made}));
        EXPECT_EQ(next(hands).towardsElbow[1], glm::vec3(0));
        made.elbow.reset();
        server.say(test::madeFrame(6, 3, 3000, {made}));
        EXPECT_EQ(next(hands).towardsElbow[1], glm::vec3(0));
    }
}

std::string deviceEvent(const std::string& attached) {
    return R"({"event":{"type":"deviceEvent","state":{"attached":)" + attached +
           R"(,"id":"L1","streaming":)" + attached + R"(,"type":"peripheral"}}})";
}

TEST(LeapHands, DeviceEventsAndTheServicesAbsenceAreSaid) {
    uint16_t port = 0;
    {
        Server server;
        port = static_cast<uint16_t>(server.port());
        const Tracker hands = connectTo(server);
        server.say(deviceEvent("true"));
        server.say(frameAt(1));
        next(hands);
        EXPECT_TRUE(hands->stream().state().present);
        EXPECT_THAT(hands->stream().state().description, testing::HasSubstr("peripheral attached"));
        EXPECT_THAT(hands->stream().state().description, testing::HasSubstr("protocol 6"));
        server.say(deviceEvent("false"));
        server.say(frameAt(2));
        next(hands);
        EXPECT_FALSE(hands->stream().state().present) << "no device, no hands";
    }
    EXPECT_FALSE(makeLeapTracker({"127.0.0.1", port}, rig())->stream().state().present);
}

TEST(LeapHands, ComesBackWhenTheServiceRestartsAndLosesNoFrame) {
    int port = 0;
    Tracker hands;
    int64_t time_us = 0;
    std::vector<int64_t> identities;
    for (int life = 0; life < 3; ++life) {
        Server server(port);
        port = server.port();
        if (!hands) hands = connectTo(server);
        for (int i = 0; i < 50; ++i) server.say(frameAt(time_us + i));
        for (int i = 0; i < 50; ++i) {
            const HandFrame frame = next(hands);
            EXPECT_EQ(frame.time_us, time_us + i);
            if (i == 0) identities.push_back(frame.identity[1]);
        }
        time_us += 50;
    }
    EXPECT_NE(identities[0], identities[1]) << "hand 1 of another service need not be the same hand";
}

// The service accepts each client, sends a frame and closes. Within the waiting time, here an hour, each
// tracker connects only once, so that none gets the frame that is meant for the next.
TEST(LeapHands, AServiceThatClosesAtOnceIsNotAskedAgainAtOnce) {
    Server server;
    std::vector<Tracker> all;
    for (int i = 0; i < 5; ++i) {
        all.push_back(connectTo(server, false, 3'600'000));
        server.say(frameAt(i));
        server.close(1000);
        EXPECT_EQ(next(all.back()).time_us, i);
        ASSERT_TRUE(server.waitUntilSent()) << "or it would close the next one instead";
    }
    EXPECT_EQ(server.paths().size(), all.size());
}

TEST(LeapHands, CutConnectionsAndOrderlyEndsAreFollowedByNewOnes) {
    Server server;
    const Tracker hands = connectTo(server, false, 1);
    for (int round = 0; round < 1000; ++round) {
        server.say(frameAt(round));
        ASSERT_EQ(next(hands).time_us, round);
        if (round % 2)
            server.close(1000);
        else
            server.drop();
        ASSERT_TRUE(server.waitForPaths(static_cast<size_t>(round) + 2));
    }
}

// Returns two flat hands, fingers ahead and palms towards each other, with their palm joints apart_m apart;
// device's frame, the middle between them where a player's hands meet.
std::vector<test::MadeHand> facingHands(float apart_m) {
    std::vector<test::MadeHand> hands;
    for (const Side side : {Side::Left, Side::Right}) {
        const float outwards = side == Side::Left ? -1.0f : 1.0f;
        // The back of the hand, +Y, is turned outwards.
        const glm::quat roll = glm::angleAxis(-outwards * std::numbers::pi_v<float> / 2, glm::vec3(0, 0, 1));
        test::MadeHand made{side, side == Side::Left ? 1 : 2, rig().pose(side, {}, {{}, roll})};
        const glm::vec3 by =
            glm::vec3(0.05f + outwards * apart_m / 2, 0.25f, 0.1f) - made.pose.joints[kPalmJoint].position;
        for (Joint& joint : made.pose.joints) joint.position += by;
        hands.push_back(made);
    }
    return hands;
}

// Hands that touch before the tracker touch in the game: near each other, the vectors between their joints
// are as the device sees them. Far apart the desk's reach scales their distance, and between it only grows.
TEST_F(LeapSession, ClappingPalmsMeet) {
    constexpr int kFrames = 140;
    std::vector<float> palms_m;
    for (int i = 0; i < kFrames; ++i) {
        const float apart_m = 0.036f + 0.005f * static_cast<float>(i); // from skin on skin to 0.73 m
        const auto made = facingHands(apart_m);
        server.say(test::madeFrame(6, i, i * 10000, made));
        const HandFrame frame = next(hands);
        ASSERT_TRUE(frame.hands[0].tracked && frame.hands[1].tracked) << i;
        const auto between = [](const HandPose& a, const HandPose& b, size_t joint) {
            return b.joints[joint].position - a.joints[joint].position;
        };
        palms_m.push_back(glm::length(between(frame.hands[0], frame.hands[1], kPalmJoint)));
        const glm::vec3 middle =
            (frame.hands[0].joints[kPalmJoint].position + frame.hands[1].joints[kPalmJoint].position) / 2.0f;
        EXPECT_LT(glm::distance(middle, kDeskMount.place({0.05f, 0.25f, 0.1f})), 1e-5f);
        if (apart_m > 2 * 0.137f) continue; // fingertip to fingertip: 0.131 m from the palm, and its flesh
        for (size_t j = 0; j < kJointCount; ++j)
            EXPECT_LT(glm::distance(between(frame.hands[0], frame.hands[1], j),
                                    between(made[0].pose, made[1].pose, j)),
                      1e-5f)
                << apart_m;
    }
    EXPECT_NEAR(palms_m.back(), kReach * (0.036f + 0.005f * (kFrames - 1)), 1e-4f);
    for (size_t i = 1; i < palms_m.size(); ++i) EXPECT_GT(palms_m[i], palms_m[i - 1]) << i;
}

TEST_F(LeapSession, ASecondHandThatComesOrGoesLetsTheFirstNotLeap) {
    const auto both = facingHands(0.1f);
    glm::vec3 before(0), alone(0);
    for (int i = 0; i < 150; ++i) {
        const bool second = i >= 50 && i < 100;
        server.say(test::madeFrame(6, i, i * 10000, second ? both : std::vector{both[1]}));
        const glm::vec3 palm = next(hands).hands[1].joints[kPalmJoint].position;
        if (i == 0) alone = before = palm;
        // 0.3 of the 0.1 m between them, within kEase_s.
        EXPECT_LT(glm::distance(palm, before), 1.01f * 0.03f * 0.01f / HandPlacement::kEase_s) << i;
        if (i == 99) {
            EXPECT_NEAR(glm::distance(palm, alone), 0.03f, 1e-5f);
        }
        before = palm;
    }
    EXPECT_LT(glm::distance(before, alone), 1e-6f);
}

std::string changed(const std::string& message, bool otherLabel, bool otherNormal) {
    auto frame = nlohmann::json::parse(message);
    for (auto& hand : frame["hands"]) {
        if (otherLabel) hand["type"] = hand["type"] == "left" ? "right" : "left";
        if (otherNormal)
            for (auto& v : hand["palmNormal"]) v = -v.get<double>();
    }
    return frame.dump();
}

// The joints correct a service that takes the right hand for the left, or the palm for the back.
TEST_F(LeapSession, AWrongLabelOrNormalIsCorrectedByTheJoints) {
    int64_t id = 0;
    for (const Side side : {Side::Left, Side::Right})
        for (const float curl : {0.0f, 0.3f, 0.6f, 0.9f})
            for (const int wrong : {1, 2, 3}) {          // label, normal, both
                if (wrong == 3 && curl < 0.3f) continue; // a flat hand looks like the other hand's back
                const glm::quat turn = glm::normalize(glm::quat(0.8f, 0.3f, -0.4f, 0.2f));
                const test::MadeHand made{side, ++id,
                                          rig().pose(side, tests::shape(curl), {{0.05f, 0.2f, 0.1f}, turn})};
                server.say(test::madeFrame(6, id, id * 500'000, {made}));
                server.say(changed(test::madeFrame(6, id, id * 500'000, {made}), wrong & 1, wrong & 2));
                const HandFrame right = next(hands), seen = next(hands);
                const size_t i = side == Side::Left ? 0 : 1;
                ASSERT_TRUE(right.hands[i].tracked && seen.hands[i].tracked) << curl << " " << wrong;
                EXPECT_FALSE(right.hands[1 - i].tracked || seen.hands[1 - i].tracked);
                for (size_t j = 0; j < kJointCount; ++j) {
                    EXPECT_LT(
                        glm::distance(right.hands[i].joints[j].position, seen.hands[i].joints[j].position),
                        1e-5f);
                    EXPECT_GT(std::fabs(glm::dot(right.hands[i].joints[j].orientation,
                                                 seen.hands[i].joints[j].orientation)),
                              0.9999f)
                        << kJointNames[j] << " " << curl << " " << wrong;
                }
            }
}

// Straight fingers do not show whether the label or the normal is wrong: such a hand is not shown.
TEST_F(LeapSession, AHandThatCannotBeMendedIsDropped) {
    test::MadeHand made{Side::Right, 1, rig().pose(Side::Right, {}, {{0.05f, 0.2f, 0.1f}, {1, 0, 0, 0}})};
    for (size_t f = 1; f < kFingerCount; ++f)
        for (int j = kFingerJoints[f].proximal + 1; j <= kFingerJoints[f].tip; ++j) {
            const auto at = static_cast<size_t>(j);
            made.pose.joints[at].position = made.pose.joints[at - 1].position + glm::vec3(0, 0, -0.03f);
        }
    const std::string frame = test::madeFrame(6, 1, 1, {made});
    for (const int wrong : {0, 1, 2}) {
        server.say(changed(frame, wrong & 1, wrong & 2));
        const HandFrame seen = next(hands);
        EXPECT_EQ(seen.hands[1].tracked, wrong == 0);
        EXPECT_FALSE(seen.hands[0].tracked);
    }
}

// Services on slow machines give 5 frames a second, fast ones 200: a hand that moves is solid, and moves from
// tick to tick as it does in between frames.
TEST(LeapHands, AMovingHandIsSolidAndSteadyAtAnyRate) {
    constexpr float kTick_s = 1.0f / 120, kSpeed_mps = 0.3f;
    for (const int rate_Hz : {5, 7, 9, 15, 30, 37, 60, 110, 200}) {
        Server server;
        const Tracker tracker = connectTo(server);
        const int64_t interval_us = 1'000'000 / rate_Hz;
        for (int i = 0; i < 3 * rate_Hz; ++i) {
            const float x = -0.4f + kSpeed_mps * static_cast<float>(i) / static_cast<float>(rate_Hz);
            server.say(test::madeFrame(
                6, i, i * interval_us,
                {{Side::Right, 1, rig().pose(Side::Right, {}, {{x, 0.2f, 0.1f}, {1, 0, 0, 0}})}}));
        }
        DeviceHands device(DeviceTime::Stamps);
        HandSourceSelector selector;
        std::array<HandPose, 2> hands{};
        float before = 0;
        for (int frame = 0; frame < 150; ++frame) { // 2.5 s
            device.advance(tracker->stream(), 1.0 / 60, {});
            for (int left = 2; left > 0; --left) {
                selector.tick(device, hands, static_cast<float>(left - 1) * kTick_s, kTick_s);
                const float x = hands[1].joints[kPalmJoint].position.x;
                const float shown_mps = (x - before) / kTick_s;
                before = x;
                if (frame < 48) continue; // it appears, and the filter takes up its speed
                ASSERT_TRUE(hands[1].tracked && hands[1].solid) << rate_Hz << " Hz, frame " << frame;
                // Samples of the display and the device do not fall together: a display's frame may bring one
                // more of the device's than the mean, or one of the device's begin a display's frame late.
                EXPECT_GT(shown_mps, 0.4f * kReach * kSpeed_mps) << rate_Hz << " Hz, frame " << frame;
                EXPECT_LT(shown_mps, 2.1f * kReach * kSpeed_mps) << rate_Hz << " Hz, frame " << frame;
            }
        }
    }
}

TEST_F(LeapSession, RubbishIsPassedOver) {
    const auto rubbish = [&](std::string text) { server.say(std::move(text)); };
    rubbish("");
    rubbish("{");
    rubbish("null");
    rubbish("[1,2,3]");
    rubbish("{\"hands\":7,\"pointables\":{}}");
    next(hands); // a frame, though one without hands
    rubbish(std::string(200, '['));
    rubbish("{\"hands\":[" + std::string(300 * 1024, ' ') + "]}"); // too large: never kept
    rubbish(std::string(3 << 20, 'x'));
    server.sayBinary(std::string("\x00\xff\xfe\x80", 4));
    server.say(frameAt(42));
    EXPECT_EQ(next(hands).time_us, 42);
    EXPECT_EQ(server.paths().size(), 1u) << "one connection bore all of it";
}

TEST_F(LeapSession, AbsurdHandsAreNotHands) {
    for (const char* palm :
         {"[1e300,0,0]", "[null,0,0]", "[\"1\",0,0]", "[0,0]", "[1e9,0,0]", "[[],[],[]]"}) {
        server.say(std::string("{\"timestamp\":1,\"hands\":[{\"id\":1,\"type\":\"right\",\"palmPosition\":") +
                   palm + ",\"palmNormal\":[0,-1,0],\"direction\":[0,0,-1]}],\"pointables\":[]}");
        const HandFrame frame = next(hands);
        EXPECT_FALSE(frame.hands[0].tracked || frame.hands[1].tracked) << palm;
    }
    // A torn hand has a place, but no hand looks like it: the filter refuses what is not plausible.
    std::string torn = "{\"timestamp\":1,\"hands\":[{\"id\":1,\"type\":\"right\",\"palmPosition\":[0,200,0],"
                       "\"palmNormal\":[0,-1,0],\"direction\":[0,0,-1]}],\"pointables\":[";
    for (int finger = 0; finger < kFingerCount; ++finger)
        torn += (finger ? ",{\"handId\":1,\"type\":" : "{\"handId\":1,\"type\":") + std::to_string(finger) +
                ",\"mcpPosition\":[900,200,0],\"pipPosition\":[0,200,-900],\"dipPosition\":[0,0,0],"
                "\"tipPosition\":[900,900,900]}";
    server.say(torn + "]}");
    const HandPose seen = next(hands).hands[1];
    EXPECT_TRUE(seen.tracked);
    EXPECT_FALSE(plausible(seen));
}

} // namespace
} // namespace shoal::hands
