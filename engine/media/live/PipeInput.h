// FFmpeg input that reads a named pipe and can be interrupted. Internal to this folder.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <functional>
#include <span>

struct AVIOContext;

namespace shoal::media {

class PipeInput {
  public:
    // giveUp: polled ten times a second while nothing comes.
    PipeInput(Path file, std::function<bool()> giveUp);
    ~PipeInput();
    PipeInput(const PipeInput&) = delete;
    PipeInput& operator=(const PipeInput&) = delete;

    // For the writer that is there, or the next.
    Status open();
    AVIOContext* context() { return context_; }

    // Blocks until there are some. Returns their count, or a negative error of FFmpeg's.
    int read(std::span<uint8_t> bytes);

  private:
    Path file_;
    std::function<bool()> giveUp_;
    int descriptor_ = -1;
    AVIOContext* context_ = nullptr;
};

} // namespace shoal::media
