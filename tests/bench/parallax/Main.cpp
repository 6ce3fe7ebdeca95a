// bench_parallax FOLDER FRAME...: compares what an eye beside the camera sees of the reef's film with its
// distances with what the ray tracer sees from there: FOLDER/reef_X_Y_Z_NNNN.hdr, X Y Z in millimetres.
// Writes FOLDER/parallax.tsv: way of drawing, movement, PSNR, and the processor's time for a view.
#include "engine/depth/DepthMap.h"
#include "engine/math/Colour.h"
#include "engine/math/LatLong.h"
#include "engine/media/Pictures.h"
#include "engine/render/BackgroundCells.h"
#include "engine/render/View.h"
#include "tests/bench/Bench.h"

#include <fmt/core.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

namespace {

using namespace shoal;
using namespace shoal::bench;

constexpr int kSize = 1024; // of a view of 90 degrees: about a pixel to half a texel
// Millimetres from the camera: right, up, back.
constexpr std::array<glm::ivec3, 5> kEyes = {
    {{32, 0, 0}, {100, 0, 0}, {300, 0, 0}, {0, 0, -300}, {0, 150, 0}}};

// A lat-long frame in display values, 0 to 1.
struct Frame {
    ImageRgbF display;
    depth::DepthMap depth, widened;
};

// Square, kSize wide; rows from the bottom, display values.
using Picture = std::vector<glm::vec3>;
constexpr size_t kPixels = size_t{kSize} * kSize;

glm::vec3 sample(const ImageRgbF& map, const glm::vec2& uv) {
    const glm::vec2 at = uv * glm::vec2(map.width, map.height) - 0.5f, low = glm::floor(at), part = at - low;
    const auto texel = [&](int x, int y) {
        const float* t = map.at((x % map.width + map.width) % map.width, std::clamp(y, 0, map.height - 1));
        return glm::vec3(t[0], t[1], t[2]);
    };
    const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), part.x),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), part.x), part.y);
}

// Returns the ray from the eye to a pixel's middle on the image plane.
glm::vec3 rayOf(const glm::vec2& pixel, const glm::mat3& envFromEye) {
    return envFromEye * glm::vec3(2.0f * (pixel + 0.5f) / float(kSize) - 1.0f, -1);
}

// colourOf(ray in the env frame)
template <class Colour> Picture everyPixel(const glm::mat3& envFromEye, const Colour& colourOf) {
    Picture picture;
    picture.reserve(kPixels);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) picture.push_back(colourOf(rayOf({x, y}, envFromEye)));
    return picture;
}

struct Vertex {
    glm::vec3 place; // eye frame
    glm::vec2 uv;
};

// Draws a perspective-correct triangle with a depth test; skips it if it reaches behind the image plane.
void fill(const std::array<Vertex, 3>& corners, const ImageRgbF& map, Picture& picture,
          std::vector<float>& nearest) {
    constexpr float kNear_m = 0.01f;
    std::array<glm::vec3, 3> at; // pixels, and one over the distance ahead
    for (size_t i = 0; i < 3; ++i) {
        const glm::vec3& p = corners[i].place;
        if (-p.z < kNear_m) return;
        const glm::vec2 plane = glm::vec2(p.x, p.y) / -p.z;
        at[i] = glm::vec3((plane * 0.5f + 0.5f) * float(kSize) - 0.5f, -1 / p.z);
    }
    const glm::vec2 a(at[0]), b(at[1]), c(at[2]);
    const auto cross = [](const glm::vec2& u, const glm::vec2& v) { return u.x * v.y - u.y * v.x; };
    const float area = cross(b - a, c - a);
    if (area == 0) return;
    const glm::vec2 low = glm::max(glm::ceil(glm::min(glm::min(a, b), c)), 0.0f);
    const glm::vec2 high = glm::min(glm::floor(glm::max(glm::max(a, b), c)), float(kSize - 1));
    for (float y = low.y; y <= high.y; ++y)
        for (float x = low.x; x <= high.x; ++x) {
            const glm::vec2 p(x, y);
            const glm::vec3 weight =
                glm::vec3(cross(c - b, p - b), cross(a - c, p - c), cross(b - a, p - a)) / area;
            if (weight.x < 0 || weight.y < 0 || weight.z < 0) continue;
            const glm::vec3 shares = weight * glm::vec3(at[0].z, at[1].z, at[2].z);
            const float inverse = shares.x + shares.y + shares.z;
            const size_t pixel = static_cast<size_t>(y) * kSize + static_cast<size_t>(x);
            if (inverse <= nearest[pixel]) continue;
            nearest[pixel] = inverse;
            const glm::vec2 uv =
                (corners[0].uv * shares.x + corners[1].uv * shares.y + corners[2].uv * shares.z) / inverse;
            picture[pixel] = sample(map, uv);
        }
}

// Returns a square view of 90 degrees from the camera.
Picture seenFlat(const ImageRgbF& display, const glm::mat3& envFromEye) {
    return everyPixel(envFromEye, [&](const glm::vec3& ray) {
        return sample(display, latLongFromDirection(glm::normalize(ray)));
    });
}

// Returns the view by the same search for every pixel.
Picture seenBySearch(const Frame& frame, const glm::vec3& eyeInFilm, const glm::mat3& envFromEye) {
    return everyPixel(envFromEye, [&](const glm::vec3& ray) {
        const glm::vec3 seen = depth::filmDirectionSeen(frame.widened, eyeInFilm, glm::normalize(ray));
        return sample(frame.display, latLongFromDirection(seen));
    });
}

