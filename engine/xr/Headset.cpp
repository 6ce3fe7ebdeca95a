#include "engine/xr/Headset.h"

#include "engine/core/Files.h"
#include "engine/core/Log.h"
#include "engine/xr/NewerOpenXr.h"
#include "engine/xr/OpenXr.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace shoal::xr {

namespace {

using Space = Handle<XrSpace, xrDestroySpace>;

Space makeSpace(XrSession session, const Pose& referenceFromSpace,
                XrReferenceSpaceType reference = XR_REFERENCE_SPACE_TYPE_LOCAL) {
    const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, reference,
                                          poseTo(referenceFromSpace)};
    return Space(written(XrSpace{}, "xrCreateReferenceSpace", xrCreateReferenceSpace, session, &info));
}

// Returns a space with its origin on the floor: below LOCAL's origin, else in the play area that the player
// has set up. Empty if the runtime has neither.
Space makeFloor(XrSession session) {
    const auto offered = enumerate(XR_REFERENCE_SPACE_TYPE_LOCAL, "xrEnumerateReferenceSpaces",
                                   xrEnumerateReferenceSpaces, session);
    for (const XrReferenceSpaceType type :
         {XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT, XR_REFERENCE_SPACE_TYPE_STAGE})
        if (std::ranges::find(offered, type) != offered.end()) return makeSpace(session, {}, type);
    return {};
}

static_assert(XR_HAND_JOINT_COUNT_EXT == hands::kJointCount);

// Returns the first wanted format that the runtime offers; 0: none.
int64_t formatOf(XrSession session, std::initializer_list<int64_t> wanted) {
    const auto offered =
        enumerate(int64_t{0}, "xrEnumerateSwapchainFormats", xrEnumerateSwapchainFormats, session);
    for (const int64_t format : wanted)
        if (std::ranges::find(offered, format) != offered.end()) return format;
    return 0;
}

// A swapchain: the images that the runtime shows one after another, one sample a pixel.
class Swapchain {
  public:
    Swapchain() = default;
    // attachment: GL_COLOR_ATTACHMENT0 or GL_DEPTH_ATTACHMENT, as the format is.
    Swapchain(XrSession session, glm::ivec2 size, int64_t format, GLenum attachment) : size_(size) {
        XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
        info.format = format;
        info.usageFlags = XR_SWAPCHAIN_USAGE_SAMPLED_BIT |
                          (attachment == GL_DEPTH_ATTACHMENT ? XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                                             : XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT);
        info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
        info.width = static_cast<uint32_t>(size.x);
        info.height = static_cast<uint32_t>(size.y);
        handle_.reset(written(XrSwapchain{}, "xrCreateSwapchain", xrCreateSwapchain, session, &info));
        const auto list = [&](uint32_t capacity, uint32_t* count, XrSwapchainImageOpenGLKHR* items) {
            auto* const given = reinterpret_cast<XrSwapchainImageBaseHeader*>(items);
            return xrEnumerateSwapchainImages(name(), capacity, count, given);
        };
        for (const auto& image : enumerate(XrSwapchainImageOpenGLKHR{XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR},
                                           "xrEnumerateSwapchainImages", list)) {
            glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_.emplace_back(gl::Framebuffer::make()).name());
            if (attachment == GL_DEPTH_ATTACHMENT) {
                glDrawBuffer(GL_NONE);
                glReadBuffer(GL_NONE);
            }
            glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, image.image, 0);
            if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
                throw Failure("the runtime's pictures cannot be drawn into");
        }
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
    }

    // Returns a framebuffer on the next picture once the runtime is done with it; release() hands it over.
    GLuint acquire() {
        const XrSwapchainImageAcquireInfo acquire{XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO};
        const auto index =
            written(uint32_t{0}, "xrAcquireSwapchainImage", xrAcquireSwapchainImage, name(), &acquire);
        // The wait is limited, because a runtime that hangs must not stop the window too.
        constexpr XrDuration kPatience_ns = 2'000'000'000;
        const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, kPatience_ns};
        const XrResult waited = SHOAL_XR(xrWaitSwapchainImage(name(), &wait));
        if (waited == XR_TIMEOUT_EXPIRED || index >= framebuffers_.size())
            throw Failure("the headset's runtime gives no picture to draw into");
        return framebuffers_[index].name();
    }
    void release() {
        const XrSwapchainImageReleaseInfo info{XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO};
        SHOAL_XR(xrReleaseSwapchainImage(name(), &info));
    }

    XrSwapchain name() const { return handle_.get(); }
    glm::ivec2 size() const { return size_; }

  private:
    // Finishes drawing first: the driver's threads may still draw into pictures that are freed with the
    // swapchain.
    static XrResult destroyDrawn(XrSwapchain swapchain) {
        glFinish();
        return xrDestroySwapchain(swapchain);
    }

    Handle<XrSwapchain, destroyDrawn> handle_;
    std::vector<gl::Framebuffer> framebuffers_; // one a picture
    glm::ivec2 size_{0};
};

