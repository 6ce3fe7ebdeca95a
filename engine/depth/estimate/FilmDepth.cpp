#include "engine/depth/estimate/FilmDepth.h"

#include "engine/core/Hash.h"
#include "engine/core/WriteFile.h"
#include "engine/depth/estimate/CubeFlow.h"
#include "engine/depth/estimate/StereoDepth.h"
#include "engine/math/LatLong.h"
#include "engine/media/DepthTrack.h"
#include "engine/media/Pictures.h"
#include "engine/media/VideoPlayer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <fstream>
#include <optional>

namespace shoal::depth {

namespace {

constexpr int kWidth = 256, kHeight = 128; // of a track
constexpr size_t kTexels = size_t{kWidth} * kHeight;
constexpr int kStep = 2;               // film frames for each of the track
constexpr int kMaxGap = 32;            // film frames between the two of a pair
constexpr double kGoodParallax = 0.02; // radians; more makes flow fail at edges
constexpr float kCodes = 16384;        // of an inverse distance of 1 in records
constexpr int64_t kMaxFrames = 1'000'000;

// What is kept of a track frame in OUT.part. Plain bytes of this machine: a file of another is begun anew.
struct Record {
    double towards[3] = {}, secondFromFirst[9] = {};
    double height = 0;       // of the camera over what lies below it, in baselines of the pair; 0: not known
    double logRatio = 0;     // of this pair's baseline to that of the pair which ends here
    double ratioWeight = 0;  // 0: not known
    double parallax_rad = 0; // 0: nothing was found
    uint16_t inverse[kTexels] = {};
    uint8_t confidence[kTexels] = {};
    uint8_t unused[8] = {};
    uint64_t check = 0; // FNV-1a of all before
};

uint64_t checkOf(const Record& record) {
    Hash hash;
    hash.bytes(&record, offsetof(Record, check));
    return hash.value();
}

double median(std::vector<double>& values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

glm::vec3 directionAt(size_t i) {
    return directionFromLatLong(glm::vec2((static_cast<float>(i % kWidth) + 0.5f) / kWidth,
                                          (static_cast<float>(i / kWidth) + 0.5f) / kHeight));
}

light::FrameView eyeOf(const media::VideoFrame& frame, int eye) {
    const ImageRgb8& pixels = frame.pixelsBgr;
    const media::EyePart part = media::eyePart(frame.layout, eye, pixels.width, pixels.height);
    return {pixels.at(part.x, part.y), part.width, part.height, static_cast<ptrdiff_t>(pixels.width) * 3,
            true};
}

// Both frames of a pair, each with distances in units of the pair's baseline.
struct PairDepth {
    RelativePose pose;
    DepthEstimate first, second;
};

void triangulateAll(const RelativePose& pose, const std::vector<FlowPoint>& flow, DepthEstimate& out) {
    out.inverse.assign(kTexels, 0);
    out.confidence.assign(kTexels, 0);
    for (size_t i = 0; i < kTexels; ++i) {
        if (flow[i].error_rad >= 1 || !isTranslation(pose)) continue;
        const Triangulated t = triangulate(pose, {glm::dvec3(directionAt(i)), glm::dvec3(flow[i].second)});
        if (t.parallax_rad <= 0) continue;
        out.inverse[i] = static_cast<float>(std::clamp(t.inverse, 0.0, 3.9));
        const double error_rad = 4e-4 + std::abs(t.offPlane_rad) + static_cast<double>(flow[i].error_rad);
        const double atEnds =
            std::clamp((t.sinToMovement - 0.12) / 0.15, 0.0, 1.0); // nothing to measure there
        out.confidence[i] =
            static_cast<float>(atEnds * std::clamp(1.2 - 3 * error_rad / t.parallax_rad, 0.0, 1.0));
    }
}

PairDepth estimatePair(CubeFlow& flow, const CubeFaces& first, const CubeFaces& second) {
    constexpr size_t kEvery = 23; // texels for each that the pose is found from
    PairDepth result;
    std::vector<FlowPoint> there, back;
    flow.match(first, second, kWidth, there, back);
    std::vector<Correspondence> points;
    size_t next = 0;
    for (size_t i = 0; i < kTexels; ++i) {
        // As dense on the sphere everywhere.
        const double ring = std::cos((0.5 - (static_cast<double>(i / kWidth) + 0.5) / kHeight) * 3.14159265);
        const auto stride = static_cast<size_t>(static_cast<double>(kEvery) / std::max(ring, 0.05));
        if (i < next || there[i].error_rad > 0.004f) continue;
        next = i + stride;
        points.push_back(
            {glm::normalize(glm::dvec3(directionAt(i))), glm::normalize(glm::dvec3(there[i].second))});
    }
    result.pose = relativePose(points);
    triangulateAll(result.pose, there, result.first);
    triangulateAll(inverted(result.pose), back, result.second);
    return result;
}

double heightBelow(const DepthEstimate& depth) {
    std::vector<double> heights;
    for (size_t i = 0; i < kTexels; ++i) {
        const glm::vec3 dir = directionAt(i);
        if (dir.y < -0.5f && depth.confidence[i] > 0.5f && depth.inverse[i] > 1e-4f)
            heights.push_back(static_cast<double>(-dir.y / depth.inverse[i]));
    }
    return heights.size() < 100 ? 0 : median(heights);
}

// Joins what the pair that begins at a frame and the one that ends there say, in the first's baseline.
Record joined(const PairDepth* begins, const PairDepth* ends) {
    Record record;
    const bool hasFirst = begins && isTranslation(begins->pose), hasLast = ends && isTranslation(ends->pose);
    DepthEstimate depth{std::vector<float>(kTexels), std::vector<float>(kTexels)};
    double ratio = 1;
    if (hasFirst && hasLast) {
        std::vector<double> ratios;
        for (size_t i = 0; i < kTexels; ++i)
            if (std::min(begins->first.confidence[i], ends->second.confidence[i]) > 0.6f &&
                ends->second.inverse[i] > 0)
                ratios.push_back(
                    std::log(static_cast<double>(begins->first.inverse[i] / ends->second.inverse[i])));
        if (ratios.size() > 200) {
            record.ratioWeight = 1;
            record.logRatio = median(ratios);
        }
        ratio = std::exp(record.logRatio);
    }
    for (size_t i = 0; i < kTexels; ++i) {
        const float a = hasFirst ? begins->first.confidence[i] : 0,
                    b = hasLast ? ends->second.confidence[i] : 0;
        if (a + b <= 0) continue;
        const float u = hasFirst ? begins->first.inverse[i] : 0;
        const float v = hasLast ? ends->second.inverse[i] * static_cast<float>(ratio) : 0;
        depth.inverse[i] = (a * u + b * v) / (a + b);
        if (hasFirst && hasLast) { // they have to agree where both know something
            const float off = std::abs(u - v) / std::max(depth.inverse[i], 1e-4f);
            const float agree = std::clamp(1.5f - 5 * off, 0.0f, 1.0f);
            depth.confidence[i] = a > 0.2f && b > 0.2f ? std::max(a, b) * agree : 0.7f * std::max(a, b);
        } else
            depth.confidence[i] = 0.8f * std::max(a, b);
    }
    if (hasFirst || hasLast) {
        const RelativePose& pose = hasFirst ? begins->pose : ends->pose;
        record.parallax_rad = pose.parallax_rad;
        std::memcpy(record.towards, &pose.towards, sizeof record.towards);
        std::memcpy(record.secondFromFirst, &pose.secondFromFirst, sizeof record.secondFromFirst);
        record.height = heightBelow(depth);
        // Distances are in baselines of the pair that ends here: theirs is this frame's.
        if (!hasFirst) record.ratioWeight = 100;
    }
    for (size_t i = 0; i < kTexels; ++i) {
        record.inverse[i] = static_cast<uint16_t>(std::clamp(depth.inverse[i] * kCodes, 0.0f, 65535.0f));
        record.confidence[i] = static_cast<uint8_t>(depth.confidence[i] * 255 + 0.5f);
    }
    return record;
}

// Records beside the output, appended as they are made.
class PartFile {
  public:
    PartFile(Path file, uint64_t identity, int count) : file_(std::move(file)), head_{kMagic, identity} {
        std::ifstream in(file_, std::ios::binary);
        uint64_t head[2] = {};
        if (!in.read(reinterpret_cast<char*>(head), sizeof head) || head[0] != head_[0] ||
            head[1] != head_[1])
            return;
        Record record;
        while (done_ < count && in.read(reinterpret_cast<char*>(&record), sizeof record) &&
               record.check == checkOf(record))
            ++done_;
    }
    int done() const { return done_; }

    Status begin() {
        const uint64_t kept = sizeof head_ + static_cast<uint64_t>(done_) * sizeof(Record);
        if (Status s =
                (done_ > 0 ? GrowingFile::extend(file_, kept) : GrowingFile::create(file_)).moveTo(out_);
            !s)
            return s;
        return done_ > 0 ? Status(Done{}) : out_->write({reinterpret_cast<const char*>(head_), sizeof head_});
    }
    Status add(Record& record) {
        record.check = checkOf(record);
        ++done_;
        return out_->write({reinterpret_cast<const char*>(&record), sizeof record});
    }
    bool read(int number, Record& record) {
        if (!in_.is_open()) in_.open(file_, std::ios::binary);
        in_.seekg(static_cast<std::streamoff>(sizeof head_ + static_cast<size_t>(number) * sizeof record));
        return in_.read(reinterpret_cast<char*>(&record), sizeof record) && record.check == checkOf(record);
    }
    void remove() {
        in_.close(), out_.reset();
        std::error_code ignored;
        std::filesystem::remove(file_, ignored);
    }

  private:
    static constexpr uint64_t kMagic = 0x3172747064687331; // changes with the layout of Record
    Path file_;
    uint64_t head_[2];
    int done_ = 0;
    std::optional<GrowingFile> out_;
    std::ifstream in_;
};

class Estimator {
  public:
    Estimator(media::VideoPlayer& player, const FilmDepthOptions& options)
        : player_(player), options_(options), info_(player.info()),
          count_(static_cast<int>(std::max<int64_t>(info_.frameCount / kStep, 1))) {}

    int count() const { return count_; }
    bool isStereo() const { return info_.layout != media::Layout::Mono; }
    int gap() const { return gap_; }

    // False: the camera stands still or only turns. Places over the whole film, wider and wider pairs.
    bool chooseGap() {
        constexpr int kPlaces = 8;
        for (gap_ = kStep; gap_ <= kMaxGap && gap_ < info_.frameCount; gap_ *= 2) {
            std::vector<double> parallaxes;
            int moving = 0;
            for (int place = 0; place < kPlaces; ++place) {
                const int64_t at = (info_.frameCount - gap_ - 1) * place / kPlaces;
                CubeFaces first, second;
                readFaces(at, first), readFaces(at + gap_, second);
                const PairDepth pair = estimatePair(flow_, first, second);
                moving += isTranslation(pair.pose);
                parallaxes.push_back(pair.pose.parallax_rad);
            }
            enough_ = moving * 3 >= kPlaces;
            if (enough_ && median(parallaxes) >= kGoodParallax) return true;
        }
        gap_ /= 2;
        return enough_;
    }

    Record stereo(int number) {
        const media::VideoFrame& frame = frameAt(int64_t{number} * kStep);
        DepthEstimate depth;
        stereo_.estimate(eyeOf(frame, 0), eyeOf(frame, 1), options_.baseline_m, kWidth, depth);
        Record record;
        for (size_t i = 0; i < kTexels; ++i) {
            record.inverse[i] = static_cast<uint16_t>(std::clamp(depth.inverse[i] * kCodes, 0.0f, 65535.0f));
            record.confidence[i] = static_cast<uint8_t>(depth.confidence[i] * 255 + 0.5f);
        }
        return record;
    }

    // In order. The first call may be for any number: pairs that end there are made first.
    Record moving(int number) {
        const int pairGap = gap_ / kStep;
        if (nextPair_ < 0) nextPair_ = std::max(number - pairGap, 0);
        firstPair_ = pairs_.empty() ? nextPair_ : firstPair_;
        for (; nextPair_ <= number && nextPair_ + pairGap < count_; ++nextPair_) {
            const CubeFaces& first = facesAt(nextPair_); // before the second: faces are read in order
            pairs_.push_back(estimatePair(flow_, first, facesAt(nextPair_ + pairGap)));
        }
        while (firstPair_ < number - pairGap) pairs_.pop_front(), ++firstPair_;
        const auto pair = [&](int k) {
            const int at = k - firstPair_;
            return k >= 0 && at >= 0 && at < static_cast<int>(pairs_.size())
                       ? &pairs_[static_cast<size_t>(at)]
                       : nullptr;
        };
        return joined(pair(number), pair(number - pairGap));
    }

    const media::VideoFrame& frameAt(int64_t frame) {
        return *player_.waitFor((static_cast<double>(frame) + 0.25) / info_.fps);
    }

  private:
    void readFaces(int64_t frame, CubeFaces& out) { flow_.makeFaces(eyeOf(frameAt(frame), 0), out); }

    const CubeFaces& facesAt(int number) {
        if (faces_.empty()) firstFaces_ = number;
        while (firstFaces_ + static_cast<int>(faces_.size()) <= number) {
            faces_.emplace_back();
            readFaces(int64_t{firstFaces_ + static_cast<int>(faces_.size()) - 1} * kStep, faces_.back());
        }
        while (firstFaces_ < number - gap_ / kStep) faces_.pop_front(), ++firstFaces_;
        return faces_[static_cast<size_t>(number - firstFaces_)];
    }

    media::VideoPlayer& player_;
    const FilmDepthOptions& options_;
    media::VideoInfo info_;
    int count_, gap_ = kStep;
    bool enough_ = false;
    CubeFlow flow_;
    StereoDepth stereo_;
    std::deque<CubeFaces> faces_;
    std::deque<PairDepth> pairs_;
    int firstFaces_ = 0, firstPair_ = 0, nextPair_ = -1;
};

// Metres of each pair's baseline. Ratios link each pair with the one that it continues; neighbours overlap
// nearly wholly, so their baselines differ little. Least squares in logarithms, by successive
// over-relaxation.
std::vector<double> baselines(PartFile& part, int count, int gap, double fps,
                              const FilmDepthOptions& options) {
    const int step = std::max(gap / kStep, 1);
    constexpr double kSmooth = 4; // weight of a neighbour's equality against one ratio
    std::vector<double> logs(static_cast<size_t>(count), 0), ratios = logs, weights = logs, heights = logs;
    Record record;
    for (int t = 0; t < count; ++t)
        if (part.read(t, record)) {
            const auto i = static_cast<size_t>(t);
            ratios[i] = record.logRatio, weights[i] = record.ratioWeight, heights[i] = record.height;
        }
    for (int round = 0; round < 3000; ++round)
        for (int t = 0; t < count; ++t) {
            double sum = 0, weight = 1e-9;
            const auto add = [&](int other, double value, double w) {
                if (other >= 0 && other < count)
                    sum += w * (logs[static_cast<size_t>(other)] + value), weight += w;
            };
            add(t - 1, 0, kSmooth), add(t + 1, 0, kSmooth);
            // The inverse distance in baselines grows as the baseline does.
            add(t - step, ratios[static_cast<size_t>(t)], weights[static_cast<size_t>(t)]);
            if (t + step < count)
                add(t + step, -ratios[static_cast<size_t>(t + step)], weights[static_cast<size_t>(t + step)]);
            double& log = logs[static_cast<size_t>(t)];
            log += 1.7 * (sum / weight - log);
        }
    std::vector<double> seen, result;
    for (int t = 0; t < count; ++t) {
        const double baseline = std::exp(logs[static_cast<size_t>(t)]);
        result.push_back(baseline);
        if (options.speed_mPerS > 0)
            seen.push_back(baseline * fps / gap / options.speed_mPerS);
        else if (heights[static_cast<size_t>(t)] > 0)
            seen.push_back(baseline * heights[static_cast<size_t>(t)] / options.height_m);
    }
    const double scale = median(seen);
    for (double& each : result) each /= scale > 0 ? scale : 1;
    return result;
}

// The median of three neighbouring frames where all know something: what one of them got wrong goes.
void filter(const Record* const (&around)[3], const double (&perBaseline)[3], media::DepthFrame& out) {
    out.width = kWidth, out.height = kHeight;
    out.inverse.assign(kTexels, 0);
    out.confidence.assign(kTexels / 4, 0);
    std::vector<float> confidence(kTexels);
    for (size_t i = 0; i < kTexels; ++i) {
        const auto inverse = [&](int k) {
            return static_cast<float>(around[k]->inverse[i] / static_cast<double>(kCodes) * perBaseline[k]);
        };
        float a = inverse(0), b = inverse(1), c = inverse(2);
        float value = b, sure = around[1]->confidence[i] / 255.0f;
        if (std::min(around[0]->confidence[i], around[2]->confidence[i]) > 100) {
            value = std::max(std::min(a, b), std::min(std::max(a, b), c));
            const float off = std::abs(b - value) / std::max(value, 1e-3f);
            sure *= std::clamp(1.3f - 4 * off, 0.0f, 1.0f);
        }
        out.inverse[i] = media::depthCode(value);
        confidence[i] = sure;
    }
    for (int y = 0; y < kHeight / 2; ++y)
        for (int x = 0; x < kWidth / 2; ++x) {
            float least = 1;
            for (int k = 0; k < 4; ++k)
                least = std::min(least, confidence[static_cast<size_t>(2 * y + k / 2) * kWidth +
                                                   static_cast<size_t>(2 * x + k % 2)]);
            out.confidence[static_cast<size_t>(y) * kWidth / 2 + static_cast<size_t>(x)] =
                static_cast<uint16_t>(least * media::kMaxDepthCode);
        }
}

// Near is bright; what is not known well is blue.
Status writePreview(const Path& file, const light::FrameView& film, const media::DepthFrame& depth) {
    constexpr int kWide = 768, kHigh = kWide / 2;
    ImageRgb8 picture(2 * kWide, kHigh);
    for (int y = 0; y < kHigh; ++y)
        for (int x = 0; x < kWide; ++x) {
            const uint8_t* pixel =
                film.pixels + y * film.height / kHigh * film.rowStride + x * film.width / kWide * 3;
            uint8_t* left = picture.at(x, y);
            left[0] = pixel[2], left[1] = pixel[1], left[2] = pixel[0];
            const int dx = x * kWidth / kWide, dy = y * kHeight / kHigh;
            const float grey = std::sqrt(std::min(depth.inverse_perM(dx, dy), 1.0f)) * 255;
            const auto sure =
                depth.confidence[static_cast<size_t>(dy / 2) * kWidth / 2 + static_cast<size_t>(dx / 2)];
            uint8_t* right = picture.at(kWide + x, y);
            const bool known = sure > media::kMaxDepthCode / 2;
            right[0] = right[1] = static_cast<uint8_t>(known ? grey : 0);
            right[2] = static_cast<uint8_t>(known ? grey : 90);
        }
    return media::writePicture(file, picture);
}

uint64_t identityOf(const std::string& film, const FilmDepthOptions& options, media::Layout layout) {
    Hash hash;
    hash.bytes(film.data(), film.size());
    hash.add(static_cast<int>(layout));
    hash.add(options.baseline_m);
    return hash.value();
}

Status writeTrack(const Path& out, const std::string& film, Estimator& estimator, PartFile& part,
                  const media::VideoInfo& info, const FilmDepthOptions& options) {
    const int count = estimator.count();
    const std::vector<double> metres = estimator.isStereo()
                                           ? std::vector<double>(static_cast<size_t>(count), 1.0)
                                           : baselines(part, count, estimator.gap(), info.fps, options);
    auto writer = media::DepthTrackWriter::make({kWidth, kHeight, count, info.duration_s}, {{film}});
    if (!writer) return writer.error();
    Record records[3]; // of number - 1, number, number + 1, each at its number modulo three
    for (int t = 0; t < std::min(count, 2); ++t)
        if (!part.read(t, records[t])) return Error{out.string(), "could not be made: its .part is damaged"};
    media::DepthFrame frame;
    for (int t = 0; t < count; ++t) {
        if (t > 0 && t + 1 < count && !part.read(t + 1, records[(t + 1) % 3]))
            return Error{out.string(), "could not be made: its .part is damaged"};
        const int at[3] = {std::max(t - 1, 0), t, std::min(t + 1, count - 1)};
        const auto inverse = [&](int k) { return 1 / metres[static_cast<size_t>(at[k])]; };
        filter({&records[at[0] % 3], &records[at[1] % 3], &records[at[2] % 3]},
               {inverse(0), inverse(1), inverse(2)}, frame);
        if (Status s = writer->add(frame); !s) return s;
        if (t == count / 2 && !options.preview.empty())
            if (Status s =
                    writePreview(options.preview, eyeOf(estimator.frameAt(int64_t{t} * kStep), 0), frame);
                !s)
                return s;
    }
    return writer->finish(out);
}

} // namespace

Result<FilmDepth> makeFilmDepth(const Path& film, const Path& out, const FilmDepthOptions& options) {
    const auto identity = media::filmIdentity(film);
    if (!identity) return identity.error();
    auto player =
        media::VideoPlayer::open(film, {.layout = options.layout, .prepare = {}, .keepPixels = true});
    if (!player) return player.error();
    const media::VideoInfo info = player->info();
    if (info.frameCount < 2 * kStep || info.frameCount > kMaxFrames)
        return Error{film.string(), "has too few or too many frames, or does not say how many"};
    Estimator estimator(*player, options);
    if (!estimator.isStereo() && !estimator.chooseGap()) return FilmDepth::CannotBeKnown;
    PartFile part(out.string() + ".part", identityOf(*identity, options, info.layout), estimator.count());
    if (Status s = part.begin(); !s) return s.error();
    for (int t = part.done(); t < estimator.count(); ++t) {
        Record record = estimator.isStereo() ? estimator.stereo(t) : estimator.moving(t);
        if (Status s = part.add(record); !s) return s.error();
        if (options.progress) options.progress(static_cast<double>(t + 1) / estimator.count());
    }
    if (Status s = writeTrack(out, *identity, estimator, part, info, options); !s) return s.error();
    part.remove();
    return FilmDepth::Written;
}

} // namespace shoal::depth
