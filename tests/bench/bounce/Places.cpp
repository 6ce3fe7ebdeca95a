#include "tests/bench/bounce/Places.h"

#include "game/app/ContentLoader.h"
#include "game/rules/Dive.h"

#include "engine/media/VideoSource.h"

#include <cmath>

namespace shoal::bench {

namespace {
constexpr size_t kFish = 6; // in a frame
}

Result<std::vector<Places>> placesOf(const std::string& name, double every_s) {
    auto files = game::loadDiveFiles(name);
    if (!files) return files.error();
    const Path film = dataRoot() / "content" / files->dive.video;
    files->dive.space = app::filmSpaceOf(film, 0);
    const auto video = media::VideoSource::open(film, media::Layout::Mono);
    if (!video) return video.error();
    game::Dive dive(files->species, files->dive, 1);
    std::vector<Places> all;
    game::Events events;
    double next_s = every_s / 2;
    for (int tick = 1; next_s < video->info().duration_s; ++tick) {
        events.clear();
        dive.step({}, events);
        if (static_cast<double>(tick) / sim::kTickRate_Hz < next_s) continue;
        Places places{static_cast<int>(next_s * video->info().fps), {}};
        const auto& fish = dive.state().fish;
        for (size_t i = 0; i < kFish; ++i)
            places.fish_mm.emplace_back(1000.0f *
                                        fish[(i * fish.size() / kFish + all.size()) % fish.size()].position);
        all.push_back(std::move(places));
        next_s += every_s;
    }
    return all;
}

} // namespace shoal::bench
