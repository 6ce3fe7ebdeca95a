// The interface of hand trackers: a device on a thread of its own, and the stream in which its frames of
// hands reach the game's thread.
#pragma once

#include "engine/core/Files.h"
#include "input/hands/CameraPreview.h"
#include "input/hands/HandRig.h"

#include <array>
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
    int64_t time_us = 0; // by the device's clock; may start anew when the device does
    Clock::time_point
        seenAt{}; // by this machine's: when a picture was taken; HandStream's where none is given
    std::array<HandPose, 2> hands{};   // left, right; unfiltered, viewer's frame
    std::array<int64_t, 2> identity{}; // changes when the device no longer knows that it is the same hand
    // From the wrist, unit, viewer's frame; 0 where the device sees no elbow. For the picture only.
    std::array<glm::vec3, 2> towardsElbow{};
    // From a camera to the palm if the hand were of the rig's size (HandSize.h), metres; 0 of a device that
    // knows how far away hands are.
    std::array<float, 2> asRig_m{};
};

// State of a tracker, for a person to read.
struct DeviceState {
    bool present = false;     // frames come, or would if there were hands
    std::string description;  // "protocol 6, peripheral attached", "not there", ...
    bool lacksModels = false; // a webcam's, which handModelScript() fetches
};

// A queue of frames with one writer, the tracker's thread, and one reader.
class HandStream {
  public:
    // What push() does when the queue is full: drop the oldest frame, or wait for room.
    enum class Full { Drop, Wait };
    explicit HandStream(size_t capacity = 1024, Full full = Full::Drop);

    void push(HandFrame frame); // without seenAt it is taken to be seen now
    // The oldest frame; false: none. Programs that do not run in real time wait so long for one.
    bool take(HandFrame& out, std::chrono::milliseconds patience = {});
    void close(); // no call waits any longer

    void setState(DeviceState state);
    DeviceState state() const;

  private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<HandFrame> frames_;
    const size_t capacity_;
    const Full full_;
    bool closed_ = false;
    DeviceState state_;
};

// Tracks until it is destroyed.
class HandTracker {
  public:
    virtual ~HandTracker() = default;
    HandTracker(const HandTracker&) = delete;
    HandTracker& operator=(const HandTracker&) = delete;

    const char* name() const { return name_; } // "Leap Motion"
    HandStream& stream() { return stream_; }
    virtual CameraPreview* preview() { return nullptr; } // null: of a tracker without pictures
    // The player's, in times of the rig's; of no use to a device that knows how far away hands are.
    virtual void setHandSize(float) {}

  protected:
    explicit HandTracker(const char* name, size_t capacity = 1024,
                         HandStream::Full full = HandStream::Full::Drop)
        : name_(name), stream_(capacity, full) {}

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
    int retry_ms = 500; // from one attempt to connect to the next, at least
};

// Its thread connects, and connects again whenever the service goes: at once if the connection has held for
// retry_ms, else when so much time has passed since it was tried last. A service that closes with code 1001
// is asked at once for the protocol one version older; one that was gone is asked for the newest again.
constexpr int kNewestLeapVersion = 6;
std::unique_ptr<HandTracker> makeLeapTracker(const LeapOptions& options, const HandRig& rig);

// The script that fetches the models of hands, once, and the folder that it puts them into.
Path handModelScript();
Path handModelFolder();

// A webcam, or a clip of one.
struct WebcamOptions {
    std::string file;                // a clip; empty: the camera
    int index = 0;                   // which camera, as the system counts them
    bool live = true;                // a clip keeps its own rate; else it waits for whoever takes its frames
    Path models = handModelFolder(); // without them no hand is found, and no camera opened
    float handSize = 1;              // the player's, in times of the rig's
};

// A camera that is not there, or goes, is tried again every second.
std::unique_ptr<HandTracker> makeWebcamTracker(const WebcamOptions& options, const HandRig& rig);

