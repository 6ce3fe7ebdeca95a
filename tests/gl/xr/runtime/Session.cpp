// The session's life, its spaces, swapchains and frames.
#include "tests/gl/xr/runtime/State.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shoal::test {

Session& session() {
    static Session one;
    return one;
}

Place localFromSpace(XrSpace space) {
    const FakeSpace& of = objectOf<FakeSpace>(space);
    if (of.hand < 0) return placeOf(shoalFakeRuntime().referenceSpaces.at(of.type)) * of.offset;
    return placeOf(shoalFakeRuntime().controllers[static_cast<size_t>(of.hand)].grip) * of.offset;
}

namespace {

FAKE_XR(xrCreateSession, XrInstance, const XrSessionCreateInfo* info, XrSession* out) {
    FakeRuntime& fake = shoalFakeRuntime();
    if (!fake.called.contains("xrGetOpenGLGraphicsRequirementsKHR"))
        return XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING;
    const auto* binding = static_cast<const XrBaseInStructure*>(info->next);
    if (!binding || binding->type != XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR)
        return XR_ERROR_GRAPHICS_DEVICE_INVALID;
    ++fake.sessions;
    fake.events.clear(); // of a session before
    session() = {};
    *out = handleOf<XrSession>(&session());
    fake.say(XR_SESSION_STATE_IDLE);
    fake.say(XR_SESSION_STATE_READY);
    return XR_SUCCESS;
}
FAKE_XR(xrDestroySession, XrSession) {
    --shoalFakeRuntime().sessions;
    shoalFakeRuntime().running = false;
    return XR_SUCCESS;
}
FAKE_XR(xrBeginSession, XrSession, const XrSessionBeginInfo*) {
    FakeRuntime& fake = shoalFakeRuntime();
    if (fake.running) return XR_ERROR_SESSION_RUNNING;
    if (fake.state != XR_SESSION_STATE_READY) return XR_ERROR_SESSION_NOT_READY;
    fake.running = true;
    fake.say(XR_SESSION_STATE_SYNCHRONIZED);
    if (fake.enabled.contains(XR_EXT_USER_PRESENCE_EXTENSION_NAME) && fake.sensesWearer) fake.sayWorn(true);
    return XR_SUCCESS;
}
FAKE_XR(xrEndSession, XrSession) {
    FakeRuntime& fake = shoalFakeRuntime();
    if (!fake.running) return XR_ERROR_SESSION_NOT_RUNNING;
    if (fake.state != XR_SESSION_STATE_STOPPING) return XR_ERROR_SESSION_NOT_STOPPING;
    fake.running = false;
    fake.say(XR_SESSION_STATE_IDLE);
    if (fake.exitRequested) fake.say(XR_SESSION_STATE_EXITING);
    return XR_SUCCESS;
}
FAKE_XR(xrRequestExitSession, XrSession) {
    FakeRuntime& fake = shoalFakeRuntime();
    if (!fake.running) return XR_ERROR_SESSION_NOT_RUNNING;
    fake.sayExit();
    return XR_SUCCESS;
}

// Returns the reference spaces on offer; those of an extension only if it is enabled.
std::vector<XrReferenceSpaceType> referenceSpaces() {
    const FakeRuntime& fake = shoalFakeRuntime();
    std::vector<XrReferenceSpaceType> offered;
    for (const auto& [type, pose] : fake.referenceSpaces)
        if (type != XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT ||
            fake.enabled.contains(XR_EXT_LOCAL_FLOOR_EXTENSION_NAME))
            offered.push_back(type);
    return offered;
}

FAKE_XR(xrEnumerateReferenceSpaces, XrSession, uint32_t capacity, uint32_t* count,
        XrReferenceSpaceType* items) {
    return giveList(referenceSpaces(), capacity, count, items);
}
FAKE_XR(xrCreateReferenceSpace, XrSession, const XrReferenceSpaceCreateInfo* info, XrSpace* out) {
    const auto offered = referenceSpaces();
    if (std::ranges::find(offered, info->referenceSpaceType) == offered.end())
        return XR_ERROR_REFERENCE_SPACE_UNSUPPORTED;
    const XrQuaternionf& q = info->poseInReferenceSpace.orientation;
    if (std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) > 0.01f) return XR_ERROR_POSE_INVALID;
    ++shoalFakeRuntime().spaces;
    *out =
        handleOf<XrSpace>(new FakeSpace{-1, info->referenceSpaceType, placeOf(info->poseInReferenceSpace)});
    return XR_SUCCESS;
}
FAKE_XR(xrDestroySpace, XrSpace space) {
    --shoalFakeRuntime().spaces;
    delete &objectOf<FakeSpace>(space);
    return XR_SUCCESS;
}
FAKE_XR(xrLocateSpace, XrSpace space, XrSpace base, XrTime, XrSpaceLocation* out) {
    out->pose = poseOf(inverse(localFromSpace(base)) * localFromSpace(space));
    const FakeSpace& of = objectOf<FakeSpace>(space);
    const bool local = of.hand < 0 && of.type == XR_REFERENCE_SPACE_TYPE_LOCAL;
    out->locationFlags = of.hand >= 0 || local ? 0xf : shoalFakeRuntime().spaceFlags;
    return XR_SUCCESS;
}