constexpr auto kMeasured = XR_SPACE_LOCATION_POSITION_TRACKED_BIT | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;

// Hands without controllers, tracked through XR_EXT_hand_tracking.
class HandTrackers {
  public:
    // Hands are never active without the extension.
    HandTrackers(const Instance& instance, XrSession session) {
        if (!instance.properties.bareHands) return;
        const XrInstance name = instance.handle.get();
        const auto create = functionOf<PFN_xrCreateHandTrackerEXT>(name, "xrCreateHandTrackerEXT");
        const auto destroy = functionOf<PFN_xrDestroyHandTrackerEXT>(name, "xrDestroyHandTrackerEXT");
        locate_ = functionOf<PFN_xrLocateHandJointsEXT>(name, "xrLocateHandJointsEXT");
        if (!create || !destroy || !locate_)
            throw Failure("the runtime promises XR_EXT_hand_tracking and lacks its functions");
        // Joints that a runtime makes up for a hand with a controller are not wanted: see Controller.
        auto bare = XR_HAND_TRACKING_DATA_SOURCE_UNOBSTRUCTED_EXT;
        const XrHandTrackingDataSourceInfoEXT bareAlone{XR_TYPE_HAND_TRACKING_DATA_SOURCE_INFO_EXT, nullptr,
                                                        1, &bare};
        for (size_t i = 0; i < 2; ++i) {
            XrHandTrackerCreateInfoEXT info{XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT, nullptr,
                                            i == 0 ? XR_HAND_LEFT_EXT : XR_HAND_RIGHT_EXT,
                                            XR_HAND_JOINT_SET_DEFAULT_EXT};
            if (instance.uses(XR_EXT_HAND_TRACKING_DATA_SOURCE_EXTENSION_NAME)) info.next = &bareAlone;
            XrHandTrackerEXT tracker = XR_NULL_HANDLE;
            XrResult created = create(session, &info, &tracker);
            if (created == XR_ERROR_FEATURE_UNSUPPORTED && info.next) {
                info.next = nullptr;
                created = create(session, &info, &tracker);
            }
            check(created, "xrCreateHandTrackerEXT");
            trackers_.emplace_back(tracker, destroy);
        }
    }
    void locate(XrSpace world, XrTime time, std::array<hands::HandPose, 2>& out) const {
        for (size_t i = 0; i < trackers_.size(); ++i) {
            hands::HandPose& hand = out[i];
            hand = {};
            std::array<XrHandJointLocationEXT, XR_HAND_JOINT_COUNT_EXT> joints{};
            const XrHandJointsLocateInfoEXT info{XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT, nullptr, world, time};
            XrHandJointLocationsEXT locations{XR_TYPE_HAND_JOINT_LOCATIONS_EXT, nullptr, XR_FALSE,
                                              static_cast<uint32_t>(joints.size()), joints.data()};
            check(locate_(trackers_[i].get(), &info, &locations), "xrLocateHandJointsEXT");
            hand.tracked = locations.isActive == XR_TRUE;
            int seen = 0;
            for (size_t j = 0; hand.tracked && j < joints.size(); ++j) {
                const XrHandJointLocationEXT& joint = joints[j];
                const Pose worldFromJoint = poseFrom(joint.pose);
                hand.tracked = valid(joint.locationFlags) && believable(worldFromJoint);
                seen += (joint.locationFlags & kMeasured) == kMeasured;
                hand.joints[j].position = worldFromJoint.position;
                hand.joints[j].orientation = worldFromJoint.orientation;
                if (joint.radius >= 0.001f && joint.radius <= 0.1f) hand.joints[j].radius = joint.radius;
            }
            hand.confidence = static_cast<float>(seen) / hands::kJointCount;
        }
    }

