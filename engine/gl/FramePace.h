// Lets the processor prepare a frame while the graphics card draws the one before, and no earlier, so that
// neither waits for the other and a picture is at most one frame old. Measures the card's time.
#pragma once

#include "engine/gl/Objects.h"

#include <array>
#include <memory>
#include <type_traits>

namespace shoal::gl {

class FramePace {
  public:
    // Call it before a frame's first draw.
    void begin() {
        current_ ^= 1;
        Frame& frame = frames_[current_];
        if (!frame.begin) frame.begin = Query::make(), frame.end = Query::make();
        glQueryCounter(frame.begin.name(), GL_TIMESTAMP);
    }
    // Call it after a frame's last draw. Waits until the card has drawn the last frame; whole: this one too.
    void end(bool whole = false) {
        Frame& frame = frames_[current_];
        glQueryCounter(frame.end.name(), GL_TIMESTAMP);
        frame.drawn.reset(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
        glFlush();
        wait(frames_[current_ ^ 1]);
        if (whole) wait(frame);
    }
    // Returns the card's time for the newest frame that is known to be drawn.
    double card_ms() const { return card_ms_; }

  private:
    struct SyncDeleter {
        void operator()(GLsync sync) const { glDeleteSync(sync); }
    };
    struct Frame {
        Query begin, end;
        std::unique_ptr<std::remove_pointer_t<GLsync>, SyncDeleter> drawn; // null: nothing is being drawn
    };
    void wait(Frame& frame) {
        constexpr GLuint64 kPatience_ns = 1'000'000'000;
        if (!frame.drawn) return;
        while (glClientWaitSync(frame.drawn.get(), GL_SYNC_FLUSH_COMMANDS_BIT, kPatience_ns) ==
               GL_TIMEOUT_EXPIRED) {
        }
        frame.drawn.reset();
        GLuint64 begin_ns = 0, end_ns = 0;
        glGetQueryObjectui64v(frame.begin.name(), GL_QUERY_RESULT, &begin_ns);
        glGetQueryObjectui64v(frame.end.name(), GL_QUERY_RESULT, &end_ns);
        card_ms_ = static_cast<double>(end_ns - begin_ns) * 1e-6;
    }

    std::array<Frame, 2> frames_;
    size_t current_ = 0;
    double card_ms_ = 0;
};

} // namespace shoal::gl
