// Objects of the fake runtime. A handle is the address of one of these.
#pragma once

#include "engine/xr/Tracked.h"
#include "tests/gl/xr/runtime/FakeRuntime.h"

namespace shoal::test {

// Conversions of the runtime's own: a mistake in those of engine/xr would undo itself.
using Place = xr::Pose;
Place placeOf(const XrPosef& pose);
XrPosef poseOf(const Place& place);

struct FakeSpace {
    int hand = -1; // hand of an action space; -1 for a reference space
    XrReferenceSpaceType type = XR_REFERENCE_SPACE_TYPE_LOCAL;
    Place offset; // parentFromSpace
};

struct FakeSwapchain {
    std::vector<GLuint> textures;
    uint32_t width = 0, height = 0;
    bool depth = false; // true: depth swapchain; false: colour
    uint32_t next = 0;
    int acquired = -1, lastReleased = -1;
    bool waited = false;
};

struct FakeAction {
    XrActionType type;
    std::string name;
};

enum class FramePhase { Idle, Waited, Begun };

struct Session {
    FramePhase phase = FramePhase::Idle;
    bool shown = false; // a frame was submitted
    XrTime now = 1'000'000'000;
    bool attached = false;
};

Session& session();
std::vector<std::string>& pathTexts(); // XrPath p is entry p - 1

// Returns the current pose of a space in LOCAL's frame.
Place localFromSpace(XrSpace space);

template <class Handle, class Object> Handle handleOf(Object* object) {
    return reinterpret_cast<Handle>(object);
}
template <class Object, class Handle> Object& objectOf(Handle handle) {
    return *reinterpret_cast<Object*>(handle);
}

// The runtime's functions by name.
std::map<std::string, PFN_xrVoidFunction>& functions();

// A function as the loader calls it: records the call, and returns an error if the test asks for it.
template <auto kFunction> struct Called;
template <class... Arguments, XrResult (*kFunction)(Arguments...)> struct Called<kFunction> {
    static inline const char* name = nullptr;
    static XrResult call(Arguments... arguments) {
        FakeRuntime& fake = shoalFakeRuntime();
        if (name == std::string("xrWaitFrame") && fake.onWait) fake.onWait(fake);
        if (name == std::string("xrCreateInstance") && fake.onCreate) fake.onCreate(fake);
        fake.called.insert(name);
        const auto told = fake.failing.find(name);
        return told != fake.failing.end() ? told->second : kFunction(arguments...);
    }
    static bool give(const char* as) {
        return functions().emplace(name = as, reinterpret_cast<PFN_xrVoidFunction>(call)).second;
    }
};

// Implements OpenXR's two-call idiom for plain items.
template <class Item, class From>
XrResult giveList(const From& from, uint32_t capacity, uint32_t* count, Item* items) {
    *count = static_cast<uint32_t>(from.size());
    if (capacity == 0) return XR_SUCCESS;
    if (capacity < from.size()) return XR_ERROR_SIZE_INSUFFICIENT;
    size_t i = 0;
    for (const auto& item : from) items[i++] = item;
    return XR_SUCCESS;
}

} // namespace shoal::test

// Defines a function of the runtime, and gives it to the loader by its name.
#define FAKE_XR(function, ...)                                                                               \
    XrResult function(__VA_ARGS__);                                                                          \
    [[maybe_unused]] const bool function##Given = Called<&function>::give(#function);                        \
    XrResult function(__VA_ARGS__)