  private:
    using Tracker = std::unique_ptr<std::remove_pointer_t<XrHandTrackerEXT>, PFN_xrDestroyHandTrackerEXT>;
    std::vector<Tracker> trackers_; // left, right, or none
    PFN_xrLocateHandJointsEXT locate_ = nullptr;
};

// Requests a higher refresh rate: some headsets begin with fewer pictures a second than they can show. A
// failure is no reason not to play.
void askForRefreshRate(const Instance& instance, XrSession session) {
    constexpr float kWanted_Hz = 90, kSame_Hz = 0.5f;
    if (!instance.uses(XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME)) return;
    const XrInstance name = instance.handle.get();
    const auto list =
        functionOf<PFN_xrEnumerateDisplayRefreshRatesFB>(name, "xrEnumerateDisplayRefreshRatesFB");
    const auto request = functionOf<PFN_xrRequestDisplayRefreshRateFB>(name, "xrRequestDisplayRefreshRateFB");
    if (!list || !request) return;
    const Status asked = resultOf([&] {
        for (const float rate_Hz : enumerate(0.0f, "xrEnumerateDisplayRefreshRatesFB", list, session))
            if (std::abs(rate_Hz - kWanted_Hz) < kSame_Hz)
                check(request(session, rate_Hz), "xrRequestDisplayRefreshRateFB");
    });
    if (!asked) log::debug("{}", asked.error().message());
}

} // namespace

struct Headset::State {
    // Members use the members before them, so they are destroyed before those.
    Instance instance = Instance::open(true);
    SessionHandle session = createSession(instance);
    Space local = makeSpace(session.get(), {}), world = makeSpace(session.get(), {});
    Space floor = makeFloor(session.get());
    HandTrackers hands{instance, session.get()};
    Actions actions{instance, session.get()};
    std::array<Swapchain, 5> pictures; // by Picture

    XrSessionState state = XR_SESSION_STATE_UNKNOWN;
    bool running = false; // between xrBeginSession and xrEndSession
    bool lost = false;    // runtime or headset are gone
    bool worn = true;     // whether a player wears the headset; true if it has no sensor for that
    bool centring = true;
    std::optional<XrTime> recentresAt_ns; // time at which the runtime moves LOCAL, on the player's request
    bool positionTracked = false;         // whether it was ever tracked, not merely valid
    bool everPlaced = false;              // whether a position was ever known
    // Positions of the eyes in the head's frame, as last known; at first those of an average person.
    std::array<glm::vec3, 2> headFromEye{glm::vec3(-0.0315f, 0, 0), glm::vec3(0.0315f, 0, 0)};
    Frame frame;
    Tracking tracking;

    template <class Work> auto guard(Work&& work) { return resultOf(work, &lost); }
    void enter(XrSessionState next);
    void locateEyes();
    void locateFloor();
    Swapchain& picture(Picture p) { return pictures[static_cast<size_t>(p)]; }
};

bool Headset::hasRuntime() {
    if (std::getenv("XR_RUNTIME_JSON")) return true;
    std::error_code code;
    for (const Path& folder : {configFolder().parent_path(), Path("/etc/xdg"), Path("/etc")})
        if (std::filesystem::exists(folder / "openxr/1/active_runtime.json", code)) return true;
    return false;
}

bool Headset::isThere() {
    return resultOf([] { (void)Instance::open(true); }).ok();
}

