#include "engine/media/live/PipeInput.h"

extern "C" {
#include <libavformat/avio.h>
#include <libavutil/error.h>
#include <libavutil/mem.h>
}

#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace shoal::media {

namespace {

constexpr int kBuffer = 1 << 16;
constexpr int kPollInterval_ms = 100;

int readFor(void* pipe, uint8_t* bytes, int count) {
    return static_cast<PipeInput*>(pipe)->read(std::span(bytes, static_cast<size_t>(count)));
}

void close(AVIOContext*& context) {
    if (context) av_freep(&context->buffer);
    avio_context_free(&context);
}

} // namespace

PipeInput::PipeInput(Path file, std::function<bool()> giveUp)
    : file_(std::move(file)), giveUp_(std::move(giveUp)) {}

PipeInput::~PipeInput() {
    close(context_);
    if (descriptor_ >= 0) ::close(descriptor_);
}

Status PipeInput::open() {
    close(context_);
    // Opened before the old one is closed: a new writer must not find the pipe without readers. And opened
    // again each time: after a writer has closed, the old descriptor reports only the end of the file.
    const int opened = ::open(file_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = opened;
    struct stat found {};
    if (descriptor_ < 0 || fstat(descriptor_, &found) != 0 || !S_ISFIFO(found.st_mode))
        return Error{"", "cannot be opened for reading"};
    context_ = avio_alloc_context(static_cast<uint8_t*>(av_malloc(kBuffer)), kBuffer, 0, this, readFor,
                                  nullptr, nullptr);
    if (!context_) return Error{"", "cannot be read: there is no memory"};
    return Done{};
}

int PipeInput::read(std::span<uint8_t> bytes) {
    for (;;) {
        if (giveUp_()) return AVERROR_EXIT;
        pollfd waiting{descriptor_, POLLIN, 0};
        // Waits for the first writer too; POLLHUP comes once the last writer has closed.
        if (poll(&waiting, 1, kPollInterval_ms) <= 0) continue;
        const ssize_t count = ::read(descriptor_, bytes.data(), bytes.size());
        if (count > 0) return static_cast<int>(count);
        if (count == 0) return AVERROR_EOF;
        if (errno != EAGAIN && errno != EINTR) return AVERROR(errno);
    }
}

} // namespace shoal::media
