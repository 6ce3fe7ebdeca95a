// Depth tracks: whatever the file, frames have the stated size and codes within their range.
#include "engine/media/DepthTrack.h"
#include "tests/fuzz/Target.h"

#include <algorithm>

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const fuzz::FileInput file("input.depth.mkv");
    auto track = media::DepthTrack::open(file({data, size}));
    if (!track) return 0;
    const media::DepthTrackInfo& info = track->info();
    fuzz::expect(info.frameCount > 0 && info.duration_s > 0 && info.height * 2 == info.width);
    media::DepthFrame frame;
    for (const int number : {0, info.frameCount - 1, info.frameCount / 2}) {
        if (!track->read(number, frame)) continue;
        const size_t texels = static_cast<size_t>(info.width) * static_cast<size_t>(info.height);
        fuzz::expect(frame.inverse.size() == texels && frame.confidence.size() == texels / 4);
        fuzz::expect(std::ranges::max(frame.inverse) <= media::kMaxDepthCode);
        fuzz::expect(std::ranges::max(frame.confidence) <= media::kMaxDepthCode);
    }
    const int at = track->frameAt(1e9);
    fuzz::expect(at >= 0 && at < info.frameCount);
    return 0;
}
