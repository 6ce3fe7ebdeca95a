// Properties of a video, its frames as the players return them, and the slots that hold them.
#pragma once

#include "engine/core/Image.h"
#include "engine/media/SphericalMetadata.h"

#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

struct AVFrame;

namespace shoal::media {

constexpr int kMaxVideoSide = 8192;
constexpr double kMinFps = 1, kMaxFps = 240, kFallbackFps = 30;

// Matrix coefficients of a video's luma and colour differences. High-definition video is BT.709; decoded as
// BT.601, its saturated colours would shift by up to 25 of 255 levels. The values are codes of ISO/IEC
// 23091-2 (ITU-T H.273), which FFmpeg has too.
enum class ColourMatrix { Bt709 = 1, Bt601 = 5, Bt2020 = 9 };

const char* nameOf(ColourMatrix matrix);

// Coding of light. Sdr: standard dynamic range, which is taken for sRGB. Pq (SMPTE ST 2084) and Hlg (ARIB
// STD-B67): high dynamic range, both in BT.2100.
enum class Transfer { Sdr, Pq, Hlg };

// Properties of a video file, read without playing it.
struct VideoInfo {
    int width = 0; // of the whole frame, both eyes, upright and placed in its bounds
    int height = 0;
    double fps = kFallbackFps; // rate of the frames that are presented, kMinFps..kMaxFps: see VideoSource
    double storedFps = 0;      // the container's mean rate of stored pictures, for messages
    int64_t frameCount = 0;    // as the container says, 0 if it does not; the player counts for itself
    double duration_s = 0;     // frameCount / fps
    std::string codec;         // such as "h264"
    ColourMatrix matrix = ColourMatrix::Bt601; // of the first frame: stated, else by size
    Transfer transfer = Transfer::Sdr;         // of the first frame
    SphericalMetadata metadata;
    Layout layout = Layout::Mono;  // never Auto
    const char* layoutSource = ""; // "asked for", "metadata", "shape", "content"
};

// A picture as its decoder gave it, in planes of luma, blue and red difference, and how it is shown: by
// FrameConverter on the processor, and by shaders/render/Planes.frag.
struct Planes {
    std::array<const uint8_t*, 3> codes{}; // rows from the top; null: there are no such planes
    std::array<int, 3> rowBytes{};
    int bytes = 1;                      // of a code
    glm::ivec2 size{0}, chromaShift{0}; // chromaShift: log2 of the texels that share a colour
    glm::mat4x3 rgbFromCodes{1}, toRec709{1};
    const float* lightByCode = nullptr; // kLightCodes from 0 to 1; null: colours are shown as they are coded
    bool isHlg = false;                 // lightByCode holds light of the scene, not of the display
};
constexpr int kLightCodes = 1 << 14; // steps are at most 0.2 % of the light

struct VideoFrame {
    ImageRgb8 pixelsBgr;          // sRGB-coded, blue first; see PlayerOptions::keepPixels
    ImageRgbF radianceLin;        // of a PQ or HLG film, 1 is its white; at most 1024 a side; else empty
    Layout layout = Layout::Mono; // never Auto
    glm::ivec2 chromaTexels{2};   // texels that share a colour, across and down; 2, 2 is 4:2:0
    int64_t index = -1;           // counts frames from 0; a file's frames count on as it repeats
    int64_t number = -1;          // within the file; -1: live
    double time_s = 0;            // within the file; 0: live
    size_t slot = 0;              // index of its slot, below kFrameSlots
    double arrived_s = 0;         // arrival of a live frame, by LiveOptions::now_s
    double decode_ms = 0;         // decoding and conversion of this frame alone
    double prepare_ms = 0;        // time of PlayerOptions::prepare
    Planes planes;                // with PlayerOptions::keepPlanes
    std::shared_ptr<AVFrame> planesOwner;
};

// Sparing: no more threads than the film needs decode it, because the processor draws as well. AllThreads: a
// thread for each core. Card: a graphics card decodes it; AllThreads if no card can, or once the card fails.
enum class Decoding { Sparing, AllThreads, Card };

constexpr size_t kFrameSlots = 3; // one is shown, the others are ready or being filled

struct PlayerOptions {
    Layout layout = Layout::Auto;
    Decoding decoding = Decoding::Sparing; // of a file
    // Called on the decode thread for each frame that may be shown, once it is in its slot; the caller keeps
    // its results by slot. No other thread uses that slot meanwhile, and it stays untouched for as long as
    // the frame is shown. Must not throw nor call the player.
    std::function<void(const VideoFrame& frame)> prepare;
    // False: only `prepare` sees pixelsBgr; it is empty in frames that the player returns.
    bool keepPixels = true;
    // True: frames of a file keep their planes too, if they are neither turned nor placed in a sphere.
    bool keepPlanes = false;
};

// Slots for a player's frames, each with its state. Internal to this folder.
class FrameSlots {
  public:
    enum class State { Free, Filling, Ready, Shown };
    struct Slot {
        VideoFrame frame;
        State state = State::Free;
    };

    FrameSlots() {
        for (size_t i = 0; i < slots_.size(); ++i) slots_[i].frame.slot = i;
    }

    Slot* begin() { return slots_.data(); }
    Slot* end() { return slots_.data() + slots_.size(); }

    // Returns the first slot in that state, or null.
    Slot* find(State state) {
        Slot* found = std::ranges::find(slots_, state, &Slot::state);
        return found == end() ? nullptr : found;
    }

    void show(Slot& slot) {
        if (shown_) shown_->state = State::Free;
        shown_ = &slot;
        slot.state = State::Shown;
    }
    const VideoFrame& shown() const { return shown_->frame; } // requires an earlier show()

    // Returns the image into which the decode thread writes the pixels of a slot.
    ImageRgb8& pixelsOf(Slot& slot, const PlayerOptions& options) {
        return options.keepPixels ? slot.frame.pixelsBgr : pixels_;
    }
    // Calls options.prepare with the slot's frame and pixels.
    void prepare(Slot& slot, const PlayerOptions& options) {
        if (!options.keepPixels) std::swap(slot.frame.pixelsBgr, pixels_);
        const auto began = std::chrono::steady_clock::now();
        if (options.prepare) options.prepare(slot.frame);
        slot.frame.prepare_ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
        if (!options.keepPixels) std::swap(slot.frame.pixelsBgr, pixels_);
    }

  private:
    std::array<Slot, kFrameSlots> slots_;
    Slot* shown_ = nullptr;
    ImageRgb8 pixels_; // shared by all slots, if they do not keep theirs
};

} // namespace shoal::media
