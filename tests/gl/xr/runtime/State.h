// Objects of the fake runtime. A handle is the address of one of these.
#pragma once

#include "tests/gl/xr/runtime/FakeRuntime.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <memory>

namespace shoal::test {

struct Place {
    glm::vec3 position{0};
    glm::quat turn{1, 0, 0, 0};
};
Place placeOf(const XrPosef& pose);
XrPosef poseOf(const Place& place);
Place operator*(const Place& a, const Place& b);
Place inverse(const Place& place);

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

// Return the function of that name, or null if the runtime has none.
PFN_xrVoidFunction instanceFunction(const std::string& name);
PFN_xrVoidFunction sessionFunction(const std::string& name);
PFN_xrVoidFunction inputFunction(const std::string& name);
#define GIVE(function)                                                                                       \
    if (name == #function) return reinterpret_cast<PFN_xrVoidFunction>(function)

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

// Starts every function: records the call, and returns an error if the test asks for it.
#define FAKE_XR(name)                                                                                        \
    shoalFakeRuntime().called.insert(#name);                                                                 \
    if (const auto told = shoalFakeRuntime().failing.find(#name); told != shoalFakeRuntime().failing.end())  \
    return told->second
