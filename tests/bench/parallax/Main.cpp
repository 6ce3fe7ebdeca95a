// bench_parallax FOLDER FILM.depth.mkv FPS FRAME...: compares what an eye beside the camera sees of a film
// with distances with what the ray tracer sees from there: FOLDER/reef_X_Y_Z_NNNN.hdr, X Y Z in millimetres.
// Writes FOLDER/parallax.tsv: way of drawing, movement, PSNR, and the same of what is nearer than 4 m.
#include "engine/core/WriteFile.h"
#include "engine/math/Colour.h"
#include "engine/media/Pictures.h"
#include "tests/bench/light/Timing.h"
#include "tests/bench/parallax/Views.h"

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace shoal;
using namespace shoal::bench;

constexpr int kSize = 1024; // of a view of 90 degrees: about a pixel to half a texel
constexpr float kNearby_m = 4;
// Millimetres from the camera: right, up, back.
constexpr std::array<glm::ivec3, 5> kEyes = {
    {{32, 0, 0}, {100, 0, 0}, {300, 0, 0}, {0, 0, -300}, {0, 150, 0}}};

struct Error {
    double sum = 0, count = 0;
    void add(const glm::vec3& a, const glm::vec3& b) {
        const glm::vec3 off = a - b;
        sum += glm::dot(off, off) / 3, ++count;
    }
    double psnr() const { return count > 0 ? -10 * std::log10(std::max(sum / count, 1e-10)) : 0; }
};
struct Figures {
    Error all, nearby;
    double processor_ms = 0;
    int views = 0;
};

Path tracedFile(const Path& folder, const glm::ivec3& eye_mm, int frame) {
    return folder / fmt::format("reef_{}_{}_{}_{:04d}.hdr", eye_mm.x, eye_mm.y, eye_mm.z, frame);
}

// Display values of a camera whose exposure makes the frame's mean a medium grey.
Result<ImageRgbF> readDisplay(const Path& file, float& exposure) {
    auto read = media::readHdr(file);
    if (!read) return read.error();
    ImageRgbF& image = read->radianceLin;
    if (exposure == 0) {
        double sum = 0;
        for (const float v : image.pixels) sum += v;
        exposure = static_cast<float>(0.18 * static_cast<double>(image.pixels.size()) / sum);
    }
    for (float& v : image.pixels) v = math::srgbFromLinear(std::min(v * exposure, 1.0f));
    return std::move(image);
}

// The frame as the camera sees it, with distances as the game has them: its 8 bits are the guide.
Result<Frame> readFrame(const Path& folder, media::DepthTrack& track, double time_s, int number,
                        float& exposure) {
    auto display = readDisplay(tracedFile(folder, {}, number), exposure);
    if (!display) return display.error();
    Frame frame{.display = std::move(*display)};
    ImageRgb8 coded(frame.display.width, frame.display.height);
    for (size_t i = 0; i < coded.pixels.size(); ++i)
        coded.pixels[i] = static_cast<uint8_t>(255 * frame.display.pixels[i] + 0.5f);
    media::DepthFrame depth;
    if (!track.read(track.frameAt(time_s), depth)) return shoal::Error{"the track", "is damaged"};
    depth::DepthRefiner().refine(
        depth, {coded.at(0, 0), coded.width, coded.height, coded.width * ptrdiff_t{3}, false}, frame.depth);
    depth::widenNear(frame.depth, frame.widened);
    return frame;
}

using Draw = std::function<Picture(const Frame&, const glm::vec3&, const glm::mat3&)>;
const std::vector<std::pair<const char*, Draw>> kWays = {
    {"flat", [](const Frame& f, const glm::vec3&,
                const glm::mat3& turn) { return seenFlat(f.display, turn, kSize); }},
    {"cells", [](const Frame& f, const glm::vec3& eye,
                 const glm::mat3& turn) { return seenByCells(f, eye, turn, kSize); }},
    {"search", [](const Frame& f, const glm::vec3& eye,
                  const glm::mat3& turn) { return seenBySearch(f, eye, turn, kSize); }},
    {"grid_256", [](const Frame& f, const glm::vec3& eye,
                    const glm::mat3& turn) { return seenByGrid(f, eye, turn, kSize, 4); }},
    {"grid_1024", [](const Frame& f, const glm::vec3& eye,
                     const glm::mat3& turn) { return seenByGrid(f, eye, turn, kSize, 1); }},
};

Status run(int argc, char** argv) {
    if (argc < 5) return shoal::Error{"", "bench_parallax FOLDER FILM.depth.mkv FPS FRAME..."};
    const Path folder = argv[1];
    auto track = media::DepthTrack::open(argv[2]);
    if (!track) return track.error();
    const double fps = std::atof(argv[3]);
    std::map<std::pair<size_t, size_t>, Figures> figures; // by way and movement
    for (int i = 4; i < argc; ++i) {
        const int number = std::atoi(argv[i]);
        float exposure = 0;
        const auto frame = readFrame(folder, *track, number / fps, number, exposure);
        if (!frame) return frame.error();
        for (size_t e = 0; e < kEyes.size(); ++e) {
            const auto truth = readDisplay(tracedFile(folder, kEyes[e], number), exposure);
            if (!truth) return truth.error();
            const glm::vec3 eye = 0.001f * glm::vec3(kEyes[e]);
            for (int side = 0; side < 4; ++side) { // around, looking a little down
                const glm::mat3 turn =
                    glm::mat3_cast(glm::angleAxis(static_cast<float>(side) * std::numbers::pi_v<float> / 2,
                                                  glm::vec3(0, 1, 0)) *
                                   glm::angleAxis(-0.3f, glm::vec3(1, 0, 0)));
                const Picture right = seenFlat(*truth, turn, kSize);
                for (size_t way = 0; way < kWays.size(); ++way) {
                    Figures& found = figures[{way, e}];
                    const double began = processor_ms();
                    const Picture seen = kWays[way].second(*frame, eye, turn);
                    found.processor_ms += processor_ms() - began, ++found.views;
                    for (size_t p = 0; p < seen.pixels.size(); ++p) {
                        found.all.add(seen.pixels[p], right.pixels[p]);
                        const glm::vec2 pixel(p % kSize, p / kSize);
                        const glm::vec3 ray =
                            turn * glm::vec3(2.0f * (pixel + 0.5f) / float(kSize) - 1.0f, -1);
                        if (frame->depth.inverse_perM(glm::normalize(ray)) > 1 / kNearby_m)
                            found.nearby.add(seen.pixels[p], right.pixels[p]);
                    }
                }
            }
        }
    }
    std::string table = "way\tright_mm\tup_mm\tback_mm\tpsnr_db\tnearby_psnr_db\tprocessor_ms\n";
    for (const auto& [of, found] : figures)
        table += fmt::format("{}\t{}\t{}\t{}\t{:.1f}\t{:.1f}\t{:.0f}\n", kWays[of.first].first,
                             kEyes[of.second].x, kEyes[of.second].y, kEyes[of.second].z, found.all.psnr(),
                             found.nearby.psnr(), found.processor_ms / found.views);
    std::fputs(table.c_str(), stdout);
    return writeFileWhole(folder / "parallax.tsv", table);
}

} // namespace

int main(int argc, char** argv) {
    const Status done = run(argc, argv);
    if (!done) std::fprintf(stderr, "%s\n", done.error().message().c_str());
    return done ? 0 : 1;
}
