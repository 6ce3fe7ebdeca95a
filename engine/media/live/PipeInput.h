// A named pipe as FFmpeg reads it. Internal to this folder.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <functional>
#include <span>

struct AVIOContext;

namespace shoal::media {

class PipeInput {
  public:
    // giveUp: asked ten times a second while nothing comes.
    PipeInput(Path file, std::function<bool()> giveUp);
    ~PipeInput();
    PipeInput(const PipeInput&) = delete;
    PipeInput& operator=(const PipeInput&) = delete;

    // For a writer that comes now, or is there already.
    Status open();
    AVIOContext* context() { return context_; }

    // Blocks until there are some. As FFmpeg wants it: their count, or a negative error.
    int read(std::span<uint8_t> bytes);

  private:
    Path file_;
    std::function<bool()> giveUp_;
    int descriptor_ = -1;
    AVIOContext* context_ = nullptr;
};

} // namespace shoal::media
