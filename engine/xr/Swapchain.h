// A swapchain: the images that the runtime shows one after another. Private to this folder.
#pragma once

#include "engine/gl/Objects.h"
#include "engine/xr/OpenXr.h"

namespace shoal::xr {

class Swapchain {
  public:
    Swapchain() = default;
    // Pictures for display-coded values (sRGB's format, written raw), one sample a pixel.
    static Swapchain make(XrSession session, glm::ivec2 size);

    // A framebuffer on the next picture, once the runtime has done with it; release() hands it over.
    GLuint acquire();
    void release();

    XrSwapchain name() const { return handle_.name(); }
    glm::ivec2 size() const { return size_; }

  private:
    Handle<XrSwapchain, xrDestroySwapchain> handle_;
    std::vector<gl::Framebuffer> framebuffers_; // one a picture
    glm::ivec2 size_{0};
    bool acquired_ = false;
};

} // namespace shoal::xr
