#include "engine/media/VideoInfo.h"

#include "engine/media/DescribeVideo.h"

namespace shoal::media {

bool resolveLayout(VideoSource& source, Layout wish, VideoInfo& info) {
    info = source.info();
    if (wish != Layout::Auto) {
        info.layout = wish;
        info.layoutSource = "asked for";
    } else if (info.metadata.layout != Layout::Auto) {
        info.layout = info.metadata.layout;
        info.layoutSource = "metadata";
    } else if (const Layout guess = layoutFromShape(info.width, info.height); guess != Layout::Auto) {
        info.layout = guess;
        info.layoutSource = "shape";
    } else {
        ImageRgb8 first(info.width, info.height);
        if (!source.grab() || !source.retrieve(first) || !source.seek(0)) return false;
        info.layout = layoutFromContent(first);
        info.layoutSource = "content";
    }
    return true;
}

Result<VideoInfo> inspectVideo(const Path& file, Layout layout) {
    auto source = VideoSource::open(file);
    if (!source) return source.error();
    VideoInfo info;
    ImageRgb8 first(source->info().width, source->info().height);
    if (!resolveLayout(*source, layout, info) || !source->grab() || !source->retrieve(first))
        return Error{file.string(), "its first frame cannot be decoded"};
    return info;
}

} // namespace shoal::media
