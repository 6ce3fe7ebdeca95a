#include "engine/xr/Headset.h"

#include "engine/xr/OpenXr.h"
#include "engine/xr/Tracked.h"

namespace shoal::xr {

namespace {

using Space = Handle<XrSpace, xrDestroySpace>;

Space makeSpace(XrSession session, const Pose& localFromOrigin) {
    const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr,
                                          XR_REFERENCE_SPACE_TYPE_LOCAL, poseTo(localFromOrigin)};
    Space space;
    SHOAL_XR(xrCreateReferenceSpace(session, &info, space.fresh()));
    return space;
}

} // namespace

struct Headset::State {
    // In this order: what is made from another dies before it.
    Instance instance;
    SessionHandle session;
    Space local, world;
    HandTrackers hands;
    Actions actions;
    std::array<Swapchain, 3> pictures; // by Picture
    PFN_xrGetVisibilityMaskKHR getMask = nullptr;

    XrSessionState state = XR_SESSION_STATE_UNKNOWN;
    bool running = false; // between xrBeginSession and xrEndSession
    bool masksChanged = true, centring = true;
    Frame frame;
    Tracking tracking;

    void enter(XrSessionState next);
    void locateEyes();
    Swapchain& picture(Picture p) { return pictures[static_cast<size_t>(p)]; }
};

Result<Headset> Headset::open(glm::ivec2 panelSize) {
    auto state = std::make_unique<State>();
    State& s = *state;
    Status opened = statusOf([&] {
        s.instance = Instance::open(true);
        s.session = createSession(s.instance);
        const XrSession session = s.session.name();
        const XrInstance instance = s.instance.handle.name();
        s.local = makeSpace(session, {});
        s.world = makeSpace(session, {});
        s.hands = HandTrackers::make(s.instance, session);
        s.actions = Actions::make(instance, session);
        for (const Picture p : {Picture::LeftEye, Picture::RightEye, Picture::Panel})
            s.picture(p) = Swapchain::make(session, p == Picture::Panel ? panelSize : s.instance.eyeSize);
        if (s.instance.hiddenPixels)
            s.getMask = functionOf<PFN_xrGetVisibilityMaskKHR>(instance, "xrGetVisibilityMaskKHR");
    });
    if (!opened) return opened.error();
    return Headset(std::move(state));
}

Status Headset::poll() {
    return statusOf([&] {
        for (;;) {
            XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
            if (SHOAL_XR(xrPollEvent(state_->instance.handle.name(), &event)) == XR_EVENT_UNAVAILABLE) return;
            switch (event.type) {
            case XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED:
                state_->enter(reinterpret_cast<XrEventDataSessionStateChanged&>(event).state);
                break;
            case XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING:
                throw Failure("the headset's runtime is going away");
            case XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR:
                state_->masksChanged = true;
                break;
            case XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING: // the player has pressed "recentre"
                state_->centring = true;
                break;
            default:
                break;
            }
        }
    });
}

void Headset::State::enter(XrSessionState next) {
    state = next;
    if (state == XR_SESSION_STATE_READY) {
        const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, kStereo};
        SHOAL_XR(xrBeginSession(session.name(), &info));
        running = true;
    } else if (state == XR_SESSION_STATE_STOPPING) {
        running = false;
        SHOAL_XR(xrEndSession(session.name()));
    } else if (state == XR_SESSION_STATE_LOSS_PENDING) {
        throw Failure("the headset was lost; is its cable in place?");
    }
}

Result<Frame> Headset::waitFrame() {
    State& s = *state_;
    Status waited = statusOf([&] {
        const XrFrameWaitInfo wait{XR_TYPE_FRAME_WAIT_INFO};
        XrFrameState next{XR_TYPE_FRAME_STATE};
        SHOAL_XR(xrWaitFrame(s.session.name(), &wait, &next));
        s.frame.display_ns = next.predictedDisplayTime;
        s.frame.period_s = static_cast<double>(next.predictedDisplayPeriod) * 1e-9;
        s.frame.drawn = next.shouldRender == XR_TRUE;
        s.locateEyes();
        s.hands.locate(s.world.name(), s.frame.display_ns, s.tracking.hands);
        s.actions.locate(s.session.name(), s.world.name(), s.frame.display_ns, s.tracking.controllers);
    });
    if (!waited) return waited.error();
    return s.frame;
}

