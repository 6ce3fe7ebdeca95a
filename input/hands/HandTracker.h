// The interface of hand trackers: a device on a thread of its own, and the stream in which its frames of
// hands reach the game's thread.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "input/hands/HandRig.h"

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace shoal::hands {

using Clock = std::chrono::steady_clock;

struct HandFrame {
    int64_t time_us = 0;             // by the device's clock; may start anew when the device does
    Clock::time_point seenAt{};      // by this machine's clock; HandStream sets it where the tracker does not
    std::array<HandPose, 2> hands{}; // left, right; unfiltered, viewer's frame
    std::array<int64_t, 2> identity{}; // changes when the device no longer knows that it is the same hand
    // Unit vector from the wrist to the elbow, viewer's frame; 0 if no elbow is seen. Used for drawing only.
    std::array<glm::vec3, 2> towardsElbow{};
    // Distance from the camera to the palm if the hand had the rig's size (HandSizing), metres; 0 if the
    // device measures distances.
    std::array<float, 2> rigDistance_m{};
};

// State of a tracker, as shown to the player.
struct DeviceState {
    bool present = false;     // frames come, or would come if hands were seen
    std::string description;  // "protocol 6, peripheral attached", "not there", ...
    bool lacksModels = false; // the webcam's models are missing; handModelScript() fetches them
};

// A queue of frames with one writer, the tracker's thread, and one reader.
class HandStream {
  public:
    // waits: push() waits for room when the queue is full; else the oldest frame is dropped.
    explicit HandStream(size_t capacity = 1024, bool waits = false) : capacity_(capacity), waits_(waits) {}

    void push(HandFrame frame); // a frame without seenAt counts as seen now
    // Takes the oldest frame; false: there is none. patience: longest wait, in programs that do not run in
    // real time. If it is not 0, a stream whose push() waits (a clip) is awaited until its next frame or end.
    bool take(HandFrame& out, std::chrono::milliseconds patience = {});
    void close() { // calls no longer wait
        const std::lock_guard lock(mutex_);
        closed_ = true;
        changed_.notify_all();
    }
    void setState(DeviceState state) {
        const std::lock_guard lock(mutex_);
        state_ = std::move(state);
    }
    DeviceState state() const {
        const std::lock_guard lock(mutex_);
        return state_;
    }

  private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<HandFrame> frames_;
    const size_t capacity_;
    const bool waits_;
    bool closed_ = false;
    DeviceState state_;
};

// A small copy of a camera's picture for the player. The tracker's thread writes it, the program's reads it;
// it never leaves the process.
class CameraPreview {
  public:
    static constexpr int kWidth = 240; // pixels

    // Returns whether look() was called since the last show(): a picture is needed. Tracker's thread.
    bool isWatched() const { return watched_; }
    void show(const ImageRgba8& picture) {
        const std::lock_guard lock(mutex_);
        picture_ = picture;
        isNew_ = true;
        watched_ = false;
    }

    // Copies a new picture to out; returns false if there is none. For the program's thread, once a frame
    // while the picture is on the screen.
    bool look(ImageRgba8& out) {
        const std::lock_guard lock(mutex_);
        watched_ = true;
        if (!isNew_) return false;
        isNew_ = false;
        out = picture_;
        return true;
    }

  private:
    std::atomic<bool> watched_ = false;
    std::mutex mutex_;
    ImageRgba8 picture_; // guarded by mutex_, as is isNew_
    bool isNew_ = false;
};

// A tracker that runs until it is destroyed.
class HandTracker {
  public:
    virtual ~HandTracker() = default;
    HandTracker(const HandTracker&) = delete;
    HandTracker& operator=(const HandTracker&) = delete;

    const char* name() const { return name_; } // "Leap Motion"
    HandStream& stream() { return stream_; }
    virtual CameraPreview* preview() { return nullptr; } // null: the tracker has no pictures
    virtual void setHandSize(float) {} // the player's, in times of the rig's; for trackers that use a camera

  protected:
    explicit HandTracker(const char* name, size_t capacity = 1024, bool waits = false)
        : name_(name), stream_(capacity, waits) {}

  private:
    const char* name_;
    HandStream stream_;
};

// The service of Leap / Ultraleap, over its WebSocket: no library of theirs is needed.
enum class LeapMount { Desk, Head };
struct LeapOptions {
    std::string host = "127.0.0.1";
    uint16_t port = 6437;
    LeapMount mount = LeapMount::Desk;
    int retry_ms = 500; // least time from one attempt to connect to the next
};

// Connects on a thread of its own, and reconnects whenever the service goes. A service that closes with code
// 1001 is asked at once for the protocol one version older; after any other loss the newest is asked for.
constexpr int kNewestLeapVersion = 6;
std::unique_ptr<HandTracker> makeLeapTracker(const LeapOptions& options, const HandRig& rig);

// The script that fetches the models of hands, once, and the folder that it puts them into.
inline Path handModelScript() { return dataRoot() / "input/hands/webcam/get_models"; }
inline Path handModelFolder() { return dataFolder() / "models"; }

// A webcam, or a clip of one.
struct WebcamOptions {
    std::string file;                // a clip; empty: the camera
    int index = 0;                   // which camera, as the system counts them
    bool live = true;                // a clip keeps its own rate; else it waits until frames are taken
    Path models = handModelFolder(); // without them no hand is found, and no camera opened
    float handSize = 1;              // the player's, in times of the rig's
};

// Tries a camera that is not there, or goes, again every second.
std::unique_ptr<HandTracker> makeWebcamTracker(const WebcamOptions& options, const HandRig& rig);

// Pose of a tracker relative to the viewer, which maps the hands it sees into the viewer's frame. All device
// frames here are right-handed, in metres.
//
//   desk    Leap on the desk: x to the right, y up, z towards the player: the viewer's own axes. The middle
//           of the hands' space, 0.2 m above the device, is put before the eyes. Distances from it are
//           scaled by kReach, because fish swim farther off than the desk is wide; hands keep their size.
//   head    Leap on a headset, looking ahead, 0.08 m before the eyes: its y points where the viewer looks,
//           its x to the viewer's left and its z down. Nothing is scaled.
//   camera  A webcam on the screen that looks back at the player: x to the right of its own picture (the
//           player's left), y up, z towards the screen behind it. Distances are scaled as on the desk.
struct Mount {
    glm::quat viewerFromDevice{1, 0, 0, 0};
    glm::vec3 centreDevice_m{0}, centreViewer_m{0}; // the same point in the device's and the viewer's frame
    float reach = 1;                                // scale of distances from there

    glm::vec3 place(glm::vec3 pDevice) const {
        return centreViewer_m + viewerFromDevice * (pDevice - centreDevice_m) * reach;
    }

    // Moves a hand from the device's frame to the viewer's by its palm; it keeps its size.
    void apply(HandPose& hand) const {
        const glm::vec3 palmDevice = hand.joints[kPalmJoint].position, palmViewer = place(palmDevice);
        for (Joint& joint : hand.joints) {
            joint.position = palmViewer + viewerFromDevice * (joint.position - palmDevice);
            joint.orientation = viewerFromDevice * joint.orientation;
        }
    }
};

// Puts both hands of a device's frames into the viewer's frame. The nearer the hands are to each other, the
// less their distance is scaled, and not at all where they could touch: else hands that touch would stay
// apart. The middle between them goes where the mount puts it.
class HandPlacement {
  public:
    explicit HandPlacement(const Mount& mount) : mount_(mount) {}

    const Mount& mount() const { return mount_; }

    // Moves the tracked hands from the device's frame to the viewer's. When a second hand comes or goes, the
    // first is moved within kEase_s, not at once.
    void apply(std::array<HandPose, 2>& hands, int64_t time_us);

    static constexpr float kFull_m = 0.4f; // palms this much farther apart than touching are scaled in full
    static constexpr float kEase_s = 0.3f;

  private:
    Mount mount_;
    std::array<glm::vec3, 2> shifts_{}; // from the places by the mount, when both were seen last
    float share_ = 0;                   // share of them that is applied, 0 to 1
    bool seen_ = false;                 // a hand was seen in the last frame
    int64_t time_us_ = 0;
};

// Returns the length from the palm joint to the tip of the stretched middle finger, metres: hands whose palms
// are farther apart than the sum of theirs do not touch.
float spanOf(const HandPose& hand);

constexpr float kReach = 1.6f;
const inline Mount kDeskMount{{1, 0, 0, 0}, {0, 0.20f, 0}, {0, -0.12f, -0.75f}, kReach};
// (x, y, z) to (-x, -z, -y): half a turn about the axis between -y and z.
const inline Mount kHeadMount{{0, 0, 0.70710678f, -0.70710678f}, glm::vec3(0), {0, 0, -0.08f}, 1};
// (x, y, z) to (-x, y, -z): half a turn about y. The middle is half a metre before the camera.
const inline Mount kCameraMount{{0, 0, 1, 0}, {0, -0.05f, -0.50f}, {0, -0.12f, -0.75f}, kReach};

// Size of a player's hand relative to the rig's. One camera cannot tell it, because a hand looks like a
// larger one that is farther away in proportion. So a player may have it measured at a known distance.
constexpr double kHandSizeMin = 0.7, kHandSizeMax = 1.4; // a child's, a giant's; also the setting's range

// Scales a hand of the rig's size, in the camera's frame, to the one of this size that looks the same.
void resize(HandPose& hand, float size);

// Measures the size of a hand that is held open and still at kAt_m from the camera.
class HandSizing {
  public:
    static constexpr float kAt_m = 0.3f;      // distance of the palm: the length of a sheet of A4 paper
    static constexpr float kHold_s = 1.5f;    // time for which it is held
    static constexpr float kSpread = 0.06f;   // greatest change of its distance, as a share
    static constexpr float kMissing_s = 0.2f; // a hand that is not seen for this long has gone

    enum class State { Waiting, Elsewhere, Holding, Done }; // Elsewhere: the hand is not at kAt_m

    // Takes a frame. rigDistance_m: HandFrame::rigDistance_m, if a single, open hand is seen; else empty.
    void see(std::optional<float> rigDistance_m, float dt_s);

    State state() const { return state_; }
    float progress() const { return state_ == State::Done ? 1.0f : held_s_ / kHold_s; }
    std::optional<float> size() const; // once it is done

  private:
    void begin(State state, float rigDistance_m = 0);

    State state_ = State::Waiting;
    float held_s_ = 0, missing_s_ = 0;
    float least_m_ = 0, most_m_ = 0, sum_m_ = 0;
    int seen_ = 0; // frames in sum_m_
};

} // namespace shoal::hands
