// Films the reef (Reef.toml): make_video_frames FOLDER TASK [-- TASK]..., where a task is
//     draw                     radiance and distances, into FOLDER, at times through the film; what is there
//     stays film                     all frames, raw, 3 bytes a pixel, sRGB-coded, to standard output truth
//     TO FRAME...        TO/frame_NNNN.hdr: linear radiance before the camera, and TO/frames.toml enclosure
//     FILE.toml        when the camera is enclosed, and how much look WIDTH FRAME... PNGs
//     of some frames in FOLDER, to be looked at
// FOLDER keeps what was lit once, for the next run.
#include "content/make/video/Camera.h"
#include "content/make/video/Frame.h"
#include "content/make/video/Resize.h"
#include "content/make/video/Scene.h"

#include "engine/media/Pictures.h"

#include <cstdio>
#include <cstdlib>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <ctime>
#include <optional>

namespace {

using namespace shoal;
using namespace shoal::reef;

constexpr int kTruthWidth = 512, kMeterWidth = 128;

struct Studio {
    const Scene& scene;
    Filming& filming;
    World& world;
    const Route& route;
    Path folder;

    // Of a frame of the film, counted from its start.
    float turn(int frame) const {
        const int onPath = (frame + scene.film.start) % scene.film.frames;
        return (static_cast<float>(onPath) + 0.5f) / static_cast<float>(scene.film.frames);
    }
};

std::string numbered(const char* format, int number) {
    char text[64];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

constexpr int kCoarsest = 8;

Path keptAt(const Studio& studio, int time) { return studio.folder / numbered("drawn_%04d.bin", time); }

// Half floats: red, green, blue, distance.
Status keep(const Drawn& drawn, const Path& file) {
    std::vector<uint32_t> packed;
    packed.reserve(2 * drawn.distance.size());
    for (size_t i = 0; i < drawn.distance.size(); ++i) {
        const float* c = drawn.radianceLin.pixels.data() + 3 * i;
        const vec3 safe = glm::min(vec3(c[0], c[1], c[2]), 6e4f);
        packed.push_back(glm::packHalf2x16({safe.x, safe.y}));
        packed.push_back(glm::packHalf2x16({safe.z, drawn.distance[i]}));
    }
    return writeFileWhole(file,
                          {reinterpret_cast<const char*>(packed.data()), packed.size() * sizeof packed[0]});
}

Result<Drawn> recall(const Studio& studio, int time) {
    const int width = studio.scene.film.drawn, height = width / 2;
    Drawn drawn{ImageRgbF(width, height), std::vector<float>(static_cast<size_t>(width) * height),
                studio.route.at(static_cast<float>(time) / static_cast<float>(studio.scene.film.frames))};
    const auto bytes = readFile(keptAt(studio, time), 1u << 30);
    if (!bytes) return bytes.error();
    if (bytes->size() != drawn.distance.size() * 8)
        return Error{keptAt(studio, time).string(), "was drawn at another size; remove it"};
    const auto* packed = reinterpret_cast<const uint32_t*>(bytes->data());
    for (size_t i = 0; i < drawn.distance.size(); ++i) {
        const vec2 redGreen = glm::unpackHalf2x16(packed[2 * i]),
                   blueFar = glm::unpackHalf2x16(packed[2 * i + 1]);
        float* c = drawn.radianceLin.pixels.data() + 3 * i;
        c[0] = redGreen.x, c[1] = redGreen.y, c[2] = blueFar.x;
        drawn.distance[i] = blueFar.y;
    }
    return drawn;
}

// The times that are drawn, in frames.
std::vector<int> drawnTimes(const Studio& studio) {
    std::vector<int> times;
    for (int time = 0; time < studio.scene.film.frames; time += studio.scene.film.every)
        if (std::filesystem::exists(keptAt(studio, time))) times.push_back(time);
    return times;
}

// The meter is read every two seconds.
Result<Exposure> meter(const Studio& studio) {
    std::vector<float> readings;
    for (int time = 0; time < studio.scene.film.frames; time += 2 * studio.scene.film.fps) {
        const auto drawn = recall(studio, time);
        if (!drawn) return drawn.error();
        readings.push_back(meterReading(reduced(drawn->radianceLin, kMeterWidth)));
    }
    return Exposure{studio.scene.camera, readings};
}

// All that are missing, coarsely first: a run that is stopped leaves a film that can be shown already.
Status drawAll(const Studio& studio) {
    const Film& film = studio.scene.film;
    const int every = film.every;
    for (int spacing = kCoarsest; spacing >= every; spacing /= 2)
        for (int time = 0; time < film.frames; time += spacing) {
            if (std::filesystem::exists(keptAt(studio, time))) continue;
            const Drawn drawn = studio.filming.draw(
                static_cast<float>(time) / static_cast<float>(film.frames), film.drawn, true);
            if (Status kept = keep(drawn, keptAt(studio, time)); !kept) return kept;
            std::fprintf(stderr, "\rdrawn every %d: %d of %d, %.0f core seconds ", spacing, time, film.frames,
                         static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
        }
    std::fprintf(stderr, "\n");
    return Done{};
}

// Frames lie half a frame off the times that were drawn, or further: none is drawn itself, so that all are
// equally soft.
Status film(const Studio& studio) {
    const Film& cut = studio.scene.film;
    const std::vector<int> times = drawnTimes(studio);
    const auto exposure = meter(studio);
    if (!exposure) return exposure.error();
    std::optional<Drawn> before, after;
    int from = -1;
    for (int frame = 0; frame < cut.frames; ++frame) {
        const int onPath = (frame + cut.start) % cut.frames;
        const auto next = std::upper_bound(times.begin(), times.end(), onPath);
        const int earlier = *(next - 1), later = next == times.end() ? cut.frames : *next;
        if (earlier != from) {
            auto first = recall(studio, earlier), second = recall(studio, later % cut.frames);
            if (!first) return first.error();
            if (!second) return second.error();
            before = std::move(*first), after = std::move(*second), from = earlier;
        }
        const float turn = studio.turn(frame),
                    share = (static_cast<float>(onPath - from) + 0.5f) / static_cast<float>(later - from);
        Drawn shown = studio.filming.between(*before, *after, share, turn);
        studio.filming.addSnow(shown, turn);
        const ImageRgb8 image = develop(studio.scene.camera, shown.radianceLin, exposure->at(turn), onPath);
        if (std::fwrite(image.pixels.data(), 1, image.pixels.size(), stdout) != image.pixels.size())
            return Error{"", "the encoder stopped listening"};
    }
    return Done{};
}

Status truth(const Studio& studio, const Path& to, const std::vector<int>& frames) {
    std::string list =
        "# Frames of content/video/reef.mp4 whose linear radiance lies here as it was before the camera.\n";
    for (const int frame : frames) {
        const std::string name = numbered("frame_%04d.hdr", frame);
        Drawn drawn = studio.filming.draw(studio.turn(frame), 2 * kTruthWidth, true);
        studio.filming.addSnow(drawn, studio.turn(frame));
        const ImageRgbF image = reduced(drawn.radianceLin, kTruthWidth);
        if (Status written = media::writeHdr(to / name, image); !written) return written;
        list += "\n[[truth]]\nframe = " + std::to_string(frame) + "\nfile = \"" + name + "\"\n";
    }
    return writeFileWhole(to / "frames.toml", list);
}

// Shelter: how much of the light that open water has about it at this depth is missing.
Status enclosure(const Studio& studio, const Path& to) {
    std::string text = "# Where the film's camera is enclosed: seconds of the film, and how much, 0 (open "
                       "water) to 1 (dark); straight lines between.\nenclosure = [\n";
    const int fps = studio.scene.film.fps;
    const auto bright = [&](int frame) {
        return studio.world.ambient(studio.route.at(studio.turn(frame))).y;
    };
    float open = 0;
    for (int frame = 0; frame < studio.scene.film.frames; frame += fps) open = std::max(open, bright(frame));
    for (int frame = 0; frame <= studio.scene.film.frames; frame += fps) {
        const float amount = glm::smoothstep(0.25f, 0.9f, 1 - bright(frame) / open);
        char line[64];
        std::snprintf(line, sizeof line, "    [%d, %.2f],\n", frame / fps, static_cast<double>(amount));
        text += line;
    }
    return writeFileWhole(to, text + "]\n");
}

Status look(const Studio& studio, int width, const std::vector<int>& frames) {
    const auto exposure = meter(studio);
    if (!exposure) return exposure.error();
    std::fprintf(stderr, "path %.1f m\n", static_cast<double>(studio.route.length()));
    for (const int frame : frames) {
        const std::clock_t start = std::clock();
        Drawn picture = studio.filming.draw(studio.turn(frame), width, true);
        studio.filming.addSnow(picture, studio.turn(frame));
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
    if (task == "draw") return drawAll(studio);
    if (task == "film") return film(studio);
    if (words.size() < 2) return Error{task, "is no task, or wants more words"};
    std::vector<int> frames;
    for (size_t i = 2; i < words.size(); ++i) frames.push_back(std::atoi(words[i].c_str()));
    if (task == "truth") return truth(studio, words[1], frames);
    if (task == "enclosure") return enclosure(studio, words[1]);
    if (task == "look") return look(studio, std::atoi(words[1].c_str()), frames);
    return Error{task, "is no task"};
}

Status run(int argc, char** argv) {
    if (argc < 3) return Error{"", "wants FOLDER and tasks"};
    const auto scene = readScene(dataRoot() / "content/make/video/Reef.toml");
    if (!scene) return scene.error();
    const Route route(scene->path);
    const Path folder = argv[1];
    World world(*scene, route, folder / "lit.bin");
    Filming filming(*scene, route, world);
    const Studio studio{*scene, filming, world, route, folder};
    std::vector<std::string> words;
    for (int i = 2; i <= argc; ++i) {
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