void Headset::State::locateEyes() {
    std::array<Eye, 2> eyes;
    const auto locate = [&](const Space& space) { // whether the head is tracked
        const XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO, nullptr, kStereo, frame.display_ns,
                                    space.name()};
        XrViewState viewState{XR_TYPE_VIEW_STATE};
        std::array<XrView, 2> views{XrView{XR_TYPE_VIEW}, XrView{XR_TYPE_VIEW}};
        uint32_t count = 0;
        SHOAL_XR(xrLocateViews(session.name(), &info, &viewState, static_cast<uint32_t>(views.size()), &count,
                               views.data()));
        const XrViewStateFlags flags = viewState.viewStateFlags;
        bool tracked = count == 2 && (flags & XR_VIEW_STATE_POSITION_VALID_BIT) &&
                       (flags & XR_VIEW_STATE_ORIENTATION_VALID_BIT) &&
                       (flags & XR_VIEW_STATE_ORIENTATION_TRACKED_BIT) &&
                       // A headset that only turns has no position to lose.
                       (!instance.tracksPosition || (flags & XR_VIEW_STATE_POSITION_TRACKED_BIT));
        for (size_t i = 0; i < 2; ++i) {
            const XrFovf& fov = views[i].fov;
            eyes[i] = {poseFrom(views[i].pose), {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown}};
            tracked = tracked && believable(eyes[i].worldFromEye) && believable(eyes[i].fov);
        }
        return tracked;
    };
    const auto middle = [&] { return between(eyes[0].worldFromEye, eyes[1].worldFromEye, 0.5f); };
    if (centring && locate(local)) {
        world = makeSpace(session.name(), originAt(middle()));
        centring = false;
    }
    tracking.headTracked = locate(world);
    if (!tracking.headTracked) return;
    tracking.eyes = eyes;
    tracking.worldFromHead = middle();
}

Status Headset::begin() {
    const XrFrameBeginInfo info{XR_TYPE_FRAME_BEGIN_INFO};
    // XR_FRAME_DISCARDED is a success.
    return statusOf([&] { SHOAL_XR(xrBeginFrame(state_->session.name(), &info)); });
}

Status Headset::end(const Shown& shown) {
    State& s = *state_;
    std::array<XrCompositionLayerProjectionView, 2> views;
    for (size_t i = 0; i < 2; ++i) {
        const Eye& eye = s.tracking.eyes[i];
        views[i] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW,
                    nullptr,
                    poseTo(eye.worldFromEye),
                    {eye.fov.left, eye.fov.right, eye.fov.up, eye.fov.down},
                    {s.pictures[i].name(), {{0, 0}, {shown.eyeSize.x, shown.eyeSize.y}}, 0}};
    }
    const XrCompositionLayerProjection projection{
        XR_TYPE_COMPOSITION_LAYER_PROJECTION, nullptr, 0, s.world.name(), 2, views.data()};
    Swapchain& text = s.picture(Picture::Panel);
    const XrCompositionLayerQuad panel{XR_TYPE_COMPOSITION_LAYER_QUAD,
                                       nullptr,
                                       XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT,
                                       s.world.name(),
                                       XR_EYE_VISIBILITY_BOTH,
                                       {text.name(), {{0, 0}, {text.size().x, text.size().y}}, 0},
                                       poseTo(shown.worldFromPanel),
                                       {shown.panelSize_m.x, shown.panelSize_m.y}};
    std::array<const XrCompositionLayerBaseHeader*, 2> layers{};
    uint32_t count = 0;
    if (shown.eyes) layers[count++] = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&projection);
    if (shown.panel) layers[count++] = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&panel);
    const XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO, nullptr, s.frame.display_ns,
                              s.instance.blend,       count,   count ? layers.data() : nullptr};
    return statusOf([&] { SHOAL_XR(xrEndFrame(s.session.name(), &info)); });
}