Result<Headset> Headset::open(glm::ivec2 panelSize) {
    return resultOf([&] {
        auto state = std::make_unique<State>();
        const XrSession session = state->session.get();
        Properties& properties = state->instance.properties;
        askForRefreshRate(state->instance, session);
        // The first format tells the runtime that the picture is display-coded; it is written unchanged
        // (GL_FRAMEBUFFER_SRGB stays off). Some runtimes take the second for linear, most for coded.
        const int64_t colours = formatOf(session, {GL_SRGB8_ALPHA8, GL_RGBA8});
        if (colours == 0)
            throw Failure("the headset's runtime takes no pictures of 8 bits a colour (GL_SRGB8_ALPHA8)");
        for (const Picture p : {Picture::LeftEye, Picture::RightEye, Picture::Panel})
            state->picture(p) = Swapchain(session, p == Picture::Panel ? panelSize : properties.eyeSize,
                                          colours, GL_COLOR_ATTACHMENT0);
        // 16 bits are too coarse for depths from a hand to the far plane.
        const int64_t depths = formatOf(session, {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32F});
        properties.takesDepth &= depths != 0;
        for (const Picture p : {Picture::LeftDepth, Picture::RightDepth})
            if (properties.takesDepth)
                state->picture(p) = Swapchain(session, properties.eyeSize, depths, GL_DEPTH_ATTACHMENT);
        return Headset(std::move(state));
    });
}

Status Headset::poll() {
    State& s = *state_;
    return s.guard([&] {
        for (;;) {
            XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
            if (SHOAL_XR(xrPollEvent(s.instance.handle.get(), &event)) == XR_EVENT_UNAVAILABLE) return;
            if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
                s.enter(reinterpret_cast<XrEventDataSessionStateChanged&>(event).state);
            } else if (event.type == XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING) {
                throw Failure("the headset's runtime is going away", true);
            } else if (event.type == XR_TYPE_EVENT_DATA_USER_PRESENCE_CHANGED_EXT &&
                       s.instance.sensesWearer) {
                // Also sent when the session begins to run.
                s.worn = reinterpret_cast<XrEventDataUserPresenceChangedEXT&>(event).isUserPresent == XR_TRUE;
            } else if (event.type == XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING) {
                // The floor's space is located anew in every frame.
                const auto& change = reinterpret_cast<XrEventDataReferenceSpaceChangePending&>(event);
                if (change.referenceSpaceType == XR_REFERENCE_SPACE_TYPE_LOCAL)
                    s.recentresAt_ns = change.changeTime;
            }
        }
    });
}

void Headset::State::enter(XrSessionState next) {
    state = next;
    if (state == XR_SESSION_STATE_READY) {
        const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, kStereo};
        SHOAL_XR(xrBeginSession(session.get(), &info));
        running = true;
    } else if (state == XR_SESSION_STATE_STOPPING) {
        running = false;
        SHOAL_XR(xrEndSession(session.get()));
    } else if (state == XR_SESSION_STATE_LOSS_PENDING) {
        throw Failure("the headset was lost; is its cable in place?", true);
    }
}

Result<Frame> Headset::waitFrame() {
    State& s = *state_;
    return s.guard([&] {
        const XrFrameWaitInfo wait{XR_TYPE_FRAME_WAIT_INFO};
        const XrFrameState next =
            written(XrFrameState{XR_TYPE_FRAME_STATE}, "xrWaitFrame", xrWaitFrame, s.session.get(), &wait);
        s.frame.display_ns = next.predictedDisplayTime;
        s.frame.period_s = static_cast<double>(next.predictedDisplayPeriod) * 1e-9;
        s.frame.drawn = next.shouldRender == XR_TRUE;
        // Before that time the head's pose refers to the old LOCAL.
        if (s.recentresAt_ns && s.frame.display_ns >= *s.recentresAt_ns) {
            s.centring = true;
            s.recentresAt_ns.reset();
        }
        s.locateEyes();
        s.locateFloor();
        s.hands.locate(s.world.get(), s.frame.display_ns, s.tracking.hands);
        s.actions.locate(s.session.get(), s.world.get(), s.frame.display_ns, s.tracking.controllers);
        return s.frame;
    });
}