FAKE_XR(xrEnumerateSwapchainFormats, XrSession, uint32_t capacity, uint32_t* count, int64_t* items) {
    return giveList(shoalFakeRuntime().formats, capacity, count, items);
}
FAKE_XR(xrCreateSwapchain, XrSession, const XrSwapchainCreateInfo* info, XrSwapchain* out) {
    const auto& formats = shoalFakeRuntime().formats;
    if (std::find(formats.begin(), formats.end(), info->format) == formats.end())
        return XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED;
    const bool depth = info->format == GL_DEPTH_COMPONENT24 || info->format == GL_DEPTH_COMPONENT32F;
    if (depth != ((info->usageFlags & XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT) != 0))
        return XR_ERROR_VALIDATION_FAILURE;
    auto* chain = new FakeSwapchain{{}, info->width, info->height, depth};
    GLint bound = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    chain->textures.resize(3);
    glGenTextures(3, chain->textures.data());
    for (const GLuint texture : chain->textures) {
        glBindTexture(GL_TEXTURE_2D, texture);
        glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(info->format), static_cast<GLsizei>(info->width),
                     static_cast<GLsizei>(info->height), 0, depth ? GL_DEPTH_COMPONENT : GL_RGBA,
                     depth ? GL_FLOAT : GL_UNSIGNED_BYTE, nullptr);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    }
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
    ++shoalFakeRuntime().swapchains;
    *out = handleOf<XrSwapchain>(chain);
    return XR_SUCCESS;
}
// Returns whether OpenGL still draws: a real runtime may free its images' memory although it does.
bool stillDraws() {
    const GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    GLint state = 0;
    glGetSynciv(fence, GL_SYNC_STATUS, 1, nullptr, &state);
    glDeleteSync(fence);
    return state != GL_SIGNALED;
}
FAKE_XR(xrDestroySwapchain, XrSwapchain swapchain) {
    if (stillDraws()) shoalFakeRuntime().complain("xrDestroySwapchain: OpenGL still draws");
    FakeSwapchain* chain = &objectOf<FakeSwapchain>(swapchain);
    glDeleteTextures(static_cast<GLsizei>(chain->textures.size()), chain->textures.data());
    --shoalFakeRuntime().swapchains;
    delete chain;
    return XR_SUCCESS;
}
FAKE_XR(xrEnumerateSwapchainImages, XrSwapchain swapchain, uint32_t capacity, uint32_t* count,
        XrSwapchainImageBaseHeader* items) {
    const auto& textures = objectOf<FakeSwapchain>(swapchain).textures;
    *count = static_cast<uint32_t>(textures.size());
    auto* images = reinterpret_cast<XrSwapchainImageOpenGLKHR*>(items);
    for (uint32_t i = 0; i < capacity && i < textures.size(); ++i) {
        if (images[i].type != XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR)
            shoalFakeRuntime().complain("xrEnumerateSwapchainImages: no type");
        images[i].image = textures[i];
    }
    return XR_SUCCESS;
}
FAKE_XR(xrAcquireSwapchainImage, XrSwapchain swapchain, const XrSwapchainImageAcquireInfo*, uint32_t* index) {
    FakeSwapchain& chain = objectOf<FakeSwapchain>(swapchain);
    if (chain.acquired >= 0) shoalFakeRuntime().complain("xrAcquireSwapchainImage: one is out already");
    *index = chain.next;
    chain.acquired = static_cast<int>(chain.next);
    chain.next = (chain.next + 1) % static_cast<uint32_t>(chain.textures.size());
    chain.waited = false;
    return XR_SUCCESS;
}
FAKE_XR(xrWaitSwapchainImage, XrSwapchain swapchain, const XrSwapchainImageWaitInfo*) {
    FakeSwapchain& chain = objectOf<FakeSwapchain>(swapchain);
    if (chain.acquired < 0) return XR_ERROR_CALL_ORDER_INVALID;
    chain.waited = true;
    return XR_SUCCESS;
}
FAKE_XR(xrReleaseSwapchainImage, XrSwapchain swapchain, const XrSwapchainImageReleaseInfo*) {
    FakeSwapchain& chain = objectOf<FakeSwapchain>(swapchain);
    if (chain.acquired < 0 || !chain.waited) return XR_ERROR_CALL_ORDER_INVALID;
    chain.lastReleased = std::exchange(chain.acquired, -1);
    return XR_SUCCESS;
}

