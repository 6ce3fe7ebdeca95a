#include "content/make/depth/FilmDepth.h"

#include "content/make/depth/DepthPreview.h"
#include "content/make/depth/DepthTrackWriter.h"
#include "content/make/depth/FrameRecord.h"
#include "content/make/depth/Ground.h"
#include "content/make/depth/MotionPass.h"
#include "content/make/depth/SweepPass.h"
#include "content/make/depth/TrackFilter.h"
#include "engine/core/Hash.h"
#include "engine/math/Quantile.h"
#include "engine/media/VideoPlayer.h"

#include <algorithm>
#include <array>

namespace shoal::depth {

namespace {

constexpr int64_t kMaxFrames = 1'000'000;
// Minimum share of the sphere that is believed, in the mean of all frames. Where noise is as strong as the
// picture, frames agree by chance about 0.5 % of it; films that show something have 6 % and more
// (tests/bench/depth_estimate: darkness, featureless). The minimum is four times 0.5 % and a third of 6 %.
constexpr double kMinConfidence = 0.02;

uint64_t identityOf(const std::string& film, const FilmDepthOptions& options, media::Layout layout) {
    Hash hash;
    hash.bytes(film.data(), film.size());
    hash.add(static_cast<int>(layout));
    hash.add(options.baseline_m), hash.add(options.height_m), hash.add(options.speed_mPerS);
    return hash.value();
}

// The scale of the whole path is a guess: see FilmDepthOptions.
void guessScale(CameraPath& path, double fps, const FilmDepthOptions& options) {
    std::vector<double> seen;
    for (size_t t = 0; t < path.motions.size(); ++t) {
        if (options.speed_mPerS > 0)
            seen.push_back(path.baselines_m[t] * fps / (path.step * kFilmStep) / options.speed_mPerS);
        else if (path.motions[t].height > 0)
            seen.push_back(path.baselines_m[t] * path.motions[t].height / options.height_m);
    }
    const double scale = math::median(seen);
    for (double& each : path.baselines_m) each /= scale > 0 ? scale : 1;
}

class Maker {
  public:
    Maker(FilmFrames& film, const FilmDepthOptions& options, const Path& out, const std::string& identity)
        : film_(film), options_(options), out_(out), identity_(identity), count_(film.trackCount()),
          passes_(film.isStereo() ? 1 : 2),
          records_(out.string() + ".part", identityOf(identity, options, film.info().layout),
                   count_ * passes_) {}

    Result<FilmDepth> make() {
        MotionPass motion(film_);
        if (!film_.isStereo() && !motion.chooseGap()) return FilmDepth::CannotBeKnown;
        if (Status s = records_.begin(); !s) return s.error();
        if (Status s = film_.isStereo() ? fromEyes() : fromMotion(motion); !s) return s.error();
        const auto made = writeTrack();
        if (made) records_.remove();
        return made;
    }

  private:
    Status add(FrameRecord& record) {
        if (Status s = records_.add(record); !s) return s;
        if (options_.progress) options_.progress(static_cast<double>(records_.done()) / (count_ * passes_));
        return Done{};
    }

    Status fromEyes() {
        StereoDepth stereo;
        DepthEstimate depth;
        while (records_.done() < count_) {
            const int64_t at = int64_t{records_.done()} * kFilmStep;
            stereo.estimate(film_.eye(at, 0), film_.eye(at, 1), options_.baseline_m, kEstimateWidth, depth);
            FrameRecord record;
            record.set(depth);
            if (Status s = add(record); !s) return s;
        }
        return Done{};
    }

    Status fromMotion(MotionPass& motion) {
        while (records_.done() < count_) {
            FrameRecord record = motion.frame(records_.done());
            if (Status s = add(record); !s) return s;
        }
        path_.step = motion.step();
        if (Status s = findPath(); !s) return s;
        float nearest_perM = 0;
        if (Status s = findNearest(nearest_perM); !s) return s;
        SweepPass sweep(film_, path_, nearest_perM);
        DepthEstimate depth;
        while (records_.done() < 2 * count_) {
            const int number = records_.done() - count_;
            sweep.frame(number, depth);
            FrameRecord record;
            // Records hold distances in baselines, as those of the first pass do.
            for (float& each : depth.inverse)
                each *= static_cast<float>(path_.baselines_m[static_cast<size_t>(number)]);
            record.set(depth);
            if (Status s = add(record); !s) return s;
        }
        return Done{};
    }

    Status findPath() {
        for (int t = 0; t < count_; ++t) {
            if (!records_.read(t, record_)) return damaged();
            path_.motions.push_back(record_.motion);
        }
        repairMotion(path_.motions);
        path_.baselines_m = linkBaselines(path_.motions, path_.step);
        guessScale(path_, film_.info().fps, options_);
        return Done{};
    }