// Returns the view by render::BackgroundCells: searches at cells' corners, interpolates between them.
Picture seenByCells(const Frame& frame, const glm::vec3& eyeInFilm, const glm::mat3& envFromEye) {
    render::View view;
    view.verticalFov = std::numbers::pi_v<float> / 2;
    view.aspect = 1;
    render::BackgroundCells cells;
    cells.make(view, envFromEye, {kSize, kSize}, {&frame.widened, eyeInFilm});
    Picture picture(kPixels);
    for (const render::BackgroundCell& cell : cells.all())
        for (int y = cell.low.y; y < cell.high.y; ++y)
            for (int x = cell.low.x; x < cell.high.x; ++x) {
                const glm::vec2 share =
                    (glm::vec2(x, y) + 0.5f - glm::vec2(cell.low)) / glm::vec2(cell.high - cell.low);
                glm::vec2 uv = cell.first + share.x * cell.right + share.y * cell.up;
                if (cell.polar) {
                    const auto& d = cell.directions;
                    uv = latLongFromDirection(glm::normalize(
                        glm::mix(glm::mix(d[0], d[1], share.x), glm::mix(d[2], d[3], share.x), share.y)));
                }
                picture[static_cast<size_t>(y) * kSize + x] = sample(frame.display, uv);
            }
    return picture;
}

// Returns the view of a mesh over the sphere, drawn with a depth buffer: a vertex for each kStep texels of
// the map, at its distance. Stretched triangles cover what lies behind an edge.
template <int kStep>
Picture seenByGrid(const Frame& frame, const glm::vec3& eyeInFilm, const glm::mat3& envFromEye) {
    constexpr float kFurthest_m = 100; // distance that stands for infinity
    const int across = frame.depth.inverse.width / kStep, down = frame.depth.inverse.height / kStep;
    const glm::mat3 eyeFromEnv = glm::transpose(envFromEye);
    std::vector<Vertex> vertices;
    for (int y = 0; y <= down; ++y)
        for (int x = 0; x <= across; ++x) {
            const glm::vec2 uv(static_cast<float>(x) / static_cast<float>(across),
                               static_cast<float>(y) / static_cast<float>(down));
            const glm::vec3 direction = directionFromLatLong(uv);
            const float away = std::min(1 / frame.depth.inverse_perM(direction), kFurthest_m);
            vertices.push_back({eyeFromEnv * (direction * away - eyeInFilm), uv});
        }
    Picture picture(kPixels);
    std::vector<float> nearest(kPixels, 0);
    for (int y = 0; y < down; ++y)
        for (int x = 0; x < across; ++x) {
            const auto corner = [&](int dx, int dy) {
                return vertices[static_cast<size_t>(y + dy) * (across + 1) + x + dx];
            };
            fill({corner(0, 0), corner(1, 0), corner(0, 1)}, frame.display, picture, nearest);
            fill({corner(1, 0), corner(1, 1), corner(0, 1)}, frame.display, picture, nearest);
        }
    return picture;
}

struct Figures {
    double squares = 0, processor_ms = 0; // squares: sum over the views of their mean squared error
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
    if (!track.read(track.frameAt(time_s), depth)) return Error{"the track", "is damaged"};
    depth::DepthRefiner().refine(
        depth, {coded.at(0, 0), coded.width, coded.height, coded.width * ptrdiff_t{3}, false}, frame.depth);
    depth::widenNear(frame.depth, frame.widened);
    return frame;
}

using Draw = Picture (*)(const Frame&, const glm::vec3& eyeInFilm, const glm::mat3& envFromEye);
constexpr std::pair<const char*, Draw> kWays[] = {
    {"flat",
     [](const Frame& f, const glm::vec3&, const glm::mat3& turn) { return seenFlat(f.display, turn); }},
    {"cells", seenByCells},
    {"search", seenBySearch},
    {"grid_256", seenByGrid<4>},
    {"grid_1024", seenByGrid<1>},
};

Status run(int argc, char** argv) {
    if (argc < 3) return Error{"", "bench_parallax FOLDER FRAME..."};
    const Path folder = argv[1];
    auto track = media::DepthTrack::open(dataRoot() / "content/video/reef.depth.mkv");
    if (!track) return track.error();
    constexpr double kFps = 24;
    std::map<std::pair<size_t, size_t>, Figures> figures; // by way and movement
    for (int i = 2; i < argc; ++i) {
        const int number = std::atoi(argv[i]);
        float exposure = 0;
        const auto frame = readFrame(folder, *track, number / kFps, number, exposure);
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
                const Picture right = seenFlat(*truth, turn);
                for (size_t way = 0; way < std::size(kWays); ++way) {
                    Figures& found = figures[{way, e}];
                    const double began = processor_ms();
                    const Picture seen = kWays[way].second(*frame, eye, turn);
                    found.processor_ms += processor_ms() - began, ++found.views;
                    for (size_t p = 0; p < kPixels; ++p) {
                        const glm::dvec3 off(seen[p] - right[p]);
                        found.squares += glm::dot(off, off) / (3 * kPixels);
                    }
                }
            }
        }
    }
    std::string table = "way\tright_mm\tup_mm\tback_mm\tpsnr_db\tprocessor_ms\n";
    for (const auto& [of, found] : figures)
        table += fmt::format("{}\t{}\t{}\t{}\t{:.1f}\t{:.0f}\n", kWays[of.first].first, kEyes[of.second].x,
                             kEyes[of.second].y, kEyes[of.second].z,
                             -10 * std::log10(found.squares / found.views), found.processor_ms / found.views);
    return writeFileWhole(folder / "parallax.tsv", table);
}

} // namespace

int main(int argc, char** argv) { return exitStatus("bench_parallax", run(argc, argv)); }