FAKE_XR(xrWaitFrame, XrSession, const XrFrameWaitInfo*, XrFrameState* out) {
    FakeRuntime& fake = shoalFakeRuntime();
    if (!fake.running) return XR_ERROR_SESSION_NOT_RUNNING;
    if (session().phase != FramePhase::Idle) fake.complain("xrWaitFrame: the frame before has not ended");
    session().phase = FramePhase::Waited;
    session().now += static_cast<XrTime>(std::llround(fake.period_s * 1e9));
    ++fake.framesWaited;
    out->predictedDisplayTime = session().now;
    out->predictedDisplayPeriod = static_cast<XrDuration>(std::llround(fake.period_s * 1e9));
    const bool seen = fake.state == XR_SESSION_STATE_VISIBLE || fake.state == XR_SESSION_STATE_FOCUSED;
    out->shouldRender = seen && fake.shouldRender;
    return XR_SUCCESS;
}
FAKE_XR(xrBeginFrame, XrSession, const XrFrameBeginInfo*) {
    if (session().phase != FramePhase::Waited) return XR_ERROR_CALL_ORDER_INVALID;
    session().phase = FramePhase::Begun;
    return XR_SUCCESS;
}

// Reads a part of the image released last; `read` reads from the bound framebuffer.
template <class Read> void readPart(const XrSwapchainSubImage& sub, Read&& read) {
    const FakeSwapchain& chain = objectOf<FakeSwapchain>(sub.swapchain);
    const XrRect2Di& rect = sub.imageRect;
    FakeRuntime& fake = shoalFakeRuntime();
    if (chain.lastReleased < 0 || chain.acquired >= 0)
        fake.complain("xrEndFrame: a picture was not released");
    if (rect.offset.x < 0 || rect.offset.y < 0 || rect.extent.width <= 0 || rect.extent.height <= 0 ||
        rect.offset.x + rect.extent.width > static_cast<int>(chain.width) ||
        rect.offset.y + rect.extent.height > static_cast<int>(chain.height))
        return fake.complain("xrEndFrame: a rectangle beyond its picture");
    if (!fake.keepPictures || chain.lastReleased < 0) return;
    GLint before = 0;
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
    GLuint framebuffer = 0;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    if (chain.depth) glReadBuffer(GL_NONE);
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, chain.depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0,
                           GL_TEXTURE_2D, chain.textures[static_cast<size_t>(chain.lastReleased)], 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    read(rect.offset, rect.extent);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before));
    glDeleteFramebuffers(1, &framebuffer);
}

