// Films, from their first frame to beyond their end and back.
#include "engine/media/Check.h"
#include "engine/media/VideoPlayer.h"
#include "tests/fuzz/Target.h"

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const fuzz::FileInput file("input");
    const Path& path = file({data, size});
    auto player = media::VideoPlayer::open(path);
    fuzz::expect(player || !player.error().reason.empty());
    if (!player) return 0;
    ++fuzz::taken;
    int64_t before = 0;
    for (int i = 0; i < 30; ++i) {
        const media::VideoFrame* frame = player->waitFor(i / player->info().fps);
        fuzz::expect(frame && frame->index >= before && frame->index <= i);
        before = frame->index;
    }
    fuzz::expect(player->waitFor(1000) && player->newest(0.1) && player->waitFor(0));
    (void)player->status();
    (void)media::checkVideo(path);
    return 0;
}
