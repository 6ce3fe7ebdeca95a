// bench_depth FOLDER : what depth tracks of several widths, rates and steps cost, and what they hide rightly.
// FOLDER holds the truth, FILM_NNNN.depth.mkv: distances of frames of content/video/FILM.mp4, in runs of
// frames that follow each other. Writes FOLDER/depth.tsv.
#include "engine/math/Quantile.h"
#include "engine/media/VideoPlayer.h"
#include "tests/bench/Bench.h"
#include "tests/bench/depth/Hiding.h"

#include <fmt/core.h>

namespace {

using namespace shoal;
using namespace shoal::bench;

enum class Way { Nothing, Enlarged, Refined };
constexpr const char* kWayNames[] = {"no occlusion", "linear", "refined"};

struct Format {
    Way way;
    int width, every, steps, mapWidth; // every: frames of the film; mapWidth: of the DepthMap
};

constexpr int kSteps = media::kDepthStepsPerOctave, kExact = media::kExactDepthSteps, kMap = depth::kMapWidth;
const std::vector<Format> kFormats = {
    {Way::Nothing, 256, 1, kExact, kMap},     {Way::Enlarged, 128, 1, kExact, kMap},
    {Way::Enlarged, 256, 1, kExact, kMap},    {Way::Enlarged, 512, 1, kExact, kMap},
    {Way::Refined, 128, 1, kExact, kMap},     {Way::Refined, 256, 1, kExact, kMap},
    {Way::Refined, 512, 1, kExact, kMap},     {Way::Refined, 256, 1, kExact, 2 * kMap},
    {Way::Refined, 512, 1, kExact, 2 * kMap}, {Way::Refined, 256, 1, 32, kMap},
    {Way::Refined, 256, 1, 16, kMap},         {Way::Refined, 256, 1, 8, kMap},
    {Way::Refined, 128, 2, kSteps, kMap},     {Way::Enlarged, 256, 2, kSteps, kMap},
    {Way::Refined, 256, 2, kSteps, kMap},     {Way::Refined, 512, 2, kSteps, kMap},
    {Way::Refined, 128, 4, kSteps, kMap},     {Way::Refined, 256, 4, kSteps, kMap},
    {Way::Refined, 512, 4, kSteps, kMap},
};

struct Clip {
    std::string film;
    std::vector<media::DepthFrame> truth;
    std::vector<HiddenTexels> hidden; // by the truth
    std::vector<ImageRgb8> shown;     // blue first
};

struct Figures {
    HidingError error;
    std::map<std::string, double> frameBytes; // by film, of one frame of the track
    std::map<std::string, int> clips;
    double decode_ms = 0;
    int decoded = 0;
    std::vector<double> refine_ms;
};

Result<Clip> readClip(const Path& folder, const std::string& film, const std::vector<int>& frames) {
    Clip clip{film, {}, {}, {}};
    auto player = media::VideoPlayer::open(dataRoot() / "content/video" / (film + ".mp4"));
    if (!player) return player.error();
    for (const int frame : frames) {
        auto track = media::DepthTrack::open(folder / fmt::format("{}_{:04}.depth.mkv", film, frame));
        if (!track) return track.error();
        media::DepthFrame& truth = clip.truth.emplace_back();
        if (!track->read(0, truth)) return Error{film, "its truth is damaged"};
        hiddenInTruth(truth, clip.hidden.emplace_back());
        clip.shown.push_back(player->waitFor((frame + 0.5) / player->info().fps)->pixelsBgr);
    }
    return clip;
}

// Writes the frames as a track and reads them again: what is measured is what a player sees.
Result<std::vector<media::DepthFrame>> throughFile(const std::vector<media::DepthFrame>& frames,
                                                   const Path& file, Figures& figures,
                                                   const std::string& film) {
    const auto count = static_cast<int>(frames.size());
    auto writer = media::DepthTrackWriter::make({frames[0].width, frames[0].height, count, count / 24.0}, {});
    if (!writer) return writer.error();
    for (const media::DepthFrame& frame : frames)
        if (Status s = writer->add(frame); !s) return s.error();
    if (Status s = writer->finish(file); !s) return s.error();
    figures.frameBytes[film] += static_cast<double>(std::filesystem::file_size(file)) / count;
    ++figures.clips[film];
    auto track = media::DepthTrack::open(file);
    if (!track) return track.error();
    std::vector<media::DepthFrame> back(frames.size(), frames[0]);
    const double before = processor_ms();
    for (int i = 0; i < count; ++i)
        if (!track->read(i, back[i])) return Error{file.string(), "cannot be read"};
    figures.decode_ms += processor_ms() - before;
    figures.decoded += count;
    return back;
}

Status measure(const Clip& clip, const Format& format, const Path& folder, Figures& figures) {
    std::vector<media::DepthFrame> frames;
    for (const media::DepthFrame& truth : clip.truth)
        frames.push_back(reduced(truth, format.width, format.steps));
    const auto track = throughFile(frames, folder / "part.mkv", figures, clip.film);
    if (!track) return track.error();
    depth::DepthRefiner refiner(format.mapWidth);
    depth::DepthMap map;
    HiddenTexels before, found;
    for (size_t i = 0; i < frames.size(); ++i) {
        // The nearest that the track has; of two as near the later, as DepthTrack::frameAt() does.
        const size_t every = static_cast<size_t>(format.every);
        const size_t number =
            std::min((2 * i + every) / (2 * every) * every, (frames.size() - 1) / every * every);
        const ImageRgb8& shown = clip.shown[i];
        const double began = processor_ms();
        if (format.way == Way::Enlarged)
            refiner.enlarge((*track)[number], map);
        else if (format.way == Way::Refined)
            refiner.refine((*track)[number],
                           {shown.at(0, 0), shown.width, shown.height, ptrdiff_t{3} * shown.width, true},
                           map);
        figures.refine_ms.push_back(processor_ms() - began);
        hiddenInMap(map, clip.truth[i].width, found);
        figures.error.add(clip.hidden[i], found);
        if (i > 0) figures.error.addFlicker(clip.hidden[i - 1], clip.hidden[i], before, found);
        std::swap(before, found);
    }
    return Done{};
}

// Runs of frames that follow each other, by film.
std::vector<std::pair<std::string, std::vector<int>>> clipsIn(const Path& folder) {
    std::map<std::string, std::vector<int>> frames;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const size_t bar = name.rfind('_');
        if (name.ends_with(".depth.mkv") && bar != std::string::npos)
            frames[name.substr(0, bar)].push_back(std::atoi(name.c_str() + bar + 1));
    }
    std::vector<std::pair<std::string, std::vector<int>>> clips;
    for (auto& [film, numbers] : frames) {
        std::ranges::sort(numbers);
        for (const int number : numbers) {
            if (clips.empty() || clips.back().first != film || clips.back().second.back() + 1 != number)
                clips.push_back({film, {}});
            clips.back().second.push_back(number);
        }
    }
    return clips;
}

