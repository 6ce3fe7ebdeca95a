// Program that makes a scene's film; kUsage lists its tasks.
#include "content/make/video/Camera.h"
#include "content/make/video/Depth.h"
#include "content/make/video/Frame.h"
#include "content/make/video/Kept.h"
#include "content/make/video/Resize.h"
#include "content/make/video/Scene.h"
#include "engine/core/WriteFile.h"
#include "engine/math/LatLong.h"
#include "engine/math/SphericalHarmonics.h"
#include "engine/media/Ffmpeg.h"
#include "engine/media/Pictures.h"

extern "C" {
#include <libavutil/mem.h>
}

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <optional>
#include <sstream>

namespace {

using namespace shoal;
using namespace shoal::reef;

constexpr const char* kUsage = R"(make_video_frames SCENE FOLDER TASK [-- TASK]...
SCENE.toml lies beside this program's source; FOLDER keeps traced frames and what was lit once. A task is
    draw [EVERY [FIRST COUNT]]   traces the frames of radiance and distances that FOLDER lacks, or only each so many,
                                 and only of a part of the path
    film [FIRST COUNT]           frames, raw, 3 bytes a pixel, sRGB-coded, to standard output
    size                         width of these frames and frames a second, to standard output
    truth NAME FRAME...          NAME_NNNN.hdr: linear radiance before the camera
    beside NAME WIDTH X Y Z FRAME...   NAME_NNNN.hdr: the same from so many millimetres beside the camera
    animal MESH NAME WIDTH FRAME...    NAME_NNNN.hdr: the same before the camera, with an animal there; lines of MESH: v with
                                 millimetres right, up, back, a normal and an albedo; f with three vertices, from 0
    probes PLACES FILE.tsv       the light at places beside the camera: for each line of PLACES, frame and millimetres
                                 right, up, back, what it stands at and the radiance there on spherical harmonics
    sunlight PLACES FILE.tsv     the sun's light there in each frame of the last second, of what a level sea lets through
    depth FILE.mkv FILM...       the track of distances that belongs to these versions of the film
    depths NAME WIDTH FRAME...   NAME_NNNN.depth.mkv: distances of single frames, as many as the film has pixels
    look WIDTH FRAME...          PNGs of some frames in FOLDER, to be looked at
)";

constexpr int kTruthWidth = 512, kMeterWidth = 128, kProbeWidth = 256;
// The depth track's size and rate; tests/bench/figures/depth.md gives the reasons.
constexpr int kDepthWidth = 256, kDepthEvery = 2; // texels around, frames of the film
constexpr int kDepthRays = 9;

struct Studio {
    const Scene& scene;
    Filming& filming;
    World& world;
    const Route& route;
    Path folder;

    // Returns the film's shift against the traced frames, in frames: 0 if each of its frames is traced, else
    // a half, so that all are equally soft.
    float offset() const { return scene.film.every == 1 ? 0.0f : 0.5f; }
    int onPath(int frame) const { return (frame + scene.film.start) % scene.film.frames; }
    // Returns the share of the loop, 0 to 1, at a frame counted from the film's start.
    float turn(int frame) const {
        return (static_cast<float>(onPath(frame)) + offset()) / static_cast<float>(scene.film.frames);
    }
};

