// A headset driven through OpenXR: session, frames, poses of head, hands and controllers, pictures to show.
// The runtime corrects the lenses' distortion. World frame: the dive's, whose origin is where the eyes were
// when it was centred.
//
// Each turn of the game's loop: poll(); where wantsFrames(), waitFrame(), then begin(), the pictures, end().
// One thread, with the GL context that was current at open().
#pragma once

#include "engine/core/Result.h"
#include "engine/xr/Tracked.h"

#include <epoxy/gl.h>
#include <glm/vec2.hpp>

#include <memory>
#include <optional>
#include <string>

namespace shoal::xr {

// Depths belong to the eyes; not every headset takes them.
enum class Picture { LeftEye, RightEye, Panel, LeftDepth, RightDepth };

// Distances of a frustum's planes, metres.
struct Planes {
    float near_m = 0, far_m = 0;
};

struct Frame {
    int64_t display_ns = 0; // when it will be seen; the runtime's clock
    double period_s = 0;    // from one frame to the next
    bool drawn = false;     // somebody sees it
};

// What end() shows: the pictures that were released since begin().
struct Shown {
    bool eyes = false;
    // Behind the eyes' pictures, where their alpha, by which their light is multiplied, lets it through.
    bool room = false;
    glm::ivec2 eyeSize{0};        // the part drawn, from the lower left; at most eyeSize()
    std::optional<Planes> planes; // of the eyes' depths, 0 to 1 from near to far; none: there are none
    bool panel = false;           // with premultiplied alpha
    Pose worldFromPanel;          // its middle, seen from +Z
    glm::vec2 panelSize_m{0};
};

class Headset {
  public:
    // Whether a runtime is set up, by the files that the OpenXR loader looks for: nothing is loaded or
    // started. Whether it has a headset shows only in open().
    static bool hasRuntime();
    // Whether a runtime answers and has one. May take seconds; any thread, while there is no Headset, and
    // after the first: the loader's environment is set up by that.
    static bool isThere();
    // panelSize: of the picture for text, pixels. Needs a GLX context. Errors tell a player what to do.
    static Result<Headset> open(glm::ivec2 panelSize);
    Headset(Headset&&) noexcept;
    ~Headset(); // ends the session in good order; what vibrates stops

    // Handles the runtime's events: begins or ends the session as they demand. Fails when the headset is
    // lost.
    Status poll();
    bool lost() const;        // a call failed because runtime or headset went: another open() may find them
    bool wantsFrames() const; // else no waitFrame(), begin(), end(); empty frames are frames too
    bool plays() const;       // the headset is worn, and no menu of the runtime lies over the game
    bool leaving() const;     // the player told the runtime to end the game
    // From the next tracked frame on the dive's origin is where the eyes are, and ahead where they look. So
    // it is by itself when the player has recentred in the runtime's own way.
    void recentre();

    Result<Frame> waitFrame();        // sleeps until the runtime wants the next one
    const Tracking& tracking() const; // at the time when the frame will be seen

    Status begin();
    // A framebuffer of eyeSize() or panelSize: colour only, for values coded for display (sRGB), or depth
    // only.
    Result<GLuint> acquire(Picture picture);
    Status release(Picture picture);
    Status end(const Shown& shown);

    // hand: 0 left, 1 right; amplitude 0 to 1. Goes on for up to a tenth of a second; 0 stops it.
    Status vibrate(int hand, float amplitude, float frequency_Hz);

    glm::ivec2 eyeSize() const; // the runtime's recommendation, pixels
    bool seesRoom() const;      // it can show the player's room behind pictures
    bool takesDepth() const;    // with which it can move pictures more truly between two frames
    bool bareHands() const;     // hands without controllers can be tracked
    std::string name() const;   // of headset and runtime

  private:
    struct State;
    explicit Headset(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// Name of the active runtime, or why there is none.
Result<std::string> activeRuntime();

} // namespace shoal::xr
