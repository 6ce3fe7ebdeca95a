// bench_bounce places FOLDER: writes FOLDER/NAME.places and FOLDER/NAME.frames, where animals are in each
// dive, for make_video_frames to trace. bench_bounce measure FOLDER FILM...: compares the light there
// (FOLDER/NAME.tsv) with what is had from the camera's light (FOLDER/NAME_NNNN.hdr, and the film's) and the
// film's distances; writes FOLDER/bounce.tsv. bench_bounce caustics FOLDER FILM...: compares the sun's light
// there over a second (FOLDER/NAME.sunlight.tsv) with what the film's ground tells of it; writes
// FOLDER/caustics.tsv. bench_bounce animals FOLDER and bench_bounce pictures FOLDER FRAME...: see Animals.h.
#include "engine/depth/Caustics.h"
#include "engine/depth/LightDifference.h"
#include "engine/light/FindLights.h"
#include "engine/light/Pyramid.h"
#include "engine/math/Quantile.h"
#include "engine/math/SphericalHarmonics.h"
#include "engine/media/DepthTrack.h"
#include "engine/media/Pictures.h"
#include "engine/media/VideoSource.h"
#include "game/app/ContentLoader.h"
#include "game/rules/Dive.h"
#include "tests/bench/Bench.h"
#include "tests/bench/bounce/Animals.h"

#include <fmt/core.h>

#include <sstream>