// Uses every pose that the runtime calls valid: TRACKED says only that it is measured now, and some headsets
// never claim that (Monado's simulated one). If a position that was tracked before is merely guessed, or
// missing, the head keeps its position and turns.
void Headset::State::locateEyes() {
    std::array<Eye, 2> eyes;
    bool placed = false; // the eyes' positions are known
    const auto middle = [&] { return between(eyes[0].worldFromEye, eyes[1].worldFromEye, 0.5f); };
    const auto locate = [&](const Space& space) { // returns whether the head's orientation is known
        const XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO, nullptr, kStereo, frame.display_ns,
                                    space.get()};
        XrViewState viewState{XR_TYPE_VIEW_STATE};
        std::array<XrView, 2> views{XrView{XR_TYPE_VIEW}, XrView{XR_TYPE_VIEW}};
        uint32_t count = 0;
        SHOAL_XR(xrLocateViews(session.get(), &info, &viewState, static_cast<uint32_t>(views.size()), &count,
                               views.data()));
        const XrViewStateFlags flags = viewState.viewStateFlags;
        const bool measured = flags & XR_VIEW_STATE_POSITION_TRACKED_BIT;
        placed = (flags & XR_VIEW_STATE_POSITION_VALID_BIT) && (measured || !positionTracked);
        bool turns = count == 2 && (flags & XR_VIEW_STATE_ORIENTATION_VALID_BIT);
        for (size_t i = 0; i < 2; ++i) {
            const XrFovf& fov = views[i].fov;
            eyes[i] = {poseFrom(views[i].pose), {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown}};
            if (!placed) eyes[i].worldFromEye.position = glm::vec3(0);
            turns = turns && believable(eyes[i].worldFromEye) && believable(eyes[i].fov);
        }
        positionTracked |= turns && placed && measured;
        return turns;
    };
    // Once a position has been known, the dive is centred only at a known one, never at the last.
    if (centring && locate(local) && (placed || !everPlaced)) {
        world = makeSpace(session.get(), originAt(middle()));
        centring = false;
        everPlaced = placed;
    }
    tracking.headTracked = locate(world);
    if (!tracking.headTracked) return;
    tracking.positionLost = !placed;
    if (placed) {
        centring |= !std::exchange(everPlaced, true); // it was centred without a position before
        const Pose headFromWorld = inverse(middle());
        for (size_t i = 0; i < 2; ++i) headFromEye[i] = (headFromWorld * eyes[i].worldFromEye).position;
    } else {
        const glm::quat turn = middle().orientation;
        for (size_t i = 0; i < 2; ++i)
            eyes[i].worldFromEye.position = tracking.worldFromHead.position + turn * headFromEye[i];
    }
    tracking.eyes = eyes;
    tracking.worldFromHead = middle();
}

// Ignores a floor that is above the eyes, or too far below them.
void Headset::State::locateFloor() {
    constexpr float kHighestEyes_m = 3;
    tracking.floor_m.reset();
    if (floor.get() == XR_NULL_HANDLE) return;
    const auto worldFromFloor = poseOf(floor.get(), world.get(), frame.display_ns);
    if (!worldFromFloor) return;
    const float eyes_m = tracking.worldFromHead.position.y - worldFromFloor->position.y;
    if (eyes_m > 0 && eyes_m < kHighestEyes_m) tracking.floor_m = worldFromFloor->position.y;
}

Status Headset::begin() {
    const XrFrameBeginInfo info{XR_TYPE_FRAME_BEGIN_INFO};
    // XR_FRAME_DISCARDED counts as success.
    return state_->guard([&] { SHOAL_XR(xrBeginFrame(state_->session.get(), &info)); });
}

