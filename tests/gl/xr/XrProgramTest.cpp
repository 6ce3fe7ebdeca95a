// `shoal --xr` from its start to its exit status, in a headset that does what the test says.
#include "tests/gl/xr/XrProgram.h"
#include "engine/xr/Headset.h"
#include "game/app/Application.h"
#include "tests/gl/xr/WindowEvents.h"

namespace shoal::app {
namespace {

// Time between frames for scripts of many seconds.
constexpr double kSlow_s = 1.0 / 30;

// The pause from frame 30 lasts until a hand has been closed for 0.4 s, from frame 60; four ticks a frame.
TEST_F(XrProgram, LosingFocusPausesUntilAHandCloses) {
    fake.period_s = kSlow_s;
    closeHand(0, 0);
    closeHand(1, 0);
    fake.onWait = [this](FakeRuntime& f) {
        if (f.framesWaited == 30) f.say(XR_SESSION_STATE_VISIBLE);
        if (f.framesWaited == 50) f.say(XR_SESSION_STATE_FOCUSED);
        if (f.framesWaited == 60) closeHand(1, 1);
    };
    const std::vector<int> lengths = pausesWithin(90);
    ASSERT_EQ(lengths.size(), 4u);  // until it is worn, play, pause, play
    EXPECT_NEAR(lengths[0], 36, 8); // worn and steady for 0.3 s, to two frames
    EXPECT_NEAR(lengths[0] + lengths[1], 30 * 4, 6);
    EXPECT_NEAR(lengths[2], (60 - 30) * 4 + 48, 8);
    EXPECT_GT(lengths.back(), 50);
}

TEST_F(XrProgram, HeadAndHandsAreRecordedAndReplay) {
    // The player stands elsewhere, turned, then leans to the right by 0.2 m and looks up; turns, and strikes
    // the key by which the mouse's player looks ahead again.
    const glm::vec3 at(1, 0.4f, 2), leanView(0.2f, 0, 0), up(0, 1, 0), right(1, 0, 0);
    const auto put = [=, this](glm::vec3 lean, float pitch, float turn = 0) {
        placeHead(at + glm::angleAxis(0.9f, up) * lean,
                  glm::angleAxis(0.9f + turn, up) * glm::angleAxis(pitch, right));
    };
    put({}, 0);
    fake.onWait = [=](FakeRuntime& f) {
        if (f.framesWaited == 100) put(leanView, 0.5f);
        if (f.framesWaited == 125) put(leanView, 0.5f, 0.8f);
        if (f.framesWaited == 130) test::strikeKey("Home");
    };
    fake.controllers[1] = {true, {{0, 0, 0, 1}, {at.x, at.y - 0.2f, at.z - 0.4f}}, 0.3f, 0, false};
    const tests::Recorded recording = recorded(options(), 160);
    const game::TickInput before = inputAt(recording, 110), leans = inputAt(recording, 120 * 4 / 3),
                          last = inputAt(recording, recording.ticks() - 9);
    constexpr float kTol = 1e-5f; // floats of some metres, turned thrice
    EXPECT_LT(glm::length(before.headWorld), kTol);
    EXPECT_NEAR(std::abs(before.worldFromView.w), 1, kTol);
    EXPECT_LT(glm::distance(leans.headWorld, leanView), kTol);
    EXPECT_LT(glm::length(last.headWorld), kTol);
    for (const game::TickInput& input : {leans, last}) {
        const glm::vec3 ahead = input.worldFromView * glm::vec3(0, 0, -1);
        EXPECT_LT(glm::distance(ahead, glm::vec3(0, std::sin(0.5f), -std::cos(0.5f))), kTol);
    }
    EXPECT_TRUE(last.hands[1].tracked);
    EXPECT_FALSE(last.hands[0].tracked);

    expectReplays(recording);
}

// The setting "auto" goes by the head above the floor: in the first dive, and in the second, chosen from the
// title screen. A player who sits down or stands up as the title comes keeps both recordings.
TEST_F(XrProgram, APlayerWhoSitsDivesSeated) {
    withoutValidation();
    fake.extensions.insert(XR_EXT_LOCAL_FLOOR_EXTENSION_NAME);
    const auto place = [&](float eyes_m) {
        fake.referenceSpaces[XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT] = {{0, 0, 0, 1}, {0, -eyes_m, 0}};
    };
    for (const auto& [firstEyes_m, thenEyes_m] : {std::pair{1.2f, 1.6f}, {1.6f, 1.2f}}) {
        const std::string name = firstEyes_m < thenEyes_m ? "stands_up" : "sits_down";
        fake.framesWaited = 0;
        place(firstEyes_m);
        PlayOptions o = options();
        o.firstSteps = false;
        o.record = folder_ / (name + ".replay");
        Application application(o);
        ASSERT_TRUE(application.open());
        const Menu& menu = application.screens().menu();
        fake.onWait = [&](FakeRuntime& f) {
            if (f.framesWaited == 60) test::strikeKey("Escape");
            if (f.framesWaited == 130) f.sayExit();
            if (application.screens().isOpen() && application.screens().top() == Screen::Title)
                place(thenEyes_m);
            if (f.framesWaited <= 64 || f.framesWaited % 3 != 0 || !application.screens().isOpen()) return;
            const bool there = application.screens().top() != Screen::Paused ||
                               menu.page().items[menu.focus()].label == "Title screen";
            test::strikeKey(there ? "Return" : "Down");
        };
        EXPECT_TRUE(application.run(true));
        for (const auto& [number, eyes_m] : {std::pair("", firstEyes_m), std::pair("-2", thenEyes_m)}) {
            const auto recording = tests::readRecorded(folder_ / (name + number + ".replay"));
            ASSERT_TRUE(recording) << name << number << ": " << recording.error().message();
            EXPECT_EQ(recording->header().settings.at("seated"), eyes_m < 1.4f ? "on" : "off")
                << name << number;
            expectReplays(*recording);
        }
    }
    fake.framesWaited = 0;
    fake.onWait = {};
    PlayOptions o = options();
    o.posture = Posture::Seated;
    const tests::Recorded recording = recorded(o, 60);
    EXPECT_EQ(recording.header().settings.at("seated"), "on");
    expectReplays(recording);
}

// The headset reports poses 72 times a second, the game asks for them 120 times. A steady motion must stay
// steady, so that hands do not seem to stop and leap.
TEST_F(XrProgram, RunsSteadilyAtTheHeadsetsRateAndLeavesWhenItIsAsked) {
    fake.period_s = 1.0 / 72;
    closeHand(1, 0);
    fake.onWait = [this](FakeRuntime& f) {
        for (XrView& view : f.views) view.pose.position.x += 0.01f;
        for (auto& joint : f.hands[1].joints) joint.pose.position.y += 0.001f;
    };
    const tests::Recorded recording = recorded(options(), 120);
    EXPECT_GT(fake.framesWithEyes, 110u);
    EXPECT_EQ(fake.framesEnded, fake.framesWaited);
    // Ticks from the first frame's time to the last one's, when it was told to leave.
    EXPECT_EQ(recording.ticks(), 120u * 120 / 72);
    EXPECT_FALSE(fake.running);
    for (size_t tick = 60; tick < recording.ticks() - 10; ++tick) {
        const game::TickInput a = inputAt(recording, tick), b = inputAt(recording, tick + 1);
        // Floats below 2.
        EXPECT_NEAR(b.headWorld.x - a.headWorld.x, 0.01f * 72 / 120, 2e-6f) << tick;
        const float handA = a.hands[1].joints[9].position.y, handB = b.hands[1].joints[9].position.y;
        EXPECT_NEAR(handB - handA, 0.001f * 72 / 120, 2e-6f) << tick;
    }
}

TEST_F(XrProgram, TouchesAreFeltInTheController) {
    fake.period_s = kSlow_s;
    PlayOptions o = options();
    o.hands.source = firstCatch_;
    const Outcome outcome = run(o, 4000);
    EXPECT_EQ(outcome.status, 0) << outcome.said;
    int felt = 0;
    float strongest = 0;
    for (const test::FeltPulse& pulse : fake.pulses) {
        felt += pulse.amplitude > 0;
        strongest = std::max(strongest, pulse.amplitude);
    }
    EXPECT_GT(felt, 10);        // a fish that is held purrs
    EXPECT_GT(strongest, 0.7f); // and a catch is a blow
    ASSERT_FALSE(fake.pulses.empty());
    EXPECT_EQ(fake.pulses.back().amplitude, 0); // at the end nothing runs on
}

TEST_F(XrProgram, TextHangsInTheWorldOneAndAHalfMetresAhead) {
    fake.keepPictures = true;
    std::vector<test::ShownFrame> seen;
    fake.onWait = [&](FakeRuntime& f) {
        if (f.framesWaited == 100) seen.push_back(f.last);
        if (f.framesWaited >= 100) // looks to the side and back
            placeHead({}, glm::angleAxis(0.4f * std::sin(static_cast<float>(f.framesWaited - 100) * 0.05f),
                                         glm::vec3(0, 1, 0)));
        if (f.framesWaited == 130) seen.push_back(f.last);
    };
    EXPECT_EQ(run(options(), 140).status, 0);
    ASSERT_EQ(seen.size(), 2u);
    ASSERT_TRUE(seen[0].panel && seen[1].panel);
    const XrVector3f a = seen[0].panel->localFromPanel.position, b = seen[1].panel->localFromPanel.position;
    EXPECT_NEAR(std::hypot(a.x, a.z), 1.5f, 1e-5f);
    // It keeps its place though the head has turned; the middle between the eyes does not move.
    EXPECT_NEAR(a.x, b.x, 1e-4f);
    EXPECT_NEAR(a.z, b.z, 1e-4f);
    // Something is written, most is clear.
    const auto& rgba = seen[0].panel->rgba;
    size_t clear = 0, solid = 0;
    for (size_t i = 3; i < rgba.size(); i += 4) {
        clear += rgba[i] == 0;
        solid += rgba[i] > 200;
    }
    EXPECT_GT(clear, rgba.size() / 4 * 8 / 10);
    EXPECT_GT(solid, 300u);
}

// Every page stands on the panel; a poke at an item, as the head sees the fingertip before it, chooses it,
// and so does a controller's trigger.
TEST_F(XrProgram, ThePagesStandOnThePanelAndAPokeChooses) {
    PlayOptions o = options();
    o.start = Start::Auto;
    Application application(o);
    ASSERT_TRUE(tests::succeeded(application.open()));
    const Menu& menu = application.screens().menu();
    // Place of a fingertip before the item, in LOCAL; forward: towards the panel, metres.
    const auto before = [&](const std::string& label, float forward_m) {
        const auto item = std::ranges::find(menu.page().items, label, &MenuItem::label);
        EXPECT_NE(item, menu.page().items.end()) << label << " is not on the page " << menu.page().title;
        const auto area = menu.areaOf(static_cast<size_t>(item - menu.page().items.begin()));
        if (!area || !fake.last.panel) return glm::vec3(0, 0, -0.4f);
        const glm::vec2 share = (area->low + area->high) / 2.0f / glm::vec2(960, 640);
        const auto& [q, p] = fake.last.panel->localFromPanel;
        const auto& [width, height] = fake.last.panel->size;
        const glm::vec3 at =
            test::vectorOf(p) +
            glm::quat(q.w, q.x, q.y, q.z) * glm::vec3((share.x - 0.5f) * width, (0.5f - share.y) * height, 0);
        const glm::vec3 head =
            (test::vectorOf(fake.views[0].pose.position) + test::vectorOf(fake.views[1].pose.position)) /
            2.0f;
        return head + glm::normalize(at - head) * (0.45f + forward_m);
    };
    const auto putFinger = [&](glm::vec3 tip) {
        closeHand(1, 0);
        const XrVector3f now = fake.hands[1].joints[XR_HAND_JOINT_INDEX_TIP_EXT].pose.position;
        for (auto& joint : fake.hands[1].joints) {
            joint.pose.position.x += tip.x - now.x;
            joint.pose.position.y += tip.y - now.y;
            joint.pose.position.z += tip.z - now.z;
        }
    };
    const std::vector<std::string> pokes = {"Settings",    "Comfort", "Back",        "Back",
                                            "How to play", "Back",    "Field guide", "Back"};
    const std::vector<Screen> pages = {Screen::Settings, Screen::SettingsGroup, Screen::Settings,
                                       Screen::Title,    Screen::HowToPlay,     Screen::Title,
                                       Screen::Guide,    Screen::Title};
    constexpr uint64_t kBegin = 60, kEach = 40;
    fake.onWait = [&](FakeRuntime& f) {
        if (f.framesWaited < kBegin) return;
        const size_t poke = (f.framesWaited - kBegin) / kEach;
        const uint64_t frame = (f.framesWaited - kBegin) % kEach;
        if (frame == 0 && poke > 0 && poke <= pages.size()) {
            EXPECT_EQ(application.screens().top(), pages[poke - 1]) << pokes[poke - 1];
        }
        if (poke < pokes.size()) {
            // Comes, rests, pokes by 5 cm in four frames and goes.
            if (frame < 10)
                f.hands[1].active = false;
            else if (frame == 10)
                putFinger(before(pokes[poke], 0));
            else if (frame > 20 && frame <= 24)
                for (auto& joint : f.hands[1].joints) joint.pose.position.z -= 0.0125f;
            else if (frame == 30)
                f.hands[1].active = false;
        } else if (poke == pokes.size()) {
            if (frame < 10) return;
            if (frame == 10) {
                const glm::vec3 palm = before("Quit", 0);
                f.controllers[1] = {true, {{0, 0, 0, 1}, {palm.x, palm.y, palm.z}}, 0, 0, false};
            }
            f.controllers[1].trigger = frame > 20 ? 1.0f : 0.0f;
        } else if (frame == 0) {
            ADD_FAILURE() << "the trigger chose nothing";
            f.sayExit();
        }
    };
    EXPECT_TRUE(tests::succeeded(application.run(true)));
    EXPECT_TRUE(application.leaving());
}

TEST_F(XrProgram, LostTrackingFadesThePictureAndComesBack) {
    fake.keepPictures = true;
    double before = 0, half = 0, lost = -1, after = 0;
    fake.onWait = [&](FakeRuntime& f) {
        if (f.framesWaited == 120) before = brightness(f), f.viewFlags = 0;
        if (f.framesWaited == 132) half = brightness(f); // after 0.12 of 0.25 s
        if (f.framesWaited == 180) lost = brightness(f), f.viewFlags = 0xf;
        if (f.framesWaited == 240) after = brightness(f);
    };
    EXPECT_EQ(run(options(), 250).status, 0);
    EXPECT_GT(before, 40);
    EXPECT_LT(half, 0.75 * before);
    EXPECT_GT(half, 0.3 * before);
    EXPECT_EQ(lost, 0);
    EXPECT_NEAR(after, before, 0.2 * before); // the video went on
}

// The room is chosen by option, then by key, and kept.
TEST_F(XrProgram, TheRoomTakesThePlaceOfTheFilmAndComesAndGoes) {
    fake.keepPictures = true;
    fake.blendModes = {XR_ENVIRONMENT_BLEND_MODE_OPAQUE, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND};
    std::vector<test::ShownFrame> seen;
    fake.onWait = [&](FakeRuntime& f) {
        if (f.framesWaited == 100 || f.framesWaited == 120 || f.framesWaited == 140) {
            seen.push_back(f.last);
            if (f.framesWaited < 140) test::strikeKey("F2");
        }
        if (f.framesWaited == 160) f.viewFlags = 0; // no pose: what is drawn fades, and the room stays
        if (f.framesWaited == 200) seen.push_back(f.last);
    };
    withoutValidation();
    fake.extensions.insert(XR_EXT_LOCAL_FLOOR_EXTENSION_NAME);
    fake.referenceSpaces[XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT] = {{0, 0, 0, 1}, {0, -1.6f, 0}};
    PlayOptions o = options();
    o.passthrough = true;
    o.record = folder_ / "room.replay";
    const Outcome outcome = run(o, 210);
    EXPECT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_EQ(outcome.said, "");
    ASSERT_EQ(seen.size(), 4u);
    const auto clearShare = [](const test::ShownFrame& frame) {
        const auto& rgba = frame.eyes.value()[0].rgba;
        size_t clear = 0;
        for (size_t i = 0; i < rgba.size(); i += 4)
            clear += rgba[i] == 0 && rgba[i + 1] == 0 && rgba[i + 2] == 0 && rgba[i + 3] == 0;
        return static_cast<double>(clear) / static_cast<double>(rgba.size() / 4);
    };
    for (const size_t room : {0u, 2u}) {
        EXPECT_EQ(seen[room].blend, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);
        EXPECT_GT(clearShare(seen[room]), 0.5);
        EXPECT_LT(clearShare(seen[room]), 1); // animals
    }
    EXPECT_EQ(seen[1].blend, XR_ENVIRONMENT_BLEND_MODE_OPAQUE);
    EXPECT_EQ(clearShare(seen[1]), 0);
    EXPECT_FALSE(seen[3].eyes);
    EXPECT_EQ(seen[3].blend, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);
    PlayOptions kept;
    loadSettings(settingsOf(kept));
    EXPECT_TRUE(kept.passthrough);
    const tests::Recorded recording = tests::valueOf(tests::readRecorded(o.record));
    EXPECT_EQ(recording.header().settings.at("room_floor_cm"), "160");
    expectReplays(recording);
}
TEST_F(XrProgram, TheFilmStaysWhereTheRuntimeShowsNoRoom) {
    fake.keepPictures = true;
    fake.onWait = [](FakeRuntime& f) {
        if (f.framesWaited == 60) test::strikeKey("F2");
        if (f.framesWaited != 75) return;
        EXPECT_EQ(f.last.blend, XR_ENVIRONMENT_BLEND_MODE_OPAQUE);
        EXPECT_GT(brightness(f), 40);
    };
    PlayOptions o = options();
    o.passthrough = true;
    const Outcome outcome = run(o, 80);
    EXPECT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_EQ(std::count(outcome.said.begin(), outcome.said.end(), '\n'), 2) << outcome.said; // asked twice
    EXPECT_NE(outcome.said.find("cannot show your own room"), std::string::npos) << outcome.said;
    PlayOptions kept;
    loadSettings(settingsOf(kept));
    EXPECT_FALSE(kept.passthrough);
}

// Failures that a player may meet before the first picture.
TEST_F(XrProgram, WithoutAHeadsetItSaysWhatToDo) {
    fake.present = false;
    expectOneMessage(run(options()), "plug it in");
}
TEST_F(XrProgram, WithoutARuntimeItSaysWhatToDo) {
    setenv("XR_RUNTIME_JSON", "/nowhere/runtime.json", 1);
    expectOneMessage(run(options()), "XR_RUNTIME_JSON");
}
TEST_F(XrProgram, WithoutOpenGlItSaysSo) {
    fake.extensions = {XR_EXT_HAND_TRACKING_EXTENSION_NAME};
    expectOneMessage(run(options()), "OpenGL");
    // With an instance the loader lets go of the runtime, and of the extensions that it has noted.
    EXPECT_TRUE(xr::activeRuntime());
}
TEST_F(XrProgram, ADriverTooOldIsNamed) {
    fake.minOpenGl = XR_MAKE_VERSION(9, 1, 0);
    expectOneMessage(run(options()), "9.1");
}
TEST_F(XrProgram, OpenXrHandsNeedAHeadset) {
    PlayOptions o = options();
    o.xr = false;
    o.hands.source = "openxr";
    expectOneMessage(run(o), "--xr");
}

TEST_F(XrProgram, ARuntimeWhoseServiceDoesNotRunSaysToStartIt) {
    for (const XrResult result : {XR_ERROR_RUNTIME_UNAVAILABLE, XR_ERROR_RUNTIME_FAILURE}) {
        withoutValidation(); // which stumbles over an instance that could not be made
        fake.failing["xrCreateInstance"] = result;
        expectOneMessage(run(options()), "start its service");
    }
}

// The dive goes on, nothing fades, and the panel says so.
TEST_F(XrProgram, ALostPositionIsSaidAndTheDiveGoesOn) {
    const auto written = [](const FakeRuntime& f) {
        size_t solid = 0;
        if (f.last.panel)
            for (size_t i = 3; i < f.last.panel->rgba.size(); i += 4) solid += f.last.panel->rgba[i] > 200;
        return solid;
    };
    fake.period_s = kSlow_s;
    size_t before = 0, lost = 0, after = 0;
    double light = 0, lightLost = 0;
    fake.onWait = [&](FakeRuntime& f) {
        f.keepPictures = f.framesWaited >= 299; // the goals have gone from the panel
        if (f.framesWaited == 300)
            before = written(f), light = brightness(f),
            f.viewFlags = 0xf & ~XR_VIEW_STATE_POSITION_TRACKED_BIT;
        if (f.framesWaited == 310) lost = written(f), lightLost = brightness(f), f.viewFlags = 0xf;
        if (f.framesWaited == 314) after = written(f);
    };
    EXPECT_EQ(pausesWithin(320).size(), 2u);
    EXPECT_GT(lost, before + 400) << "a line of text";
    EXPECT_LT(after, before + 400);
    EXPECT_NEAR(lightLost, light, 0.2 * light);
}

TEST_F(XrProgram, FramesThatTheRuntimeDiscardsDoNotMatter) {
    fake.shouldRender = false; // runs, and nobody looks
    EXPECT_EQ(run(options(), 100).status, 0);
    EXPECT_EQ(fake.framesWithEyes, 0u);
    EXPECT_EQ(fake.framesEnded, fake.framesWaited);
}

// Whichever call fails, one sentence names it.
class XrCall : public XrProgram, public testing::WithParamInterface<const char*> {};

TEST_P(XrCall, AFailedCallIsNamedInOneSentence) {
    const std::string name = GetParam();
    fake.controllers[0].active = fake.hands[1].active = true;
    fake.failing[name] = XR_ERROR_RUNTIME_FAILURE;
    PlayOptions o = options();
    if (name == "xrCreateInstance") withoutValidation(); // which stumbles over one that could not be made
    const bool haptic = name.ends_with("HapticFeedback");
    if (haptic) {
        fake.period_s = kSlow_s;
        o.hands.source = firstCatch_;
    }
    if (name == "xrStopHapticFeedback") // taken off while something is felt
        fake.onWait = [](FakeRuntime& f) {
            if (!f.pulses.empty() && f.state == XR_SESSION_STATE_FOCUSED) f.say(XR_SESSION_STATE_VISIBLE);
        };
    expectOneMessage(run(o, haptic ? 4000 : 60), name + " says XR_ERROR_RUNTIME_FAILURE");
}

INSTANTIATE_TEST_SUITE_P(
    Every, XrCall,
    testing::Values("xrCreateInstance", "xrGetInstanceProperties", "xrGetSystem", "xrGetSystemProperties",
                    "xrEnumerateViewConfigurationViews", "xrEnumerateEnvironmentBlendModes",
                    "xrGetOpenGLGraphicsRequirementsKHR", "xrCreateSession", "xrEnumerateReferenceSpaces",
                    "xrCreateReferenceSpace", "xrCreateHandTrackerEXT", "xrStringToPath", "xrCreateActionSet",
                    "xrCreateAction", "xrSuggestInteractionProfileBindings", "xrCreateActionSpace",
                    "xrAttachSessionActionSets", "xrEnumerateSwapchainFormats", "xrCreateSwapchain",
                    "xrEnumerateSwapchainImages", "xrPollEvent", "xrBeginSession", "xrWaitFrame",
                    "xrLocateViews", "xrLocateHandJointsEXT", "xrSyncActions", "xrGetActionStatePose",
                    "xrGetActionStateFloat", "xrGetActionStateBoolean", "xrLocateSpace", "xrBeginFrame",
                    "xrAcquireSwapchainImage", "xrWaitSwapchainImage", "xrReleaseSwapchainImage",
                    "xrEndFrame", "xrEndSession", "xrApplyHapticFeedback", "xrStopHapticFeedback"),
    [](const auto& parameter) { return std::string(parameter.param); });

// All tests of this class demand that the validation layer reports nothing. This one uses all features in one
// dive, and shows that the layer is active.
TEST_F(XrProgram, CoreValidationHasNothingToComplainOf) {
    if (!validated_) GTEST_SKIP() << "needs openxr-layer-corevalidation";
    fake.extensions.insert(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
    fake.extensions.insert(XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME);
    fake.formats.push_back(GL_DEPTH_COMPONENT24);
    fake.blendModes.push_back(XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);
    fake.controllers[0] = {true, {{0, 0, 0, 1}, {-0.2f, -0.2f, -0.4f}}, 0.5f, 0.5f, false};
    closeHand(1, 0);
    fake.onWait = [](FakeRuntime& f) {
        if (f.framesWaited == 40) f.sayRecentred();
        if (f.framesWaited == 60 || f.framesWaited == 80) test::strikeKey("F2"); // the room and back
        if (f.framesWaited == 70 && f.last.eyes) {
            EXPECT_EQ(f.last.blend, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);
            EXPECT_TRUE((*f.last.eyes)[0].depth);
        }
    };
    PlayOptions o = options();
    fake.period_s = kSlow_s;
    o.hands.source = firstCatch_;
    const Outcome outcome = run(o, 4000);
    EXPECT_EQ(outcome.status, 0) << outcome.said;
    EXPECT_FALSE(fake.pulses.empty());
    EXPECT_EQ(validationReport(), "");

    XrInstanceCreateInfo info{XR_TYPE_INSTANCE_CREATE_INFO};
    std::snprintf(info.applicationInfo.applicationName, sizeof info.applicationInfo.applicationName, "wrong");
    info.applicationInfo.apiVersion = XR_CURRENT_API_VERSION;
    XrInstance instance = XR_NULL_HANDLE;
    ASSERT_EQ(xrCreateInstance(&info, &instance), XR_SUCCESS);
    XrSystemId system = 0;
    EXPECT_NE(xrGetSystem(instance, nullptr, &system), XR_SUCCESS);
    xrDestroyInstance(instance);
    EXPECT_THAT(validationReport(), testing::HasSubstr("VUID-xrGetSystem-getInfo-parameter"));
    std::filesystem::remove(validation_);
}

} // namespace
} // namespace shoal::app