namespace {

using namespace shoal;

struct Film {
    const char* name;
    double every_s;
};
constexpr Film kFilms[] = {{"reef", 2}, {"night", 5}, {"kelp", 5}};

constexpr int kPasses = 20; // of what is timed

// Span of the tunnel in the reef's film, with its mouths; its frames count apart.
constexpr double kTunnel_s[2] = {37, 59};

constexpr size_t kFish = 6; // in a frame

// Writes the camera's place, and those of a few fish of all kinds, every so many seconds of the dive's film,
// first at half of that; millimetres, env frame. And the numbers of these frames.
Status writePlaces(const Path& folder, const Film& of) {
    auto files = game::loadDiveFiles(of.name);
    if (!files) return files.error();
    const Path film = dataRoot() / "content" / files->dive.video;
    files->dive.space = app::filmSpaceOf(film, 0);
    const auto video = media::VideoSource::open(film, media::Layout::Mono);
    if (!video) return video.error();
    game::Dive dive(files->species, files->dive, 1);
    std::string places, frames;
    game::Events events;
    double next_s = of.every_s / 2;
    size_t moments = 0;
    for (int tick = 1; next_s < video->info().duration_s; ++tick) {
        events.clear();
        dive.step({}, events);
        if (static_cast<double>(tick) / sim::kTickRate_Hz < next_s) continue;
        const int frame = static_cast<int>(next_s * video->info().fps);
        frames += fmt::format("{} ", frame);
        places += fmt::format("{} 0 0 0\n", frame);
        const auto& fish = dive.state().fish;
        for (size_t i = 0; i < kFish; ++i) {
            const glm::ivec3 mm(1000.0f * fish[(i * fish.size() / kFish + moments) % fish.size()].position);
            places += fmt::format("{} {} {} {}\n", frame, mm.x, mm.y, mm.z);
        }
        ++moments;
        next_s += of.every_s;
    }
    if (Status s = writeFileWhole(folder / (std::string(of.name) + ".places"), places); !s) return s;
    return writeFileWhole(folder / (std::string(of.name) + ".frames"), frames + "\n");
}

struct Probe {
    glm::vec3 place{0};
    float nearest_m = 0;
    math::ShRgb radiance{};
};

Result<std::map<int, std::vector<Probe>>> readProbes(const Path& file) {
    const auto text = readText(file, 16u << 20);
    if (!text) return text.error();
    std::map<int, std::vector<Probe>> frames;
    std::istringstream lines(*text);
    int frame = 0;
    for (Probe probe; lines >> frame >> probe.place.x >> probe.place.y >> probe.place.z >> probe.nearest_m;) {
        probe.place *= 0.001f;
        for (glm::dvec3& rgb : probe.radiance) lines >> rgb.r >> rgb.g >> rgb.b;
        frames[frame].push_back(probe);
    }
    return frames;
}

// Returns the inner product, over all directions, of the irradiances of two radiances: Parseval's sum.
double product(const math::ShRgb& a, const math::ShRgb& b) {
    double sum = 0;
    for (int l = 0; l < math::kShBands; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            sum += math::kShCosine[l] * math::kShCosine[l] * glm::dot(a[i], b[i]);
    return sum;
}

double relativeError(const math::ShRgb& found, const math::ShRgb& truth) {
    math::ShRgb off;
    for (size_t i = 0; i < off.size(); ++i) off[i] = found[i] - truth[i];
    return std::sqrt(product(off, off) / product(truth, truth));
}

// Returns the camera's light plus the difference that harmonics give for a place.
math::ShRgb moved(const math::ShRgb& camera, const depth::LightHarmonics& more, double factor) {
    math::ShRgb sum = camera;
    for (size_t i = 0; i < more.size(); ++i) sum[i] += factor * glm::dvec3(more[i]);
    return sum;
}

struct Error {
    float nearest_m;
    double value;
};

struct SunlitPlace {
    glm::vec3 place{0};
    std::vector<double> sunlight; // by frame of the last second, of what a level sea lets through
};

Result<std::map<int, std::vector<SunlitPlace>>> readSunlight(const Path& file) {
    const auto text = readText(file, 16u << 20);
    if (!text) return text.error();
    std::map<int, std::vector<SunlitPlace>> frames;
    std::istringstream lines(*text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        int frame = 0;
        SunlitPlace one;
        words >> frame >> one.place.x >> one.place.y >> one.place.z;
        one.place *= 0.001f;
        for (double value = 0; words >> value;) one.sunlight.push_back(value);
        if (one.place != glm::vec3(0)) frames[frame].push_back(std::move(one)); // the first is the camera
    }
    return frames;
}

// Sums over frames and places of the sun's light about its mean of a second.
struct Flicker {
    double places = 0, values = 0, without = 0, with = 0, found = 0, spent_s = 0;
};

double threadTime_s() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

constexpr float kBody_m = 0.2f; // length of the bodies that make_video_frames takes

// The frames of a film of the game, with their distances.
class Footage {
  public:
    static Result<Footage> open(const char* name) {
        Footage footage;
        footage.file_ = dataRoot() / "content/video" / (std::string(name) + ".mp4");
        Status s = media::VideoSource::open(footage.file_, media::Layout::Mono).moveTo(footage.video_);
        if (s)
            s = media::DepthTrack::open(media::depthTrackOf(footage.file_), footage.file_)
                    .moveTo(footage.track_);
        if (!s) return s.error();
        footage.shown_ = ImageRgb8(footage.video_->info().width, footage.video_->info().height);
        return footage;
    }

    double fps() const { return video_->info().fps; }
    light::FrameView view() const {
        return {shown_.at(0, 0), shown_.width, shown_.height, ptrdiff_t{3} * shown_.width, true};
    }
    const depth::DepthMap& map() const { return map_; }

    Status seek(int frame) {
        return video_->seek(frame) ? Status(Done{}) : shoal::Error{file_, "cannot be read there"};
    }
    // Decodes up to this frame, which view() shows then.
    Status show(int frame) {
        while (video_->position() <= frame)
            if (!video_->grab()) return shoal::Error{file_, "ends early"};
        return video_->retrieve(shown_) ? Status(Done{}) : shoal::Error{file_, "cannot be converted"};
    }
    // Makes the map of the frame that is shown.
    Status measure(int frame) {
        if (!track_->read(track_->frameAt(frame / fps()), depth_))
            return shoal::Error{file_, "has no distances there"};
        refiner_.refine(depth_, view(), map_);
        return Done{};
    }

  private:
    Path file_;
    std::optional<media::VideoSource> video_;
    std::optional<media::DepthTrack> track_;
    ImageRgb8 shown_;
    media::DepthFrame depth_;
    depth::DepthRefiner refiner_;
    depth::DepthMap map_;
};

class Measuring {
  public:
    explicit Measuring(Path folder) : folder_(std::move(folder)) {}

    Status add(const char* name) {
        const auto probes = readProbes(folder_ / (std::string(name) + ".tsv"));
        if (!probes) return probes.error();
        auto footage = Footage::open(name);
        if (!footage) return footage.error();
        for (const auto& [frame, places] : *probes) {
            const auto traced = media::readHdr(folder_ / fmt::format("{}_{:04d}.hdr", name, frame));
            if (!traced) return traced.error();
            if (Status s = footage->seek(frame); !s) return s;
            if (Status s = footage->show(frame); !s) return s;
            if (Status s = footage->measure(frame); !s) return s;
            light::RadiancePyramid pyramid;
            light::PyramidMaker maker;
            maker.make(traced->radianceLin, 256, pyramid);
            const double at_s = frame / footage->fps();
            const bool tunnel = at_s >= kTunnel_s[0] && at_s < kTunnel_s[1];
            const std::string scene = std::string(name) != "reef" ? name
                                      : tunnel                    ? "reef, tunnel"
                                                                  : "reef, outside";
            addFrame(fmt::format("{}\ttrue light", scene), pyramid, footage->map(), places);
            maker.make(footage->view(), 256, pyramid, light::FrameRadiance::Auto);
            addFrame(fmt::format("{}\tlight of the film", scene), pyramid, footage->map(), places);
        }
        return Done{};
    }

    Status addSunlight(const char* name) {
        const auto all = readSunlight(folder_ / (std::string(name) + ".sunlight.tsv"));
        if (!all) return all.error();
        auto footage = Footage::open(name);
        if (!footage) return footage.error();
        for (const auto& [frame, places] : *all)
            if (frame >= 2 * static_cast<int>(places[0].sunlight.size()))
                if (Status s = addSecond(*footage, frame, places, flicker_[name]); !s) return s;
        return Done{};
    }

    Status writeCaustics() const {
        std::string table = "film\tplaces\twithout\twith\tspread_found\tplace_us\n";
        for (const auto& [name, sum] : flicker_)
            table +=
                fmt::format("{}\t{}\t{:.1f}\t{:.1f}\t{:.1f}\t{:.2f}\n", name, sum.places,
                            100 * std::sqrt(sum.without / sum.values), 100 * std::sqrt(sum.with / sum.values),
                            100 * std::sqrt(sum.found / sum.values), 1e6 * sum.spent_s / sum.values);
        return writeFileWhole(folder_ / "caustics.tsv", table);
    }

    Status write() const {
        std::string table =
            "film\tlight\tway\taround\tfar_m\tplaces\tmedian\tp90\twithin_1m\tmedian\tp90\twithin_2m\tmedian"
            "\tp90\tbeyond_2m\tmedian\tp90\tplace_us\n";
        for (const auto& [key, errors] : errors_) {
            table += key;
            for (const auto& [from_m, to_m] :
                 {std::pair{0.0f, 1e9f}, {0.0f, 1.0f}, {0.0f, 2.0f}, {2.0f, 1e9f}}) {
                std::vector<double> within;
                for (const Error& e : errors)
                    if (e.nearest_m >= from_m && e.nearest_m < to_m) within.push_back(e.value);
                table += fmt::format("\t{}\t{:.1f}\t{:.1f}", within.size(), 100 * math::median(within),
                                     100 * math::quantile(within, 0.9));
            }
            const auto spent = spent_s_.find(key);
            table += fmt::format(
                "\t{:.2f}\n",
                spent == spent_s_.end() ? 0 : 1e6 * spent->second / static_cast<double>(errors.size()));
        }
        return writeFileWhole(folder_ / "bounce.tsv", table);
    }

  private:
    // Decodes two seconds of the film before the frame: the first for the mean, the second to compare.
    static Status addSecond(Footage& footage, int frame, const std::vector<SunlitPlace>& places,
                            Flicker& sum) {
        const auto second = static_cast<int>(places[0].sunlight.size());
        const auto passed_s = static_cast<float>(1 / footage.fps());
        light::RadiancePyramid pyramid;
        light::PyramidMaker maker;
        light::LightFinder finder;
        light::FoundLights lights;
        light::LightOverTime casting;
        depth::Caustics caustics;
        std::vector<std::vector<double>> found(places.size());
        if (Status s = footage.seek(frame + 1 - 2 * second); !s) return s;
        for (int at = frame + 1 - 2 * second; at <= frame; ++at) {
            if (Status s = footage.show(at); !s) return s;
            maker.make(footage.view(), 256, pyramid, light::FrameRadiance::Auto);
            finder.find(pyramid, lights);
            const glm::vec3 towards = casting.follow(lights, passed_s).light.direction;
            caustics.follow(pyramid.ofWidth(64), passed_s);
            if (at <= frame - second) continue;
            if (Status s = footage.measure(at); !s) return s;
            const double began_s = threadTime_s(); // decoding goes on beside
            for (size_t i = 0; i < places.size(); ++i)
                found[i].push_back(caustics.changeAt(places[i].place, towards, kBody_m, footage.map()));
            sum.spent_s += threadTime_s() - began_s;
        }
        for (size_t i = 0; i < places.size(); ++i) addFlicker(places[i], found[i], sum);
        return Done{};
    }

    // The light's mean over the second is not judged here; a place in the shade has little to change.
    static void addFlicker(const SunlitPlace& place, const std::vector<double>& found, Flicker& sum) {
        double mean = 0;
        for (const double value : place.sunlight) mean += value / static_cast<double>(found.size());
        for (size_t i = 0; i < found.size(); ++i) {
            const double truth = place.sunlight[i] - mean, change = found[i] * std::max(mean, 0.0);
            sum.without += truth * truth;
            sum.with += (truth - change) * (truth - change);
            sum.found += change * change;
        }
        sum.values += static_cast<double>(found.size());
        sum.places += 1;
    }

    void addFrame(const std::string& key, const light::RadiancePyramid& pyramid, const depth::DepthMap& map,
                  const std::vector<Probe>& probes) {
        const math::ShRgb& truth = probes[0].radiance; // the first is the camera's
        const math::ShRgb film = math::shProject(pyramid.ofWidth(64));
        // Factor on the film's light that brings the camera's light nearest to the truth.
        const double factor = product(film, truth) / product(film, film);
        math::ShRgb camera = film;
        for (glm::dvec3& rgb : camera) rgb *= factor;
        const auto note = [&](const std::string& way, const Probe& probe, const math::ShRgb& found) {
            errors_[key + "\t" + way].push_back({probe.nearest_m, relativeError(found, probe.radiance)});
        };
        const std::vector<Probe> fish(probes.begin() + 1, probes.end());
        for (const Probe& probe : fish) {
            note("camera\t64\t0", probe, camera);
            math::ShRgb bands = probe.radiance;
            std::fill(bands.begin() + 9, bands.end(), glm::dvec3(0));
            note("bound: true, 9 harmonics\t0\t0", probe, bands);
            // The camera's light scaled by the best single factor: the limit of one number for each animal.
            const double gain = product(camera, probe.radiance) / product(camera, camera);
            math::ShRgb brighter = camera;
            for (glm::dvec3& rgb : brighter) rgb *= gain;
            note("bound: best gain\t0\t0", probe, brighter);
        }
        depth::LightDifference beside;
        beside.make(pyramid.ofWidth(64), map);
        const std::string rays = fmt::format("rays\t64\t{:.0f}", depth::LightDifference::kFar_m);
        std::vector<depth::LightHarmonics> found(fish.size());
        const std::clock_t began = std::clock();
        for (int pass = 0; pass < kPasses; ++pass)
            for (size_t i = 0; i < fish.size(); ++i) found[i] = beside.at(fish[i].place);
        spent_s_[key + "\t" + rays] += static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC / kPasses;
        for (size_t i = 0; i < fish.size(); ++i) note(rays, fish[i], moved(camera, found[i], factor));
    }

    Path folder_;
    std::map<std::string, std::vector<Error>> errors_;
    std::map<std::string, double> spent_s_;
    std::map<std::string, Flicker> flicker_;
};

Status run(int argc, char** argv) {
    const std::string task = argc >= 3 ? argv[1] : "";
    if (task == "places") {
        Status done = Done{};
        for (const Film& film : kFilms)
            if (done) done = writePlaces(argv[2], film);
        return done;
    }
    if (task == "animals") return bench::writeAnimals(argv[2]);
    if (task == "pictures") {
        std::vector<int> frames;
        for (int i = 3; i < argc; ++i) frames.push_back(std::atoi(argv[i]));
        return bench::writePictures(argv[2], frames);
    }
    if (task != "measure" && task != "caustics")
        return shoal::Error{"",
                            "bench_bounce places FOLDER | measure FOLDER FILM... | caustics FOLDER FILM... | "
                            "animals FOLDER | pictures FOLDER FRAME..."};
    Measuring measuring(argv[2]);
    for (int i = 3; i < argc; ++i)
        if (Status s = task == "measure" ? measuring.add(argv[i]) : measuring.addSunlight(argv[i]); !s)
            return s;
    return task == "measure" ? measuring.write() : measuring.writeCaustics();
}

} // namespace

int main(int argc, char** argv) { return bench::exitStatus("bench_bounce", run(argc, argv)); }
