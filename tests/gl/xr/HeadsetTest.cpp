// A headset through the real loader and the fake runtime of the tests.
#include "engine/xr/Headset.h"
#include "engine/xr/Tracked.h"
#include "tests/gl/xr/Fixture.h"

namespace shoal::xr {
namespace {

class HeadsetGL : public test::WithFakeRuntime {
  protected:
    void SetUp() override {
        WithFakeRuntime::SetUp();
        if (!IsSkipped()) openWindow();
    }

    static Headset open() { return tests::valueOf(Headset::open({96, 60})); }
    // One turn of a game's loop that shows nothing.
    static Frame emptyFrame(Headset& headset) {
        EXPECT_TRUE(tests::succeeded(headset.poll()));
        if (!headset.wantsFrames()) return {};
        const auto frame = tests::valueOf(headset.waitFrame());
        EXPECT_TRUE(headset.begin());
        EXPECT_TRUE(headset.end({}));
        return frame;
    }
    static const Tracking& next(Headset& headset) {
        emptyFrame(headset);
        return headset.tracking();
    }
    static Headset focused() {
        Headset headset = open();
        for (int i = 0; i < 10 && !headset.plays(); ++i) emptyFrame(headset);
        EXPECT_TRUE(headset.plays());
        return headset;
    }
    // Begins a frame that the test draws.
    static Frame begin(Headset& headset) {
        EXPECT_TRUE(headset.poll());
        const auto frame = headset.waitFrame();
        EXPECT_TRUE(frame && headset.begin());
        return *frame;
    }
};

TEST_F(HeadsetGL, BeginsAndEndsInGoodOrder) {
    {
        EXPECT_FALSE(open().wantsFrames());
        fake.boundProfiles.clear();
        const Headset headset = focused();
        EXPECT_EQ(headset.properties().name, "Fake headset (Fake runtime)");
        EXPECT_EQ(headset.properties().eyeSize, glm::ivec2(200, 240));
        EXPECT_TRUE(headset.properties().bareHands);
        EXPECT_FALSE(headset.leaving());
    }
    EXPECT_TRUE(fake.called.contains("xrRequestExitSession"));
    EXPECT_TRUE(fake.called.contains("xrEndSession"));
    EXPECT_EQ(fake.boundProfiles.size(), 5u);
}

TEST_F(HeadsetGL, AsksForNinetyPicturesASecondWhereTheyAreOffered) {
    (void)open();
    EXPECT_FALSE(fake.called.contains("xrEnumerateDisplayRefreshRatesFB")) << "the extension is not there";
    fake.extensions.insert(XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME);
    { Headset headset = focused(); }
    EXPECT_EQ(fake.refreshRate_Hz, 90);
    // A rate that is not offered is not asked for, and a failure is no reason not to play.
    fake.refreshRates_Hz = {60, 72};
    fake.refreshRate_Hz = 72;
    fake.called.clear();
    (void)open();
    EXPECT_TRUE(fake.called.contains("xrEnumerateDisplayRefreshRatesFB"));
    EXPECT_FALSE(fake.called.contains("xrRequestDisplayRefreshRateFB"));
    fake.failing["xrEnumerateDisplayRefreshRatesFB"] = XR_ERROR_RUNTIME_FAILURE;
    (void)open();
}

TEST_F(HeadsetGL, CentresTheDiveUnderTheHead) {
    // The player stands somewhere else and looks to the right, and down.
    const glm::quat turn =
        glm::angleAxis(-1.2f, glm::vec3(0, 1, 0)) * glm::angleAxis(-0.4f, glm::vec3(1, 0, 0));
    placeHead({2, 0.3f, -1}, turn);
    Headset headset = focused();
    const Tracking& now = next(headset);
    ASSERT_TRUE(now.headTracked);
    EXPECT_LT(glm::length(now.worldFromHead.position), 1e-5f);
    const glm::vec3 ahead = now.worldFromHead.orientation * glm::vec3(0, 0, -1);
    // Only the looking down is left of the turn.
    EXPECT_LT(glm::distance(ahead, glm::vec3(0, std::sin(-0.4f), -std::cos(0.4f))), 1e-5f);
    EXPECT_NEAR(glm::distance(now.eyes[0].worldFromEye.position, now.eyes[1].worldFromEye.position), 0.064f,
                1e-5f);

    // A step to the side is a step in the dive, until it is centred anew.
    for (XrView& view : fake.views) view.pose.position.y += 0.25f;
    EXPECT_NEAR(next(headset).worldFromHead.position.y, 0.25f, 1e-5f);
    fake.sayRecentred();
    EXPECT_LT(glm::length(next(headset).worldFromHead.position), 1e-5f);
}

// A change that the runtime announces holds from the time that it says: until then LOCAL is where it was.
TEST_F(HeadsetGL, ARecentringByTheRuntimeIsObeyedWhenItHappens) {
    Headset headset = focused();
    Frame now = emptyFrame(headset);
    const auto seen = [&] {
        now = emptyFrame(headset);
        return headset.tracking().worldFromHead.position.x;
    };
    placeHead({0.5f, 0, 0});
    EXPECT_NEAR(seen(), 0.5f, 1e-5f);
    // The area that the player has set up is another matter.
    fake.sayRecentred(XR_REFERENCE_SPACE_TYPE_STAGE, now.display_ns);
    EXPECT_NEAR(seen(), 0.5f, 1e-5f);
    const XrTime when = now.display_ns + 5 * static_cast<XrTime>(now.period_s * 1e9) / 2;
    fake.sayRecentred(XR_REFERENCE_SPACE_TYPE_LOCAL, when);
    EXPECT_NEAR(seen(), 0.5f, 1e-5f);
    EXPECT_NEAR(seen(), 0.5f, 1e-5f);
    placeHead({0.1f, 0, 0}); // LOCAL has moved, to where the player stood when asked
    EXPECT_NEAR(seen(), 0, 1e-5f);
    placeHead({0.2f, 0, 0});
    EXPECT_NEAR(seen(), 0.1f, 1e-5f);
}

TEST_F(HeadsetGL, TheFloorIsKnownWhereTheRuntimeKnowsIt) {
    withoutValidation();
    for (XrView& view : fake.views) view.pose.position.y = 0.2f; // the origin of the dive, above LOCAL's
    const auto floor = [&] {
        Headset headset = focused();
        return next(headset).floor_m;
    };
    const auto offer = [&](XrReferenceSpaceType type, float y) {
        fake.referenceSpaces[type] = {{0, 0, 0, 1}, {3, y, 1}};
    };
    EXPECT_FALSE(floor());
    offer(XR_REFERENCE_SPACE_TYPE_STAGE, -1.5f);
    ASSERT_TRUE(floor());
    EXPECT_NEAR(*floor(), -1.7f, 1e-5f);
    offer(XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT, -1.4f);
    EXPECT_NEAR(*floor(), -1.7f, 1e-5f) << "without its extension there is no such space";
    fake.extensions.insert(XR_EXT_LOCAL_FLOOR_EXTENSION_NAME);
    EXPECT_NEAR(*floor(), -1.6f, 1e-5f);
    for (const float y : {0.3f, -20.0f, std::numeric_limits<float>::quiet_NaN()}) { // none can be there
        offer(XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT, y);
        EXPECT_FALSE(floor()) << y;
    }
    offer(XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT, -1.4f);
    fake.spaceFlags = 0;
    EXPECT_FALSE(floor());
}

// A runtime need only mark poses as valid; Monado's simulated headset never marks them as tracked.
TEST_F(HeadsetGL, PosesThatAreOnlyValidAreTaken) {
    fake.viewFlags = XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT;
    Headset headset = focused();
    emptyFrame(headset);
    for (XrView& view : fake.views) view.pose.position.y += 0.25f;
    EXPECT_TRUE(next(headset).headTracked);
    EXPECT_FALSE(headset.tracking().positionLost);
    EXPECT_NEAR(headset.tracking().worldFromHead.position.y, 0.25f, 1e-5f);
}

TEST_F(HeadsetGL, KnowsWhenTheHeadIsLost) {
    Headset headset = focused();
    const glm::vec3 known = next(headset).worldFromHead.position;
    for (const XrViewStateFlags flags : {XrViewStateFlags(0), XR_VIEW_STATE_POSITION_VALID_BIT}) {
        fake.viewFlags = flags;
        fake.views[0].pose.position.x = 7;
        EXPECT_FALSE(next(headset).headTracked) << flags;
        EXPECT_EQ(headset.tracking().worldFromHead.position, known);
    }
    fake.viewFlags = 0xf;
    fake.views[0].pose.orientation = {0, 0, 0, 0}; // no rotation at all
    EXPECT_FALSE(next(headset).headTracked);
    fake.views[0].pose = {{0, 0, 0, 1}, {-0.032f, 0, 0}};
    EXPECT_TRUE(next(headset).headTracked);
}

// Without a position, or with a guess where it was measured before, the head turns where it was.
TEST_F(HeadsetGL, AHeadWhosePositionIsLostTurnsWhereItWas) {
    Headset headset = focused();
    for (XrView& view : fake.views) view.pose.position.y += 0.25f;
    const glm::vec3 known = next(headset).worldFromHead.position;
    float yaw = 0;
    for (const XrViewStateFlags flags :
         {XrViewStateFlags(XR_VIEW_STATE_ORIENTATION_VALID_BIT),
          XrViewStateFlags(0xf & ~XR_VIEW_STATE_POSITION_VALID_BIT & ~XR_VIEW_STATE_POSITION_TRACKED_BIT),
          XrViewStateFlags(0xf & ~XR_VIEW_STATE_POSITION_TRACKED_BIT)}) {
        fake.viewFlags = flags;
        yaw += 0.3f;
        for (XrView& view : fake.views)
            view.pose = {{0, std::sin(yaw / 2), 0, std::cos(yaw / 2)},
                         {std::numeric_limits<float>::quiet_NaN(), 3, 3}};
        const Tracking& now = next(headset);
        EXPECT_TRUE(now.headTracked) << flags;
        EXPECT_TRUE(now.positionLost) << flags;
        EXPECT_LT(glm::distance(now.worldFromHead.position, known), 1e-6f) << flags;
        const glm::vec3 ahead = now.worldFromHead.orientation * glm::vec3(0, 0, -1);
        EXPECT_LT(glm::distance(ahead, glm::vec3(-std::sin(yaw), 0, -std::cos(yaw))), 1e-5f) << flags;
        const glm::vec3 apart = now.eyes[1].worldFromEye.position - now.eyes[0].worldFromEye.position;
        EXPECT_LT(glm::distance(apart, 0.064f * glm::vec3(std::cos(yaw), 0, -std::sin(yaw))), 1e-5f) << flags;
    }
    fake.viewFlags = 0xf;
    placeHead({0, 0.5f, 0});
    EXPECT_FALSE(next(headset).positionLost);
    EXPECT_NEAR(headset.tracking().worldFromHead.position.y, 0.5f, 1e-5f);
}

// A headset that only turns; the eyes are as far apart as those of people.
TEST_F(HeadsetGL, AHeadThatOnlyTurnsIsDrawnFrom) {
    fake.viewFlags = XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_ORIENTATION_TRACKED_BIT;
    Headset headset = focused();
    const Tracking& now = next(headset);
    EXPECT_TRUE(now.headTracked);
    EXPECT_EQ(now.worldFromHead.position, glm::vec3(0));
    EXPECT_NEAR(glm::distance(now.eyes[0].worldFromEye.position, now.eyes[1].worldFromEye.position), 0.063f,
                1e-5f);
}

// The headset shows every pixel as it was written, in the given poses and fields of view.
TEST_F(HeadsetGL, ShowsWhatIsDrawnFromWhereTheEyesAre) {
    fake.keepPictures = true;
    Headset headset = focused();
    const Frame frame = begin(headset);
    EXPECT_TRUE(frame.drawn);
    for (const Picture picture : {Picture::LeftEye, Picture::RightEye, Picture::Panel}) {
        const auto framebuffer = tests::valueOf(headset.acquire(picture));
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glClearColor(100 / 255.0f, 50 / 255.0f, static_cast<float>(picture) / 255.0f, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        ASSERT_TRUE(headset.release(picture));
    }
    const Pose place{{0.1f, 0.2f, -1.5f}, {1, 0, 0, 0}};
    ASSERT_TRUE(headset.end({.eyes = true,
                             .eyeSize = {150, 160},
                             .panel = true,
                             .worldFromPanel = place,
                             .panelSize_m = {1.8f, 1.125f}}));
    EXPECT_EQ(fake.last.blend, XR_ENVIRONMENT_BLEND_MODE_OPAQUE);
    EXPECT_EQ(fake.last.eyesFlags, 0u);
    ASSERT_TRUE(fake.last.eyes && fake.last.panel);
    EXPECT_EQ(fake.last.display, frame.display_ns);
    for (size_t eye = 0; eye < 2; ++eye) {
        const test::ShownEye& shown = (*fake.last.eyes)[eye];
        const XrView& given = fake.views[eye];
        EXPECT_NEAR(shown.localFromEye.position.x, given.pose.position.x, 1e-6f);
        EXPECT_NEAR(std::abs(shown.localFromEye.orientation.w), 1, 1e-6f);
        EXPECT_EQ(shown.fov.angleLeft, given.fov.angleLeft);
        EXPECT_EQ(shown.fov.angleDown, given.fov.angleDown);
        EXPECT_EQ(shown.rect.extent.width, 150);
        EXPECT_EQ(shown.rgba[0], 100); // coded values stay as they are
        EXPECT_EQ(shown.rgba[2], eye);
    }
    EXPECT_NEAR(fake.last.panel->localFromPanel.position.z, -1.5f, 1e-6f);
    EXPECT_EQ(fake.last.panel->size.width, 1.8f);
    EXPECT_EQ(fake.last.panel->rect.extent.width, 96);
    EXPECT_EQ(fake.last.panel->rgba[2], 2);
}

// The eyes' pictures blend by alpha, premultiplied; the mode may change in each frame, as is specified.
TEST_F(HeadsetGL, TheRoomIsBlendedWhereTheRuntimeOffersIt) {
    EXPECT_FALSE(open().properties().seesRoom);
    fake.blendModes = {XR_ENVIRONMENT_BLEND_MODE_OPAQUE, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND};
    Headset headset = focused();
    EXPECT_TRUE(headset.properties().seesRoom);
    for (const bool room : {true, false, true}) {
        begin(headset);
        for (const Picture picture : {Picture::LeftEye, Picture::RightEye}) {
            ASSERT_TRUE(headset.acquire(picture));
            ASSERT_TRUE(headset.release(picture));
        }
        ASSERT_TRUE(headset.end({.eyes = true, .room = room, .eyeSize = {200, 240}}));
        EXPECT_EQ(fake.last.blend,
                  room ? XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND : XR_ENVIRONMENT_BLEND_MODE_OPAQUE);
        EXPECT_EQ(fake.last.eyesFlags,
                  room ? XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT : XrCompositionLayerFlags{0});
    }
}

// XR_KHR_composition_layer_depth, where the runtime takes depth of enough bits.
TEST_F(HeadsetGL, DepthGoesWithTheEyes) {
    EXPECT_FALSE(open().properties().takesDepth);
    fake.extensions.insert(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME);
    fake.formats.push_back(GL_DEPTH_COMPONENT16);
    EXPECT_FALSE(open().properties().takesDepth);
    fake.keepPictures = true;
    for (const int64_t format : {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT24}) {
        fake.formats.push_back(format);
        Headset headset = focused();
        ASSERT_TRUE(headset.properties().takesDepth);
        begin(headset);
        for (const Picture picture :
             {Picture::LeftEye, Picture::RightEye, Picture::LeftDepth, Picture::RightDepth}) {
            const auto framebuffer = tests::valueOf(headset.acquire(picture));
            glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
            glClearDepth(picture == Picture::LeftDepth ? 0.25 : 0.75);
            glClear(GL_DEPTH_BUFFER_BIT);
            ASSERT_TRUE(headset.release(picture));
        }
        glClearDepth(1);
        ASSERT_TRUE(headset.end({.eyes = true, .eyeSize = {150, 160}, .planes = Planes{0.1f, 50}}));
        ASSERT_TRUE(fake.last.eyes);
        for (size_t eye = 0; eye < 2; ++eye) {
            const auto& depth = (*fake.last.eyes)[eye].depth;
            ASSERT_TRUE(depth);
            EXPECT_EQ(depth->near_m, 0.1f);
            EXPECT_EQ(depth->far_m, 50);
            EXPECT_EQ(depth->minimum, 0);
            EXPECT_EQ(depth->maximum, 1);
            EXPECT_EQ(depth->rect.extent.width, 150);
            ASSERT_EQ(depth->values.size(), 150u * 160);
            EXPECT_NEAR(depth->values[0], eye == 0 ? 0.25f : 0.75f, 1e-6f);
        }
    }
}

TEST_F(HeadsetGL, HandsAndControllersAreTold) {
    fake.hands[1].active = true;
    for (size_t i = 0; i < fake.hands[1].joints.size(); ++i)
        fake.hands[1].joints[i] = {0xf, {{0, 0, 0, 1}, {0.01f * static_cast<float>(i), 0, -0.4f}}, 0.01f};
    fake.controllers[0] = {true, {{0, 0, 0, 1}, {-0.3f, -0.2f, -0.5f}}, 0.7f, 0.2f, true};
    Headset headset = focused();
    const Tracking& now = next(headset);
    EXPECT_FALSE(now.hands[0].tracked);
    ASSERT_TRUE(now.hands[1].tracked);
    EXPECT_NEAR(now.hands[1].joints[25].position.x, 0.25f, 1e-6f);
    EXPECT_EQ(now.hands[1].confidence, 1);
    ASSERT_TRUE(now.controllers[0].worldFromGrip && now.controllers[0].menu);
    EXPECT_EQ(now.controllers[0].squeeze, 0.7f);
    EXPECT_EQ(now.controllers[0].trigger, 0.2f);
    EXPECT_NEAR(now.controllers[0].worldFromGrip->position.z, -0.5f, 1e-6f);
    EXPECT_FALSE(now.controllers[1].worldFromGrip);

    fake.say(XR_SESSION_STATE_VISIBLE); // a menu of the runtime: what is pressed there is not ours
    EXPECT_FALSE(next(headset).controllers[0].worldFromGrip);
}

// The fake runtime knows what the registry says that each has, and complains of all else.
TEST_F(HeadsetGL, ControllersOfExtensionsAreBoundWhereTheyAreOffered) {
    fake.extensions.insert("XR_EXT_hand_interaction");
    (void)open();
    const auto bound = [&](const std::string& name) {
        return std::ranges::find(fake.boundProfiles, "/interaction_profiles/" + name) !=
               fake.boundProfiles.end();
    };
    EXPECT_EQ(fake.boundProfiles.size(), 6u);
    EXPECT_TRUE(bound("ext/hand_interaction_ext"));
    fake.boundProfiles.clear();
    for (const char* name :
         {"XR_FB_touch_controller_pro", "XR_META_touch_controller_plus", "XR_BD_controller_interaction",
          "XR_BD_ultra_controller_interaction", "XR_HTC_vive_focus3_controller_interaction",
          "XR_EXT_hp_mixed_reality_controller"})
        fake.extensions.insert(name);
    (void)open();
    EXPECT_EQ(fake.boundProfiles.size(), 13u);
    EXPECT_TRUE(bound("bytedance/pico4_controller"));
}

// XR_EXT_hand_tracking_data_source: of a hand that holds a controller the controller tells more.
TEST_F(HeadsetGL, JointsThatAreMadeUpFromAControllerAreNotAskedFor) {
    withoutValidation();
    for (test::FakeHand& hand : fake.hands) {
        hand.active = true;
        for (auto& joint : hand.joints) joint = {0xf, {{0, 0, 0, 1}, {0, 0, -0.4f}}, 0.01f};
    }
    fake.hands[1].isMadeUp = true;
    const auto tracked = [&](int hand) {
        Headset headset = focused();
        return next(headset).hands[static_cast<size_t>(hand)].tracked;
    };
    EXPECT_TRUE(tracked(1)) << "a runtime that cannot tell";
    fake.extensions.insert(XR_EXT_HAND_TRACKING_DATA_SOURCE_EXTENSION_NAME);
    EXPECT_TRUE(tracked(0));
    EXPECT_FALSE(tracked(1));
    fake.tellsDataSources = false;
    EXPECT_TRUE(tracked(1));
}

TEST_F(HeadsetGL, AHandIsTrackedWhereAllItsJointsAreKnown) {
    fake.hands[0].active = true;
    for (auto& joint : fake.hands[0].joints) joint = {0xf, {{0, 0, 0, 1}, {0, 0, -0.4f}}, 0.01f};
    Headset headset = focused();
    const auto seen = [&] { return next(headset).hands[0]; };
    for (size_t i = 0; i < 13; ++i)
        fake.hands[0].joints[i].locationFlags = 0x3; // guessed: valid, not tracked
    EXPECT_EQ(seen().confidence, 0.5f);
    for (const float radius : {0.0f, -1.0f, 3.0f, std::numeric_limits<float>::quiet_NaN()}) {
        fake.hands[0].joints[3].radius = radius;
        const hands::HandPose hand = seen();
        EXPECT_TRUE(plausible(hand)) << radius;
        EXPECT_EQ(hand.joints[3].radius, hands::Joint{}.radius);
    }
    fake.hands[0].joints[13].locationFlags = 0;
    EXPECT_FALSE(seen().tracked);
}

TEST_F(HeadsetGL, WorksWithoutHandTracking) {
    fake.extensions = {XR_KHR_OPENGL_ENABLE_EXTENSION_NAME};
    fake.hands[0].active = true;
    Headset headset = focused();
    EXPECT_FALSE(headset.properties().bareHands);
    EXPECT_FALSE(next(headset).hands[0].tracked);
    EXPECT_FALSE(fake.called.contains("xrCreateHandTrackerEXT"));
}

// XR_EXT_user_presence counts in any session state; a headset without the sensor sends no such events.
TEST_F(HeadsetGL, TakingItOffEndsPlay) {
    withoutValidation();
    fake.extensions.insert(XR_EXT_USER_PRESENCE_EXTENSION_NAME);
    for (const bool senses : {true, false}) {
        fake.sensesWearer = senses;
        Headset headset = focused();
        EXPECT_TRUE(fake.enabled.contains(XR_EXT_USER_PRESENCE_EXTENSION_NAME));
        fake.sayWorn(false);
        emptyFrame(headset);
        EXPECT_EQ(headset.plays(), !senses);
        fake.sayWorn(true);
        emptyFrame(headset);
        EXPECT_TRUE(headset.plays());
    }
}

TEST_F(HeadsetGL, VibratesWithLimitsAndStops) {
    {
        Headset headset = focused();
        ASSERT_TRUE(headset.vibrate(1, 0.6f, 180));
        ASSERT_TRUE(headset.vibrate(0, 5, 60));
        ASSERT_TRUE(headset.vibrate(1, 0, 0));
        ASSERT_EQ(fake.pulses.size(), 3u);
        EXPECT_EQ(fake.pulses[0].hand, 1);
        EXPECT_EQ(fake.pulses[0].amplitude, 0.6f);
        EXPECT_EQ(fake.pulses[0].frequency_Hz, 180);
        EXPECT_EQ(fake.pulses[0].duration, 100'000'000);
        EXPECT_EQ(fake.pulses[1].amplitude, 1);
        EXPECT_EQ(fake.pulses[2].amplitude, 0);
        fake.pulses.clear();
    }
    // Both told to stop when it closes.
    ASSERT_EQ(fake.pulses.size(), 2u);
    for (const test::FeltPulse& pulse : fake.pulses) EXPECT_EQ(pulse.amplitude, 0);
}

TEST_F(HeadsetGL, ChoosesPicturesThatAreKnownToBeCoded) {
    fake.formats = {GL_RGBA16F};
    EXPECT_THAT(tests::errorOf(Headset::open({96, 60})).message(), testing::HasSubstr("GL_SRGB8_ALPHA8"));
    fake.formats = {GL_RGBA8};
    EXPECT_TRUE(Headset::open({96, 60}));
}

TEST(ActiveRuntime, IsNamed) {
    setenv("XR_RUNTIME_JSON", FAKE_RUNTIME_JSON, 1);
    EXPECT_EQ(tests::valueOf(activeRuntime()), "Fake runtime");
}

} // namespace
} // namespace shoal::xr