std::string numbered(const char* format, int number) {
    char text[64];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

constexpr int kCoarsest = 8;

Path keptAt(const Studio& studio, int time) { return studio.folder / numbered("drawn_%04d.nut", time); }

Result<Drawn> recall(const Studio& studio, int time) {
    auto drawn = reef::recall(keptAt(studio, time), studio.scene.film.drawn);
    if (drawn)
        drawn->camera =
            studio.route.at(static_cast<float>(time) / static_cast<float>(studio.scene.film.frames));
    return drawn;
}

// Returns the times, in frames of the path, whose traced frames are on disk.
std::vector<int> drawnTimes(const Studio& studio) {
    std::vector<int> times;
    for (int time = 0; time < studio.scene.film.frames; time += studio.scene.film.every)
        if (std::filesystem::exists(keptAt(studio, time))) times.push_back(time);
    return times;
}

// Takes meter readings every two seconds; if no frame is traced at these times, one of the nearest frame.
Result<Exposure> meter(const Studio& studio, int at) {
    std::vector<float> readings;
    for (int time = 0; time < studio.scene.film.frames; time += 2 * studio.scene.film.fps) {
        if (!std::filesystem::exists(keptAt(studio, time))) continue;
        const auto drawn = recall(studio, time);
        if (!drawn) return drawn.error();
        readings.push_back(meterReading(reduced(drawn->radianceLin, kMeterWidth)));
    }
    if (const std::vector<int> times = drawnTimes(studio); readings.empty() && !times.empty()) {
        const auto nearest =
            std::ranges::min_element(times, {}, [&](int time) { return std::abs(time - at); });
        const auto drawn = recall(studio, *nearest);
        if (!drawn) return drawn.error();
        readings.push_back(meterReading(reduced(drawn->radianceLin, kMeterWidth)));
    }
    if (readings.empty()) readings.push_back(studio.scene.camera.mean.value_or(0));
    return Exposure{studio.scene.camera, readings};
}

// Traces all missing frames, widely spaced ones first, so that a stopped run leaves a film that can be shown.
Status drawAll(const Studio& studio, int every, int first, int count) {
    const Film& film = studio.scene.film;
    for (int spacing = kCoarsest; spacing >= every; spacing /= 2)
        for (int time = 0; time < film.frames; time += spacing) {
            if (time < first || time >= first + count || std::filesystem::exists(keptAt(studio, time)))
                continue;
            const Drawn drawn = studio.filming.draw(
                static_cast<float>(time) / static_cast<float>(film.frames), film.drawn, true);
            if (Status kept = keep(drawn, keptAt(studio, time)); !kept) return kept;
            std::fprintf(stderr, "\rdrawn every %d: %d of %d, %.0f core seconds ", spacing, time, film.frames,
                         static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
        }
    std::fprintf(stderr, "\n");
    return Done{};
}

// Frames that were not traced are interpolated from the traced ones before and after them.
Status film(const Studio& studio, int first, int count) {
    const Film& cut = studio.scene.film;
    const std::vector<int> times = drawnTimes(studio);
    const auto exposure = meter(studio, studio.onPath(first));
    if (!exposure) return exposure.error();
    std::optional<Drawn> before, after;
    int from = -1, ahead = -1;
    for (int frame = first; frame < first + count; ++frame) {
        const int onPath = studio.onPath(frame);
        const auto next = std::upper_bound(times.begin(), times.end(), onPath);
        const int earlier = *(next - 1), later = next == times.end() ? cut.frames : *next;
        if (earlier != from) {
            auto one = earlier == ahead && after ? Result<Drawn>(std::move(*after)) : recall(studio, earlier);
            if (!one) return one.error();
            before = std::move(*one), after.reset(), from = earlier;
        }
        const bool traced = earlier == onPath && studio.offset() == 0;
        if (!traced && !after) {
            auto one = recall(studio, later % cut.frames);
            if (!one) return one.error();
            after = std::move(*one), ahead = later;
        }
        const float turn = studio.turn(frame), share = (static_cast<float>(onPath - from) + studio.offset()) /
                                                       static_cast<float>(later - from);
        Drawn shown = traced ? *before : studio.filming.between(*before, *after, share, turn);
        studio.filming.addSpecks(shown, turn);
        const ImageRgb8 image = develop(studio.scene.camera, shown.radianceLin, exposure->at(turn), onPath);
        if (std::fwrite(image.pixels.data(), 1, image.pixels.size(), stdout) != image.pixels.size())
            return Error{"", "the encoder stopped listening"};
    }
    return Done{};
}

Status truth(const Studio& studio, const std::string& name, const std::vector<int>& frames) {
    for (const int frame : frames) {
        Drawn drawn = studio.filming.draw(studio.turn(frame), 2 * kTruthWidth, true);
        studio.filming.addSpecks(drawn, studio.turn(frame));
        const ImageRgbF image = reduced(drawn.radianceLin, kTruthWidth);
        if (Status written = media::writeHdr(name + numbered("_%04d.hdr", frame), image); !written)
            return written;
    }
    return Done{};
}

Status beside(const Studio& studio, const std::string& name, int width, const vec3& metres,
              const std::vector<int>& frames) {
    for (const int frame : frames) {
        const Drawn drawn = studio.filming.draw(studio.turn(frame), width, true, metres);
        if (Status s = media::writeHdr(name + numbered("_%04d.hdr", frame), drawn.radianceLin); !s) return s;
    }
    return Done{};
}

Result<Mesh> readAnimal(const Path& file) {
    const auto text = readText(file, 64u << 20);
    if (!text) return text.error();
    Mesh mesh;
    std::istringstream lines(*text);
    for (std::string kind; lines >> kind;) {
        Vertex v;
        v.kind = Kind::Animal;
        glm::uvec3 t(0);
        if (kind == "v" && lines >> v.p.x >> v.p.y >> v.p.z >> v.normal.x >> v.normal.y >> v.normal.z >>
                               v.albedo.x >> v.albedo.y >> v.albedo.z) {
            v.p *= 0.001f;
            mesh.add(v);
        } else if (kind == "f" && lines >> t.x >> t.y >> t.z &&
                   std::max({t.x, t.y, t.z}) < mesh.vertices.size())
            mesh.triangles.push_back(t);
        else
            return Error{file, "is not a mesh of this program"};
    }
    return mesh;
}

Status animal(const Studio& studio, const Path& file, const std::string& name, int width,
              const std::vector<int>& frames) {
    const auto mesh = readAnimal(file);
    if (!mesh) return mesh.error();
    for (const int frame : frames) {
        Mesh there = *mesh;
        for (Vertex& v : there.vertices) v.p += studio.route.at(studio.turn(frame));
        studio.world.putAnimal(std::move(there));
        const Drawn drawn = studio.filming.draw(studio.turn(frame), width, true);
        if (Status s = media::writeHdr(name + numbered("_%04d.hdr", frame), drawn.radianceLin); !s) return s;
    }
    return Done{};
}

// Returns the distance that is undercut in 1 % of all directions: that of walls rather than of single leaves.
float nearest_m(const Drawn& drawn) {
    std::vector<std::pair<float, double>> seen; // metres, steradians
    const int width = drawn.radianceLin.width, height = drawn.radianceLin.height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            seen.emplace_back(drawn.distance[static_cast<size_t>(y) * width + x],
                              texelSolidAngle(y, width, height));
    std::ranges::sort(seen);
    double within = 0;
    for (const auto& [metres, solidAngle] : seen)
        if ((within += solidAngle) > 0.04 * std::numbers::pi) return metres;
    return seen.back().first;
}

Status probes(const Studio& studio, const Path& from, const Path& to) {
    const auto places = readText(from, 1 << 20);
    if (!places) return places.error();
    std::string table;
    std::istringstream lines(*places);
    int frame = 0;
    for (vec3 mm(0); lines >> frame >> mm.x >> mm.y >> mm.z;) {
        const Drawn drawn = studio.filming.draw(studio.turn(frame), kProbeWidth, false, 0.001f * mm);
        table += fmt::format("{}\t{}\t{}\t{}\t{:.3f}", frame, mm.x, mm.y, mm.z, nearest_m(drawn));
        for (const glm::dvec3& rgb : math::shProject(drawn.radianceLin))
            table += fmt::format("\t{:.6g}\t{:.6g}\t{:.6g}", rgb.r, rgb.g, rgb.b);
        table += '\n';
    }
    return writeFileWhole(to, table);
}

// The mean over five points of a body 20 cm long; places keep their distance from the camera.
Status sunlight(const Studio& studio, const Path& from, const Path& to) {
    const auto places = readText(from, 1 << 20);
    if (!places) return places.error();
    std::string table;
    std::istringstream lines(*places);
    Sea sea(studio.scene);
    std::vector<Caustics> second(static_cast<size_t>(studio.scene.film.fps), Caustics(studio.scene));
    const int frames = static_cast<int>(second.size());
    int frame = 0, last = -1;
    for (vec3 mm(0); lines >> frame >> mm.x >> mm.y >> mm.z;) {
        for (int i = 0; i < frames && frame != last; ++i) {
            sea.advance(studio.turn(frame - frames + 1 + i));
            second[static_cast<size_t>(i)].advance(sea);
        }
        last = frame;
        table += fmt::format("{}\t{}\t{}\t{}", frame, mm.x, mm.y, mm.z);
        for (int i = 0; i < frames; ++i) {
            const vec3 middle = studio.route.at(studio.turn(frame - frames + 1 + i)) + 0.001f * mm;
            float sum = 0;
            for (int k = -2; k <= 2; ++k) {
                const vec3 p = middle + 0.05f * static_cast<float>(k) * vec3(0.8f, 0, 0.6f);
                sum += second[static_cast<size_t>(i)].at(p) * studio.world.sunlit(p);
            }
            table += fmt::format("\t{:.4f}", sum / 5);
        }
        table += '\n';
    }
    return writeFileWhole(to, table);
}

Status depth(const Studio& studio, const Path& to, const std::vector<std::string>& films) {
    std::vector<std::string> identities;
    for (const std::string& film : films) {
        const auto identity = media::filmIdentity(film);
        if (!identity) return identity.error();
        identities.push_back(*identity);
    }
    const Film& film = studio.scene.film;
    auto track = media::DepthTrackWriter::make({kDepthWidth, kDepthWidth / 2, film.frames / kDepthEvery,
                                                static_cast<double>(film.frames) / film.fps},
                                               identities);
    if (!track) return track.error();
    for (int i = 0; i < film.frames / kDepthEvery; ++i) {
        const float turn = studio.turn(i * kDepthEvery);
        const media::DepthFrame traced = traceDepth(studio.world, studio.route, turn, kDepthWidth, kDepthRays,
                                                    media::kDepthStepsPerOctave);
        if (Status s = track->add(traced); !s) return s;
        if (i % film.fps == 0) std::fprintf(stderr, "\rdepth: %d of %d ", i * kDepthEvery, film.frames);
    }
    std::fprintf(stderr, "\n");
    return track->finish(to);
}

Status depths(const Studio& studio, const std::string& name, int width, const std::vector<int>& frames) {
    for (const int frame : frames) {
        auto track = media::DepthTrackWriter::make({width, width / 2, 1, 1}, {});
        if (!track) return track.error();
        const float turn = studio.turn(frame);
        const media::DepthFrame traced =
            traceDepth(studio.world, studio.route, turn, width, 1, media::kExactDepthSteps);
        if (Status s = track->add(traced); !s) return s;
        if (Status s = track->finish(name + numbered("_%04d.depth.mkv", frame)); !s) return s;
    }
    return Done{};
}

Status look(const Studio& studio, int width, const std::vector<int>& frames) {
    const auto exposure = meter(studio, 0);
    if (!exposure) return exposure.error();
    std::fprintf(stderr, "path %.1f m\n", static_cast<double>(studio.route.length()));
    for (const int frame : frames) {
        const std::clock_t start = std::clock();
        Drawn picture = studio.filming.draw(studio.turn(frame), width, true);
        studio.filming.addSpecks(picture, studio.turn(frame));
        const std::clock_t drawn = std::clock();
        const float factor = exposure->at(studio.turn(frame));
        const ImageRgb8 image = develop(studio.scene.camera, picture.radianceLin, factor, frame);
        std::fprintf(stderr, "frame %d: %.2f + %.2f core seconds, exposure %.2f\n", frame,
                     static_cast<double>(drawn - start) / CLOCKS_PER_SEC,
                     static_cast<double>(std::clock() - drawn) / CLOCKS_PER_SEC, static_cast<double>(factor));
        if (Status written = media::writePng(studio.folder / numbered("look_%04d.png", frame), image);
            !written)
            return written;
    }
    return Done{};
}

// words: a task's name and what it wants.
Status perform(const Studio& studio, const std::vector<std::string>& words) {
    const std::string task = words.empty() ? "" : words[0];
    const int frames = studio.scene.film.frames;
    const auto wordOr = [&](size_t i, int other) {
        return i < words.size() ? std::atoi(words[i].c_str()) : other;
    };
    if (task == "draw") {
        studio.world.lightOnce(studio.folder / "lit.bin");
        const int every = std::max(wordOr(1, 1), studio.scene.film.every);
        return drawAll(studio, every, wordOr(2, 0), wordOr(3, frames));
    }
    if (task == "film") {
        studio.world.lightOnce(studio.folder / "lit.bin");
        return film(studio, wordOr(1, 0), wordOr(2, frames));
    }
    if (task == "size") {
        std::printf("%d %d\n", studio.scene.film.drawn, studio.scene.film.fps);
        return Done{};
    }
    if (words.size() < 2) return Error{task, "is no task, or wants more words"};
    std::vector<int> named;
    for (size_t i = 2; i < words.size(); ++i) named.push_back(std::atoi(words[i].c_str()));
    if (task == "depth") return depth(studio, words[1], {words.begin() + 2, words.end()});
    if (task == "depths" && named.size() > 1)
        return depths(studio, words[1], named[0], {named.begin() + 1, named.end()});
    if (task == "sunlight" && words.size() == 3) return sunlight(studio, words[1], words[2]);
    studio.world.lightOnce(studio.folder / "lit.bin");
    if (task == "beside" && named.size() > 4) {
        const vec3 metres = 0.001f * vec3(named[1], named[2], named[3]);
        return beside(studio, words[1], named[0], metres, {named.begin() + 4, named.end()});
    }
    if (task == "animal" && words.size() > 4)
        return animal(studio, words[1], words[2], named[1], {named.begin() + 2, named.end()});
    if (task == "probes" && words.size() == 3) return probes(studio, words[1], words[2]);
    if (task == "truth") return truth(studio, words[1], named);
    if (task == "look") return look(studio, std::atoi(words[1].c_str()), named);
    return Error{task, "is no task"};
}

Status run(int argc, char** argv) {
    if (argc < 4) return Error{"", kUsage};
    media::setUpDecoders();
    av_max_alloc(size_t{2} << 30); // FFV1's encoder takes memory for the largest frame that could come
    const auto scene = readScene(dataRoot() / "content/make/video" / (std::string(argv[1]) + ".toml"));
    if (!scene) return scene.error();
    const Route route(scene->path);
    const Path folder = argv[2];
    World world(*scene, route);
    Filming filming(*scene, route, world);
    const Studio studio{*scene, filming, world, route, folder};
    std::vector<std::string> words;
    for (int i = 3; i <= argc; ++i) {
        if (i < argc && std::string(argv[i]) != "--") {
            words.emplace_back(argv[i]);
            continue;
        }
        if (Status done = perform(studio, words); !done) return done;
        words.clear();
    }
    return Done{};
}

} // namespace

int main(int argc, char** argv) {
    const Status done = run(argc, argv);
    if (!done) std::fprintf(stderr, "make_video_frames: %s\n", done.error().message().c_str());
    return done ? 0 : 1;
}