Status Headset::end(const Shown& shown) {
    State& s = *state_;
    std::array<XrCompositionLayerProjectionView, 2> views;
    std::array<XrCompositionLayerDepthInfoKHR, 2> depths;
    for (size_t i = 0; i < 2; ++i) {
        const Eye& eye = s.tracking.eyes[i];
        views[i] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW,
                    nullptr,
                    poseTo(eye.worldFromEye),
                    {eye.fov.left, eye.fov.right, eye.fov.up, eye.fov.down},
                    {s.pictures[i].name(), {{0, 0}, {shown.eyeSize.x, shown.eyeSize.y}}, 0}};
        if (!shown.planes) continue;
        const auto [near_m, far_m] = *shown.planes;
        depths[i] = {
            XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR, nullptr, views[i].subImage, 0, 1, near_m, far_m};
        depths[i].subImage.swapchain = s.picture(i == 0 ? Picture::LeftDepth : Picture::RightDepth).name();
        views[i].next = &depths[i];
    }
    constexpr XrCompositionLayerFlags kByAlpha = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
    const XrCompositionLayerFlags flags = shown.room ? kByAlpha : 0;
    const XrCompositionLayerProjection projection{
        XR_TYPE_COMPOSITION_LAYER_PROJECTION, nullptr, flags, s.world.get(), 2, views.data()};
    const Swapchain& text = s.picture(Picture::Panel);
    const XrCompositionLayerQuad panel{XR_TYPE_COMPOSITION_LAYER_QUAD,
                                       nullptr,
                                       kByAlpha,
                                       s.world.get(),
                                       XR_EYE_VISIBILITY_BOTH,
                                       {text.name(), {{0, 0}, {text.size().x, text.size().y}}, 0},
                                       poseTo(shown.worldFromPanel),
                                       {shown.panelSize_m.x, shown.panelSize_m.y}};
    const auto blend = shown.room ? XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND : s.instance.blend;
    std::array<const XrCompositionLayerBaseHeader*, 2> layers{};
    uint32_t count = 0;
    if (shown.eyes) layers[count++] = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&projection);
    if (shown.panel) layers[count++] = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&panel);
    const XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO,         nullptr, s.frame.display_ns, blend, count,
                              count ? layers.data() : nullptr};
    return s.guard([&] { SHOAL_XR(xrEndFrame(s.session.get(), &info)); });
}

Headset::Headset(std::unique_ptr<State> state) : state_(std::move(state)) {}
Headset::Headset(Headset&&) noexcept = default;

// Ends as OpenXR demands: submits empty frames until the runtime says that the session may end. Any error
// ends it too.
Headset::~Headset() {
    if (!state_ || !state_->running || state_->lost) return;
    constexpr int kMaxFrames = 120;
    for (int hand = 0; hand < 2; ++hand) (void)vibrate(hand, 0, 0);
    if (!state_->guard([&] { SHOAL_XR(xrRequestExitSession(state_->session.get())); })) return;
    for (int i = 0; i < kMaxFrames && state_->running; ++i) {
        if (!poll()) return;
        if (state_->running && (!waitFrame() || !begin() || !end({}))) return;
    }
}

bool Headset::lost() const { return state_->lost; }
bool Headset::wantsFrames() const { return state_->running; }
bool Headset::plays() const { return state_->state == XR_SESSION_STATE_FOCUSED && state_->worn; }
bool Headset::leaving() const { return state_->state == XR_SESSION_STATE_EXITING; }
void Headset::recentre() { state_->centring = true; }
const Tracking& Headset::tracking() const { return state_->tracking; }
const Properties& Headset::properties() const { return state_->instance.properties; }

Result<GLuint> Headset::acquire(Picture picture) {
    return state_->guard([&] { return state_->picture(picture).acquire(); });
}

Status Headset::release(Picture picture) {
    return state_->guard([&] { state_->picture(picture).release(); });
}

Status Headset::vibrate(int hand, float amplitude, float frequency_Hz) {
    return state_->guard(
        [&] { state_->actions.vibrate(state_->session.get(), hand, amplitude, frequency_Hz); });
}

Result<std::string> activeRuntime() {
    return resultOf([] { return Instance::open(false).runtimeName; });
}

} // namespace shoal::xr