// Pose of a tracker relative to the viewer, which maps the hands it sees into the viewer's frame. All device
// frames here are right-handed, in metres.
//
//   desk    Leap on the desk: x to the right, y up, z towards the player: the viewer's own axes. The hands
//           move in a box around 0.2 m above the device, but fish swim farther off than the desk is wide:
//           the middle of that box is put before the eyes, and distances from it are scaled by kReach. The
//           hands themselves keep their size; hands that come near each other do so less (HandPlacement).
//   head    Leap on a headset, looking ahead: its y points where the viewer looks, its x to the viewer's
//           left and its z down. 0.08 m before the eyes. Nothing is scaled: hands are where they are.
//   camera  A webcam on the screen that looks back at the player: x to the right of its own picture (the
//           player's left), y up, z towards the screen behind it. Distances are scaled as on the desk.
struct Mount {
    glm::quat viewerFromDevice{1, 0, 0, 0};
    glm::vec3 centreDevice_m{0}; // this point of the device's frame...
    glm::vec3 centreViewer_m{0}; // ...is put here
    float reach = 1;             // scale of distances from there

    glm::vec3 place(glm::vec3 pDevice) const {
        return centreViewer_m + viewerFromDevice * (pDevice - centreDevice_m) * reach;
    }

    // In place: one hand, from the device's frame to the viewer's. The palm is moved, the hand keeps its
    // size.
    void apply(HandPose& hand) const {
        move(hand, place(hand.joints[kPalmJoint].position), viewerFromDevice);
    }
    // The inverse: from the viewer's frame to the device's.
    void undo(HandPose& hand) const {
        const glm::quat deviceFromViewer = glm::conjugate(viewerFromDevice);
        const glm::vec3 palm = hand.joints[kPalmJoint].position;
        move(hand, centreDevice_m + deviceFromViewer * (palm - centreViewer_m) / reach, deviceFromViewer);
    }

  private:
    static void move(HandPose& hand, const glm::vec3& palm, const glm::quat& turn) {
        const glm::vec3 before = hand.joints[kPalmJoint].position;
        for (Joint& joint : hand.joints) {
            joint.position = palm + turn * (joint.position - before);
            joint.orientation = turn * joint.orientation;
        }
    }
};

// Puts both hands of a device's frames into the viewer's frame. If a reach longer than the player's were
// applied to each hand alone, hands that touch would stay apart: by 0.6 of the distance of their palms. So
// the distance between the hands is lengthened less the nearer they are, and not at all where they could
// touch; the middle between them goes where the mount puts it.
class HandPlacement {
  public:
    explicit HandPlacement(const Mount& mount) : mount_(mount) {}

    const Mount& mount() const { return mount_; }

    // In place, from the device's frame to the viewer's, those hands that are tracked. Where a second hand
    // comes or goes, the first is moved within kEase_s, not at once.
    void apply(std::array<HandPose, 2>& hands, int64_t time_us);

    // From there on farther apart, by so much, distances are lengthened in full.
    static constexpr float kFull_m = 0.4f;
    static constexpr float kEase_s = 0.3f;

  private:
    // What is to be added to where the mount alone puts each hand; viewer's frame, metres. palmsDevice: of
    // the hands that are seen. touching_m: palms nearer than this may belong to hands that touch.
    std::array<glm::vec3, 2> shifts(const std::array<std::optional<glm::vec3>, 2>& palmsDevice,
                                    float touching_m, int64_t time_us);

    Mount mount_;
    std::array<glm::vec3, 2> shifts_{}; // whole, of the last time that both were seen
    float share_ = 0;                   // of them that is applied, 0 to 1
    bool seen_ = false;                 // any hand, in the last frame
    int64_t time_us_ = 0;
};

// From the palm joint to the tip of the stretched middle finger, metres: hands whose palms are farther apart
// than the sum of theirs do not touch.
float spanOf(const HandPose& hand);

constexpr float kReach = 1.6f;
const inline Mount kDeskMount{{1, 0, 0, 0}, {0, 0.20f, 0}, {0, -0.12f, -0.75f}, kReach};
// (x, y, z) to (-x, -z, -y): half a turn about the axis between -y and z.
const inline Mount kHeadMount{{0, 0, 0.70710678f, -0.70710678f}, glm::vec3(0), {0, 0, -0.08f}, 1};
// (x, y, z) to (-x, y, -z): half a turn about y. The middle is half a metre before the camera.
const inline Mount kCameraMount{{0, 0, 1, 0}, {0, -0.05f, -0.50f}, {0, -0.12f, -0.75f}, kReach};

} // namespace shoal::hands