std::vector<uint8_t> rgbaOf(const XrSwapchainSubImage& sub) {
    std::vector<uint8_t> rgba;
    readPart(sub, [&](XrOffset2Di at, XrExtent2Di size) {
        rgba.resize(static_cast<size_t>(size.width * size.height) * 4);
        glReadPixels(at.x, at.y, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    });
    return rgba;
}

std::optional<ShownDepth> depthOf(const XrCompositionLayerProjectionView& view) {
    const auto* info = static_cast<const XrCompositionLayerDepthInfoKHR*>(view.next);
    if (!info) return std::nullopt;
    FakeRuntime& fake = shoalFakeRuntime();
    if (info->type != XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR ||
        !fake.enabled.contains(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME) ||
        !objectOf<FakeSwapchain>(info->subImage.swapchain).depth ||
        !(info->minDepth >= 0 && info->minDepth < info->maxDepth && info->maxDepth <= 1) ||
        !(info->nearZ > 0 && info->farZ > 0) || info->nearZ == info->farZ)
        fake.complain("xrEndFrame: a depth that the specification forbids");
    ShownDepth depth{info->minDepth, info->maxDepth, info->nearZ, info->farZ, info->subImage.imageRect, {}};
    readPart(info->subImage, [&](XrOffset2Di at, XrExtent2Di size) {
        depth.values.resize(static_cast<size_t>(size.width * size.height));
        glReadPixels(at.x, at.y, size.width, size.height, GL_DEPTH_COMPONENT, GL_FLOAT, depth.values.data());
    });
    return depth;
}

FAKE_XR(xrEndFrame, XrSession, const XrFrameEndInfo* info) {
    FakeRuntime& fake = shoalFakeRuntime();
    if (session().phase != FramePhase::Begun) return XR_ERROR_CALL_ORDER_INVALID;
    session().phase = FramePhase::Idle;
    if (info->displayTime != session().now) fake.complain("xrEndFrame: another time than xrWaitFrame gave");
    if (std::ranges::find(fake.blendModes, info->environmentBlendMode) == fake.blendModes.end())
        fake.complain("xrEndFrame: a blend mode that was not offered");
    if (info->environmentBlendMode == XR_ENVIRONMENT_BLEND_MODE_ADDITIVE)
        fake.complain("xrEndFrame: not opaque though it could be");
    fake.last = {.display = info->displayTime, .blend = info->environmentBlendMode};
    for (uint32_t i = 0; i < info->layerCount; ++i) {
        const XrCompositionLayerBaseHeader* layer = info->layers[i];
        const Place localFromLayer = localFromSpace(layer->space);
        if (layer->type == XR_TYPE_COMPOSITION_LAYER_PROJECTION) {
            const auto& projection = reinterpret_cast<const XrCompositionLayerProjection&>(*layer);
            if (projection.viewCount != 2) return XR_ERROR_VALIDATION_FAILURE;
            fake.last.eyesFlags = projection.layerFlags;
            fake.last.eyes.emplace();
            for (size_t eye = 0; eye < 2; ++eye) {
                const XrCompositionLayerProjectionView& view = projection.views[eye];
                (*fake.last.eyes)[eye] = {poseOf(localFromLayer * placeOf(view.pose)), view.fov,
                                          view.subImage.imageRect, rgbaOf(view.subImage), depthOf(view)};
            }
            ++fake.framesWithEyes;
        } else if (layer->type == XR_TYPE_COMPOSITION_LAYER_QUAD) {
            const auto& quad = reinterpret_cast<const XrCompositionLayerQuad&>(*layer);
            fake.last.panel = ShownPanel{poseOf(localFromLayer * placeOf(quad.pose)), quad.size,
                                         quad.subImage.imageRect, rgbaOf(quad.subImage)};
        } else {
            fake.complain("xrEndFrame: a layer of unknown type");
        }
    }
    ++fake.framesEnded;
    if (!std::exchange(session().shown, true) && fake.state == XR_SESSION_STATE_SYNCHRONIZED) {
        fake.say(XR_SESSION_STATE_VISIBLE);
        fake.say(XR_SESSION_STATE_FOCUSED);
    }
    return XR_SUCCESS;
}

FAKE_XR(xrLocateViews, XrSession, const XrViewLocateInfo* info, XrViewState* state, uint32_t capacity,
        uint32_t* count, XrView* out) {
    *count = 2;
    if (capacity < 2) return capacity == 0 ? XR_SUCCESS : XR_ERROR_SIZE_INSUFFICIENT;
    if (info->displayTime != session().now) shoalFakeRuntime().complain("xrLocateViews: another time");
    state->viewStateFlags = shoalFakeRuntime().viewFlags;
    const Place spaceFromLocal = inverse(localFromSpace(info->space));
    for (size_t eye = 0; eye < 2; ++eye) {
        if (out[eye].type != XR_TYPE_VIEW) shoalFakeRuntime().complain("xrLocateViews: no type");
        out[eye].pose = poseOf(spaceFromLocal * placeOf(shoalFakeRuntime().views[eye].pose));
        out[eye].fov = shoalFakeRuntime().views[eye].fov;
    }
    return XR_SUCCESS;
}

FAKE_XR(xrEnumerateDisplayRefreshRatesFB, XrSession, uint32_t capacity, uint32_t* count, float* items) {
    return giveList(shoalFakeRuntime().refreshRates_Hz, capacity, count, items);
}
FAKE_XR(xrRequestDisplayRefreshRateFB, XrSession, float wanted_Hz) {
    FakeRuntime& fake = shoalFakeRuntime();
    if (std::ranges::find(fake.refreshRates_Hz, wanted_Hz) == fake.refreshRates_Hz.end())
        return XR_ERROR_DISPLAY_REFRESH_RATE_UNSUPPORTED_FB;
    fake.say(XrEventDataDisplayRefreshRateChangedFB{XR_TYPE_EVENT_DATA_DISPLAY_REFRESH_RATE_CHANGED_FB,
                                                    nullptr, std::exchange(fake.refreshRate_Hz, wanted_Hz),
                                                    wanted_Hz});
    return XR_SUCCESS;
}

} // namespace

} // namespace shoal::test
