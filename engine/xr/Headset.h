// A headset driven through OpenXR: session, frames, poses of head, hands and controllers, pictures to show.
// The runtime corrects the lenses' distortion. World frame: the dive's; its origin is the position of the
// eyes when it was last centred.
#pragma once

#include "engine/core/Result.h"
#include "engine/xr/Tracked.h"

#include <epoxy/gl.h>
#include <glm/vec2.hpp>

#include <memory>
#include <optional>
#include <string>

namespace shoal::xr {

// Pictures that the runtime shows. Depth pictures belong to the eyes' pictures; not every headset takes them.
enum class Picture { LeftEye, RightEye, Panel, LeftDepth, RightDepth };

// Distances of a frustum's planes, metres.
struct Planes {
    float near_m = 0, far_m = 0;
};

struct Frame {
    int64_t display_ns = 0; // time at which it is shown, by the runtime's clock
    double period_s = 0;    // time from one frame to the next
    bool drawn = false;     // whether it is visible and must be drawn
};

struct Properties {
    std::string name;        // names of headset and runtime
    glm::ivec2 eyeSize{0};   // the runtime's recommendation, pixels
    bool seesRoom = false;   // its cameras' picture of the room can be shown behind ours, by our alpha
    bool takesDepth = false; // it corrects pictures by depth between two frames
    bool bareHands = false;  // hands without controllers can be tracked
};

// Choice of pictures that end() shows, among those released since begin().
struct Shown {
    bool eyes = false;
    bool room = false;            // the room shows through the eyes' pictures where their alpha is below 1
    glm::ivec2 eyeSize{0};        // size of the drawn part, from the lower left; at most Properties::eyeSize
    std::optional<Planes> planes; // planes of depth 0 (near) and 1 (far) of the eyes' depths; none if empty
    bool panel = false;           // with premultiplied alpha
    Pose worldFromPanel;          // pose of its middle; its front is +Z
    glm::vec2 panelSize_m{0};
};

class Headset {
  public:
    // Returns whether a runtime is set up, by the files that the OpenXR loader looks for; loads and starts
    // nothing. Whether it has a headset shows only in open().
    static bool hasRuntime();
    // Returns whether a runtime answers and has a headset. May take seconds. Any thread while there is no
    // Headset, but not before its first call has set up the loader's environment.
    static bool isThere();
    // panelSize: pixels of the text panel's picture. Needs a GLX context. Errors tell the player what to do.
    static Result<Headset> open(glm::ivec2 panelSize);
    Headset(Headset&&) noexcept;
    ~Headset(); // ends the session properly and stops vibrations

    // Handles the runtime's events: begins or ends the session on demand. Fails when the headset is lost.
    Status poll();
    bool lost() const;        // a call failed because runtime or headset is gone: another open() may succeed
    bool wantsFrames() const; // false: do not call waitFrame(), begin() or end(), even for an empty frame
    bool plays() const;       // the headset is worn, and no menu of the runtime covers the game
    bool leaving() const;     // the player told the runtime to end the game
    // Centres the dive at the next tracked frame: its origin becomes the eyes' position, and ahead where they
    // look. Recentring in the runtime's own menu does the same.
    void recentre();

    Result<Frame> waitFrame();        // sleeps until the runtime wants the next one
    const Tracking& tracking() const; // tracking data predicted for the time when the frame is shown

    Status begin();
    // Returns a framebuffer of Properties::eyeSize or panelSize: colour only, for display-coded values
    // (sRGB), or depth only.
    Result<GLuint> acquire(Picture picture);
    Status release(Picture picture);
    Status end(const Shown& shown);

    // Vibrates for up to a tenth of a second. hand: 0 left, 1 right; amplitude 0 to 1, 0 stops it.
    Status vibrate(int hand, float amplitude, float frequency_Hz);

    const Properties& properties() const;

  private:
    struct State;
    explicit Headset(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// Returns the name of the active runtime, or the reason why there is none.
Result<std::string> activeRuntime();

} // namespace shoal::xr
