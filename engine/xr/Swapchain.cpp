#include "engine/xr/OpenXr.h"

#include <array>

namespace shoal::xr {

Swapchain Swapchain::make(XrSession session, glm::ivec2 size) {
    const auto formats = enumerate(int64_t{0}, [&](uint32_t capacity, uint32_t* count, int64_t* items) {
        SHOAL_XR(xrEnumerateSwapchainFormats(session, capacity, count, items));
    });
    // The picture is display-coded already, and written as it is (GL_FRAMEBUFFER_SRGB stays off): the runtime
    // must know that, and does by the first format. The second is taken for linear by some, for coded by
    // most.
    XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
    for (const int64_t wanted : {int64_t{GL_SRGB8_ALPHA8}, int64_t{GL_RGBA8}})
        if (info.format == 0 && std::find(formats.begin(), formats.end(), wanted) != formats.end())
            info.format = wanted;
    if (info.format == 0)
        throw Failure("the headset's runtime takes no pictures of 8 bits a colour (GL_SRGB8_ALPHA8)");
    info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT;
    info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
    info.width = static_cast<uint32_t>(size.x);
    info.height = static_cast<uint32_t>(size.y);
    Swapchain chain;
    chain.size_ = size;
    SHOAL_XR(xrCreateSwapchain(session, &info, chain.handle_.fresh()));
    const auto images = enumerate(
        XrSwapchainImageOpenGLKHR{XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR},
        [&](uint32_t capacity, uint32_t* count, XrSwapchainImageOpenGLKHR* items) {
            SHOAL_XR(xrEnumerateSwapchainImages(chain.name(), capacity, count,
                                                reinterpret_cast<XrSwapchainImageBaseHeader*>(items)));
        });
    for (const XrSwapchainImageOpenGLKHR& image : images) {
        chain.framebuffers_.push_back(gl::Framebuffer::make());
        glBindFramebuffer(GL_FRAMEBUFFER, chain.framebuffers_.back().name());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, image.image, 0);
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw Failure("the runtime's pictures cannot be drawn into");
    }
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return chain;
}

GLuint Swapchain::acquire() {
    uint32_t index = 0;
    const XrSwapchainImageAcquireInfo acquire{XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO};
    SHOAL_XR(xrAcquireSwapchainImage(name(), &acquire, &index));
    acquired_ = true;
    // Not for ever: a runtime that hangs must not take the window with it.
    constexpr XrDuration kPatience_ns = 2'000'000'000;
    const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, kPatience_ns};
    const XrResult waited = SHOAL_XR(xrWaitSwapchainImage(name(), &wait));
    if (waited == XR_TIMEOUT_EXPIRED || index >= framebuffers_.size())
        throw Failure("the headset's runtime gives no picture to draw into");
    return framebuffers_[index].name();
}

void Swapchain::release() {
    if (!std::exchange(acquired_, false)) return;
    const XrSwapchainImageReleaseInfo info{XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO};
    SHOAL_XR(xrReleaseSwapchainImage(name(), &info));
}

} // namespace shoal::xr