    // Finds the inverse distance that, by the first pass, few texels exceed.
    Status findNearest(float& inverse_perM) {
        std::vector<double> inverses;
        for (int t = 0; t < count_; t += std::max(count_ / 64, 1)) {
            DepthEstimate depth;
            if (Status s = readMetres(t, depth); !s) return s;
            for (size_t i = 0; i < kEstimateTexels; ++i)
                if (depth.confidence[i] > 0.5f) inverses.push_back(static_cast<double>(depth.inverse[i]));
        }
        const double nearest = inverses.empty() ? 1 : 1.3 * math::quantile(inverses, 0.995);
        inverse_perM =
            static_cast<float>(std::clamp(nearest, 0.1, static_cast<double>(media::kMaxInverse_perM)));
        return Done{};
    }

    Status readMetres(int number, DepthEstimate& depth) {
        if (!records_.read(number, record_)) return damaged();
        record_.get(film_.isStereo() ? 1 : 1 / path_.baselines_m[static_cast<size_t>(number % count_)],
                    depth);
        return Done{};
    }

    // Reads the last pass' estimate of a frame and lowers its confidence where other frames disagree.
    Status readAgreed(int number, DepthEstimate& depth) {
        const int pass = (passes_ - 1) * count_;
        if (Status s = readMetres(pass + number, depth); !s || film_.isStereo()) return s;
        std::vector<OtherFrame> others;
        for (const int pairs : {-2, -1, 1, 2})
            if (const auto pose =
                    poseAlongChain(path_.motions, path_.baselines_m, number, pairs, path_.step)) {
                others.push_back({*pose, {}});
                if (Status s = readMetres(pass + number + pairs * path_.step, others.back().depth); !s)
                    return s;
            }
        requireAgreement(depth, others);
        return Done{};
    }

    // Reads the distances on which frames agree, fills in the ground elsewhere, and lowers the confidence at
    // outlines. Call it for each frame of the track in order.
    Status readComplete(int number, DepthEstimate& depth) {
        // The ground is found from the frames around this one; at the film's ends more of them lie on one
        // side.
        const int window = std::min(kGroundFrames, count_);
        const int first = std::clamp(number - window / 2, 0, count_ - window);
        agreed_.resize(static_cast<size_t>(window));
        for (; agreedEnd_ < first + window; ++agreedEnd_)
            if (Status s = readAgreed(agreedEnd_, agreed_[static_cast<size_t>(agreedEnd_ % window)]); !s)
                return s;
        depth = agreed_[static_cast<size_t>(number % window)];
        continueGround(findGround(agreed_), depth);
        doubtOutlines(depth);
        return Done{};
    }

    Result<FilmDepth> writeTrack() {
        auto writer = media::DepthTrackWriter::make(
            {kEstimateWidth, kEstimateHeight, count_, film_.info().duration_s}, {{identity_}});
        if (!writer) return writer.error();
        std::array<DepthEstimate, 3>
            around; // frames number - 1, number and number + 1, each at its number modulo three
        media::DepthFrame frame, middle;
        double believed = 0; // mean share of the sphere
        for (int t = -1; t < count_; ++t) {
            if (t + 1 < count_)
                if (Status s = readComplete(t + 1, around[static_cast<size_t>(t + 1) % 3]); !s)
                    return s.error();
            if (t < 0) continue;
            const auto at = [&](int number) -> const DepthEstimate& {
                return around[static_cast<size_t>(std::clamp(number, 0, count_ - 1)) % 3];
            };
            medianOverTime(at(t - 1), at(t), at(t + 1), frame);
            believed += believedShare(frame) / count_;
            if (Status s = writer->add(frame); !s) return s.error();
            if (t == count_ / 2) middle = frame;
        }
        if (believed < kMinConfidence) return FilmDepth::CannotBeKnown;
        if (!options_.preview.empty())
            if (Status s = writePreview(options_.preview, film_.eye(int64_t{count_ / 2} * kFilmStep), middle);
                !s)
                return s.error();
        if (Status s = writer->finish(out_); !s) return s.error();
        return FilmDepth::Written;
    }

    Status damaged() const { return Error{out_.string(), "could not be made: its .part is damaged"}; }

    FilmFrames& film_;
    const FilmDepthOptions& options_;
    const Path& out_;
    const std::string& identity_;
    int count_, passes_;
    RecordFile records_;
    CameraPath path_;
    // Frames around the one that readComplete() was called for, each at its number modulo their count.
    std::vector<DepthEstimate> agreed_;
    int agreedEnd_ = 0;  // number after the last of these frames
    FrameRecord record_; // scratch
};

} // namespace

Result<FilmDepth> makeFilmDepth(const Path& film, const Path& out, const FilmDepthOptions& options) {
    const auto identity = media::filmIdentity(film);
    if (!identity) return identity.error();
    auto player =
        media::VideoPlayer::open(film, {.layout = options.layout, .prepare = {}, .keepPixels = true});
    if (!player) return player.error();
    FilmFrames frames(*player);
    if (frames.info().frameCount < 2 * kFilmStep || frames.info().frameCount > kMaxFrames)
        return Error{film.string(), "has too few or too many frames, or does not say how many"};
    return Maker(frames, options, out, *identity).make();
}

} // namespace shoal::depth
