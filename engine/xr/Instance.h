// The connection to the runtime, and the headset that it has. Only for the sources of this folder.
#pragma once

#include "engine/xr/Call.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace shoal::xr {

// An OpenXR handle, destroyed at the end.
template <class Name, XrResult(XRAPI_PTR* kDestroy)(Name)> class Handle {
  public:
    Handle() = default;
    explicit Handle(Name name) : name_(name) {}
    Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, Name{})) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~Handle() {
        if (name_ != Name{}) kDestroy(name_);
    }
    Name name() const { return name_; }
    // To be filled by a function that creates; what was there is destroyed.
    Name* fresh() {
        *this = Handle();
        return &name_;
    }

  private:
    Name name_{};
};

struct Instance {
    Handle<XrInstance, xrDestroyInstance> handle;
    XrSystemId system = XR_NULL_SYSTEM_ID;
    std::string runtimeName, systemName;
    bool bareHands = false;     // XR_EXT_hand_tracking, and the headset can
    bool hiddenPixels = false;  // XR_KHR_visibility_mask
    bool tracksPosition = true; // else the head only turns
    glm::ivec2 eyeSize{0};      // as the runtime recommends, pixels
    XrEnvironmentBlendMode blend = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;

    // withHeadset: false only asks which runtime there is.
    static Result<Instance> open(bool withHeadset);
};

// Items of an enumeration of OpenXR's kind, asked for twice: call(capacity, count, items). No runtime makes
// us take more than kMost.
template <class Item, class Call> Result<std::vector<Item>> enumerate(const Item& blank, Call&& call) {
    constexpr uint32_t kMost = 4096;
    uint32_t count = 0;
    if (Status asked = call(0u, &count, static_cast<Item*>(nullptr)); !asked) return asked.error();
    std::vector<Item> items(std::min(count, kMost), blank);
    if (items.empty()) return items;
    if (Status given = call(static_cast<uint32_t>(items.size()), &count, items.data()); !given)
        return given.error();
    items.resize(std::min<size_t>(count, items.size()), blank);
    return items;
}

} // namespace shoal::xr
