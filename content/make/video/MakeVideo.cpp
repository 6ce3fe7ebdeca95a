// Films the reef (Reef.toml).
//     make_video_frames FOLDER draw                     radiance and distances, into FOLDER, at times through
//     the film; what is there stays make_video_frames FOLDER film                     all frames, raw, 3
//     bytes a pixel, sRGB-coded, to standard output make_video_frames FOLDER truth TO FRAME...
//     TO/frame_NNNN.hdr: linear radiance before the camera, and TO/frames.toml make_video_frames FOLDER
//     shelter FILE.toml        when the camera is sheltered from the open sea, and how much make_video_frames
//     FOLDER look WIDTH FRAME...      PNGs of some frames in FOLDER, to be looked at
// FOLDER keeps what was lit once, for the next run.
#include "content/make/video/Camera.h"
#include "content/make/video/Frame.h"
#include "content/make/video/Resize.h"
#include "content/make/video/Scene.h"

#include "engine/media/Pictures.h"

#include <cstdio>
#include <cstdlib>
#include <glm/gtc/packing.hpp>

#include <ctime>
#include <optional>

namespace {

using namespace shoal;
using namespace shoal::reef;

constexpr int kTruthWidth = 512;

struct Studio {
    const Scene& scene;
    Filming& filming;
    World& world;
    const Route& route;
    Path folder;

    float turn(int frame) const {
        return (static_cast<float>(frame) + 0.5f) / static_cast<float>(scene.film.frames);
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

// The meter is read every two and a half seconds, on small pictures.
Exposure meter(const Studio& studio) {
    constexpr int kReadings = 24;
    std::vector<float> readings;
    for (int i = 0; i < kReadings; ++i)
        readings.push_back(
            meterReading(studio.filming.draw(static_cast<float>(i) / kReadings, 128, false).radianceLin));
    return {studio.scene.camera, readings};
}

// The finest spacing that all times are drawn at, in frames: 0 if none is.
int drawnSpacing(const Studio& studio) {
    for (int spacing = studio.scene.film.every; spacing <= kCoarsest; spacing *= 2) {
        bool all = true;
        for (int time = 0; time < studio.scene.film.frames; time += spacing)
            all = all && std::filesystem::exists(keptAt(studio, time));
        if (all) return spacing;
    }
    return 0;
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
    const Film& film = studio.scene.film;
    const int spacing = drawnSpacing(studio);
    if (!spacing) return Error{studio.folder.string(), "lacks drawn frames; run draw first"};
    const Exposure exposure = meter(studio);
    std::optional<Drawn> before, after;
    int at = -1;
    for (int frame = 0; frame < film.frames; ++frame) {
        const int time = frame / spacing * spacing;
        if (time != at) {
            if (at >= 0) before = std::move(after);
            for (auto* each : {&before, &after}) {
                if (each == &before && at >= 0) continue;
                auto read = recall(studio, (each == &before ? time : time + spacing) % film.frames);
                if (!read) return read.error();
                *each = std::move(*read);
            }
            at = time;
        }
        const float turn = studio.turn(frame),
                    share = (static_cast<float>(frame - time) + 0.5f) / static_cast<float>(spacing);
        Drawn shown = studio.filming.between(*before, *after, share, turn);
        studio.filming.addSnow(shown, turn);
        const ImageRgb8 image = develop(studio.scene.camera, shown.radianceLin, exposure.at(turn), frame);
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
Status shelter(const Studio& studio, const Path& to) {
    std::string text = "# Where the film's camera is sheltered: seconds of the film, and how much, 0 (open "
                       "water) to 1 (dark); straight lines between.\nshelter = [\n";
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
    const Exposure exposure = meter(studio);
    std::fprintf(stderr, "path %.1f m\n", static_cast<double>(studio.route.length()));
    for (const int frame : frames) {
        const std::clock_t start = std::clock();
        Drawn picture = studio.filming.draw(studio.turn(frame), width, true);
        studio.filming.addSnow(picture, studio.turn(frame));
        const std::clock_t drawn = std::clock();
        const float factor = exposure.at(studio.turn(frame));
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

Status run(int argc, char** argv) {
    if (argc < 3 || (argc < 4 && std::string(argv[2]) != "draw" && std::string(argv[2]) != "film"))
        return Error{"",
                     "wants FOLDER and draw, film, truth TO FRAME..., shelter FILE, or look WIDTH FRAME..."};
    const auto scene = readScene(dataRoot() / "content/make/video/Reef.toml");
    if (!scene) return scene.error();
    const Route route(scene->path);
    const Path folder = argv[1];
    World world(*scene, route, folder / "lit.bin");
    Filming filming(*scene, route, world);
    const Studio studio{*scene, filming, world, route, folder};
    const std::string task = argv[2];
    std::vector<int> frames;
    for (int i = 4; i < argc; ++i) frames.push_back(std::atoi(argv[i]));
    if (task == "draw") return drawAll(studio);
    if (task == "film") return film(studio);
    if (task == "truth") return truth(studio, argv[3], frames);
    if (task == "shelter") return shelter(studio, argv[3]);
    if (task == "look") return look(studio, std::atoi(argv[3]), frames);
    return Error{task, "is no task"};
}

} // namespace

int main(int argc, char** argv) {
    const Status done = run(argc, argv);
    if (!done) std::fprintf(stderr, "make_video_frames: %s\n", done.error().sentence().c_str());
    return done ? 0 : 1;
}