std::string table(const std::vector<Figures>& all) {
    std::string text = "way\twidth\tevery\tsteps\tmap\treef_MB\tnight_MB\tkelp_MB\tdecode_ms\trefine_ms\t"
                       "fish_hidden\tfish_shown\thidden\tshown\tboundary\tflicker\ttrue_change\n";
    for (size_t i = 0; i < all.size(); ++i) {
        const Figures& f = all[i];
        const Format& format = kFormats[i];
        std::vector<double> times_ms = f.refine_ms;
        const auto minute_MB = [&](const char* film) {
            const auto bytes = f.frameBytes.find(film);
            return bytes == f.frameBytes.end()
                       ? 0
                       : bytes->second / f.clips.at(film) * 24 * 60 / format.every * 1e-6;
        };
        text += fmt::format("{}\t{}\t{}\t{}\t{}\t{:.2f}\t{:.2f}\t{:.2f}\t{:.2f}\t{:.2f}\t"
                            "{:.2f}\t{:.2f}\t{:.3f}\t{:.3f}\t{:.2f}\t{:.2f}\t{:.2f}\n",
                            kWayNames[static_cast<size_t>(format.way)], format.width, format.every,
                            format.steps, format.mapWidth, minute_MB("reef"), minute_MB("night"),
                            minute_MB("kelp"), f.decode_ms / f.decoded, math::median(times_ms),
                            f.error.wronglyHidden(), f.error.wronglyShown(), f.error.wronglyHiddenAnywhere(),
                            f.error.wronglyShownAnywhere(), f.error.boundary(), f.error.flicker(),
                            f.error.trueChange());
    }
    return text;
}

Status run(const Path& folder) {
    std::vector<Figures> all(kFormats.size());
    for (const auto& [film, frames] : clipsIn(folder)) {
        const auto clip = readClip(folder, film, frames);
        if (!clip) return clip.error();
        for (size_t i = 0; i < kFormats.size(); ++i)
            if (Status s = measure(*clip, kFormats[i], folder, all[i]); !s) return s;
        std::fprintf(stderr, "bench_depth: %s from frame %d\n", film.c_str(), frames[0]);
    }
    std::error_code ignored;
    std::filesystem::remove(folder / "part.mkv", ignored);
    return writeFileWhole(folder / "depth.tsv", table(all));
}

} // namespace

int main(int argc, char** argv) {
    if (lacksArguments(argc, 1, "bench_depth FOLDER")) return 2;
    return exitStatus("bench_depth", run(argv[1]));
}
