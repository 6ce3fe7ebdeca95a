// Private to this folder: OpenXR's calls, handles and types, and the parts of Headset. A call that fails
// throws a Failure, which the functions of Headset turn into an Error.
#pragma once

#include "engine/core/Result.h"
#include "engine/gl/Objects.h"
#include "engine/xr/Headset.h"

#include <epoxy/gl.h>

#define XR_USE_GRAPHICS_API_OPENGL
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include <algorithm>
#include <array>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

// Calls and checks. The error names call and result: "OpenXR: xrCreateSession says XR_ERROR_LIMIT_REACHED".
// Successes with a reservation (XR_SESSION_LOSS_PENDING ...) count as successes.
#define SHOAL_XR(call) ::shoal::xr::check((call), #call)

namespace shoal::xr {

struct Failure : std::exception {
    explicit Failure(std::string reason, bool runtimeLost = false)
        : error{"OpenXR", std::move(reason)}, lost(runtimeLost) {}
    Error error;
    bool lost; // the runtime or headset is gone: all handles are useless, but a new connection may succeed
};

XrResult check(XrResult result, const char* call);
const char* nameOf(XrResult result);

// Returns the value of the work, Done if it has none, or the error. lost: set to true if it is a loss.
template <class Work> auto resultOf(Work&& work, bool* lost = nullptr) {
    constexpr bool kHasValue = !std::is_void_v<decltype(work())>;
    using Outcome = Result<std::conditional_t<kHasValue, decltype(work()), Done>>;
    try {
        if constexpr (kHasValue)
            return Outcome(work());
        else
            return work(), Outcome(Done{});
    } catch (const Failure& failure) {
        if (lost && failure.lost) *lost = true;
        return Outcome(failure.error);
    }
}

// Returns the value that an OpenXR function writes to its last argument. blank: its initial value, with the
// structure's type. of: the arguments before.
template <class Value, class Function, class... Of>
Value written(Value blank, const char* name, Function function, Of... of) {
    check(function(of..., &blank), name);
    return blank;
}

// Returns a function of an extension, which the loader does not export; null if there is none.
template <class Function> Function functionOf(XrInstance instance, const char* name) {
    PFN_xrVoidFunction function = nullptr;
    if (XR_FAILED(xrGetInstanceProcAddr(instance, name, &function))) return nullptr;
    return reinterpret_cast<Function>(function);
}

// Returns the items that an OpenXR function lists, kMax at most. of: its first arguments.
template <class Item, class List, class... Of>
std::vector<Item> enumerate(const Item& blank, const char* name, List list, Of... of) {
    constexpr uint32_t kMax = 4096;
    uint32_t count = 0;
    check(list(of..., 0, &count, nullptr), name);
    std::vector<Item> items(std::min(count, kMax), blank);
    if (items.empty()) return items;
    check(list(of..., static_cast<uint32_t>(items.size()), &count, items.data()), name);
    items.resize(std::min<size_t>(count, items.size()), blank);
    return items;
}

template <auto kDestroy> struct Destroyer {
    template <class Object> void operator()(Object* object) const { kDestroy(object); }
};
// An OpenXR handle, destroyed with the object.
template <class Name, auto kDestroy>
using Handle = std::unique_ptr<std::remove_pointer_t<Name>, Destroyer<kDestroy>>;

constexpr auto kStereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;

// The connection to the runtime, and the headset that it has.
struct Instance {
    Handle<XrInstance, xrDestroyInstance> handle;
    XrSystemId system = XR_NULL_SYSTEM_ID;
    std::string runtimeName;
    std::vector<const char*> enabled; // extensions
    bool sensesWearer = false;        // XR_EXT_user_presence, supported by the headset
    Properties properties;
    XrEnvironmentBlendMode blend = XR_ENVIRONMENT_BLEND_MODE_OPAQUE; // while the room is not shown

    bool uses(std::string_view extension) const {
        return std::ranges::find(enabled, extension) != enabled.end();
    }
    // withHeadset: whether a headset is needed; false only finds out which runtime is active.
    static Instance open(bool withHeadset);
};

using SessionHandle = Handle<XrSession, xrDestroySession>;
SessionHandle createSession(const Instance& instance); // in the current OpenGL context

inline Pose poseFrom(const XrPosef& pose) {
    const auto& [p, q] = std::pair(pose.position, pose.orientation);
    return {{p.x, p.y, p.z}, glm::quat(q.w, q.x, q.y, q.z)};
}

inline XrPosef poseTo(const Pose& pose) {
    const glm::quat& q = pose.orientation;
    return {{q.x, q.y, q.z, q.w}, {pose.position.x, pose.position.y, pose.position.z}};
}

inline bool valid(XrSpaceLocationFlags flags) {
    return (flags & XR_SPACE_LOCATION_POSITION_VALID_BIT) &&
           (flags & XR_SPACE_LOCATION_ORIENTATION_VALID_BIT);
}

// Returns the pose of a space in another, if it is known and believable.
inline std::optional<Pose> poseOf(XrSpace space, XrSpace base, XrTime time) {
    const auto location =
        written(XrSpaceLocation{XR_TYPE_SPACE_LOCATION}, "xrLocateSpace", xrLocateSpace, space, base, time);
    const Pose pose = poseFrom(location.pose);
    return valid(location.locationFlags) && believable(pose) ? std::optional(pose) : std::nullopt;
}

// Input and vibration of controllers: OpenXR's actions, bound for the common controllers.
class Actions {
  public:
    // Extensions for controllers, to be enabled if the runtime has them.
    static std::vector<const char*> extensions();
    Actions(const Instance& instance, XrSession session);

    void locate(XrSession session, XrSpace world, XrTime time, std::array<Controller, 2>& out) const;
    // Vibrates until the next call, but for a tenth of a second at most. amplitude: 0 to 1; 0 stops.
    void vibrate(XrSession session, int hand, float amplitude, float frequency_Hz) const;

  private:
    Handle<XrActionSet, xrDestroyActionSet> set_;
    XrAction grip_{}, squeeze_{}, trigger_{}, menu_{}, haptic_{}; // owned by the set
    std::array<XrPath, 2> hands_{};
    std::array<Handle<XrSpace, xrDestroySpace>, 2> gripSpaces_;
};

} // namespace shoal::xr