Headset::Headset(std::unique_ptr<State> state) : state_(std::move(state)) {}
Headset::Headset(Headset&&) noexcept = default;

// As the runtime wants it: empty frames until it says that the session may end. Whatever fails ends it too.
Headset::~Headset() {
    if (!state_ || !state_->running) return;
    constexpr int kMaxFrames = 120;
    for (int hand = 0; hand < 2; ++hand) (void)vibrate(hand, 0, 0);
    if (!statusOf([&] { SHOAL_XR(xrRequestExitSession(state_->session.name())); })) return;
    for (int i = 0; i < kMaxFrames && state_->running; ++i) {
        if (!poll()) return;
        if (state_->running && (!waitFrame() || !begin() || !end({}))) return;
    }
}

bool Headset::wantsFrames() const { return state_->running; }
bool Headset::plays() const { return state_->state == XR_SESSION_STATE_FOCUSED; }
bool Headset::leaving() const { return state_->state == XR_SESSION_STATE_EXITING; }
bool Headset::takeMasksChanged() { return std::exchange(state_->masksChanged, false); }
void Headset::recentre() { state_->centring = true; }
const Tracking& Headset::tracking() const { return state_->tracking; }

Result<GLuint> Headset::acquire(Picture picture) {
    GLuint framebuffer = 0;
    Status acquired = statusOf([&] { framebuffer = state_->picture(picture).acquire(); });
    return acquired ? Result<GLuint>(framebuffer) : acquired.error();
}

Status Headset::release(Picture picture) {
    return statusOf([&] { state_->picture(picture).release(); });
}

Result<std::vector<glm::vec2>> Headset::hiddenArea(int eye) const {
    std::vector<glm::vec2> corners;
    if (!state_->getMask) return corners;
    const auto get = [&](XrVisibilityMaskKHR& mask) {
        return statusOf([&] {
            check(state_->getMask(state_->session.name(), kStereo, static_cast<uint32_t>(eye),
                                  XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR, &mask),
                  "xrGetVisibilityMaskKHR");
        });
    };
    XrVisibilityMaskKHR mask{XR_TYPE_VISIBILITY_MASK_KHR};
    if (Status s = get(mask); !s) return s.error();
    constexpr uint32_t kMax = 1u << 16;
    if (mask.vertexCountOutput == 0 || mask.vertexCountOutput > kMax || mask.indexCountOutput > kMax)
        return corners;
    std::vector<XrVector2f> vertices(mask.vertexCountOutput);
    std::vector<uint32_t> indices(mask.indexCountOutput);
    mask.vertexCapacityInput = mask.vertexCountOutput;
    mask.indexCapacityInput = mask.indexCountOutput;
    mask.vertices = vertices.data();
    mask.indices = indices.data();
    if (Status s = get(mask); !s) return s.error();
    indices.resize(std::min<size_t>(indices.size(), mask.indexCountOutput) / 3 * 3);
    for (const uint32_t index : indices) {
        if (index >= vertices.size()) return std::vector<glm::vec2>{}; // broken: draw everything
        corners.emplace_back(vertices[index].x, vertices[index].y);
    }
    return corners;
}

Status Headset::vibrate(int hand, float amplitude, float frequency_Hz) {
    return statusOf([&] { state_->actions.vibrate(state_->session.name(), hand, amplitude, frequency_Hz); });
}

glm::ivec2 Headset::eyeSize() const { return state_->instance.eyeSize; }
bool Headset::bareHands() const { return state_->instance.bareHands; }
std::string Headset::name() const {
    return state_->instance.systemName + " (" + state_->instance.runtimeName + ")";
}

Result<std::string> activeRuntime() {
    std::string name;
    Status opened = statusOf([&] { name = Instance::open(false).runtimeName; });
    return opened ? Result<std::string>(name) : opened.error();
}

} // namespace shoal::xr
