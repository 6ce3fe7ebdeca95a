// bench_film FOLDER CLIP.. : measures every FOLDER/CLIP_CODEC_WIDTH_QUALITY.mp4 against FOLDER/CLIP.rgb (raw,
// kTruthWidth wide, 3 bytes a pixel) and writes FOLDER/film.tsv, a row for each codec, width and quality over
// all clips.
#include "engine/math/Colour.h"
#include "engine/media/Decoder.h"
#include "tests/bench/Bench.h"

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <fstream>

namespace {

using namespace shoal;
using namespace shoal::bench;

constexpr int kTruthWidth = 4096, kEvery = 5; // frames that are compared
constexpr double kFilmFrames = 1440, kFilmKeys = 6;

// Spatial frequencies in bands of a sixth of an octave, from kLowest up, in cycles around.
constexpr int kBands = 24;
constexpr double kLowest = 128;

constexpr int kTile = 1024;
constexpr double kBandsAnOctave = 6;

cv::Mat asMat(const ImageRgb8& image) {
    return {image.height, image.width, CV_8UC3, const_cast<uint8_t*>(image.pixels.data())};
}

// Rec. 709, of 255.
cv::Mat luma(const cv::Mat& bgr) {
    cv::Mat out;
    cv::transform(bgr, out, cv::Matx13f(0.0722f, 0.7152f, 0.2126f));
    out.convertTo(out, CV_32F);
    return out;
}

cv::Mat spectrum(const cv::Mat& luma, const cv::Rect& tile) {
    static const cv::Mat window = [] { // so that a tile's edges do not count as detail
        cv::Mat hann;
        cv::createHanningWindow(hann, {kTile, kTile}, CV_32F);
        return hann;
    }();
    cv::Mat part = luma(tile).clone(), out;
    part -= cv::mean(part)[0];
    cv::dft(part.mul(window), out, cv::DFT_COMPLEX_OUTPUT);
    return out;
}

// Returns the middle of a band, cycles around.
double bandFrequency(int band) { return kLowest * std::exp2((band + 0.5) / kBandsAnOctave); }

// Sums over pictures. Both are lat-long; the decoded one is enlarged to the true one's size first.
class Distance {
  public:
    void add(const ImageRgb8& truthRgb, const ImageRgb8& decodedBgr) {
        cv::Mat truth, decoded;
        cv::cvtColor(asMat(truthRgb), truth, cv::COLOR_RGB2BGR);
        if (decodedBgr.width == truthRgb.width)
            decoded = asMat(decodedBgr);
        else
            cv::resize(asMat(decodedBgr), decoded, truth.size(), 0, 0, cv::INTER_CUBIC);
        const cv::Mat lumaTruth = luma(truth), lumaDecoded = luma(decoded);
        const auto& linear = math::linearOfByte();
        for (int y = 0; y < truth.rows; ++y) {
            const double weight = std::sin((y + 0.5) / truth.rows * std::numbers::pi);
            double squared = 0, own = 0, steps = 0;
            for (int x = 0; x < truth.cols; ++x) {
                for (int c = 0; c < 3; ++c) {
                    const float a = linear[truth.at<cv::Vec3b>(y, x)[c]],
                                b = linear[decoded.at<cv::Vec3b>(y, x)[c]];
                    squared += (a - b) * (a - b);
                    own += a * a;
                }
                const double step = lumaTruth.at<float>(y, x) - lumaDecoded.at<float>(y, x);
                steps += step * step;
            }
            squared_ += weight * squared, truthSquared_ += weight * own, lumaSquared_ += weight * steps;
            weights_ += weight * truth.cols;
        }
        // Around the horizon, where texels are square.
        for (int x = 0; x + kTile <= truth.cols; x += kTile) {
            const cv::Rect tile(x, (truth.rows - kTile) / 2, kTile, kTile);
            const cv::Mat a = spectrum(lumaTruth, tile), b = spectrum(lumaDecoded, tile);
            for (int j = 0; j < kTile; ++j)
                for (int i = 0; i < kTile; ++i) {
                    const double u = i <= kTile / 2 ? i : i - kTile, v = j <= kTile / 2 ? j : j - kTile;
                    const double around = std::hypot(u, v) * truth.cols / kTile;
                    const int band = around < kLowest
                                         ? -1
                                         : static_cast<int>(kBandsAnOctave * std::log2(around / kLowest));
                    if (band < 0 || band >= kBands) continue;
                    const auto p = a.at<cv::Vec2f>(j, i), q = b.at<cv::Vec2f>(j, i);
                    cross_[band] += p[0] * q[0] + p[1] * q[1];
                    power_[band] += p[0] * p[0] + p[1] * p[1];
                }
        }
    }

    // Root mean square error in linear light over the sphere, as a share of the truth's root mean square.
    double errorLinear() const { return std::sqrt(squared_ / truthSquared_); }
    double psnrLuma_dB() const { return 10 * std::log10(255 * 255 / (lumaSquared_ / weights_)); }
    // Share of the truth's detail in a band that is found in the right place: the cross spectrum's real part
    // over the truth's power.
    double gain(int band) const { return cross_[band] / power_[band]; }
    // Highest frequency, in cycles around, up to which gain() is at least a half.
    double detail() const {
        for (int band = 0; band < kBands; ++band) {
            if (gain(band) >= 0.5) continue;
            if (band == 0) return bandFrequency(0);
            const double share = (gain(band - 1) - 0.5) / (gain(band - 1) - gain(band));
            return bandFrequency(band - 1) * std::pow(bandFrequency(band) / bandFrequency(band - 1), share);
        }
        return bandFrequency(kBands - 1);
    }

  private:
    double squared_ = 0, truthSquared_ = 0, lumaSquared_ = 0, weights_ = 0;
    std::array<double, kBands> cross_{}, power_{};
};

// Steps of luma from column to column where blocks of 8, 16, 32 or 64 meet, over those elsewhere, in the
// upper part of the picture (open water), for the worst of these sizes; 1: no blocks to be seen.
double blockiness(const ImageRgb8& bgr) {
    const cv::Mat y = luma(asMat(bgr));
    const int top = y.rows / 5, bottom = y.rows * 9 / 20;
    std::vector<double> steps(static_cast<size_t>(y.cols), 0);
    for (int row = top; row < bottom; ++row)
        for (int x = 0; x + 1 < y.cols; ++x)
            steps[x] += std::fabs(y.at<float>(row, x + 1) - y.at<float>(row, x));
    double worst = 0;
    for (const size_t size : {size_t{8}, size_t{16}, size_t{32}, size_t{64}}) {
        double between = 0, within = 0;
        size_t borders = 0, others = 0;
        for (size_t x = 0; x + 1 < steps.size(); ++x)
            if (x % size == size - 1)
                between += steps[x], ++borders;
            else if (x % 8 != 7)
                within += steps[x], ++others;
        worst =
            std::max(worst, between / static_cast<double>(borders) / (within / static_cast<double>(others)));
    }
    return worst;
}

struct Figures {
    double frameBytes = 0, keyBytes = 0, decode_ms = 0, convert_ms = 0, blocks = 0;
    int clips = 0;
    Distance distance;
};

bool readTruth(const Path& file, int frame, ImageRgb8& image) {
    image = ImageRgb8(kTruthWidth, kTruthWidth / 2);
    const auto bytes = static_cast<std::streamsize>(image.pixels.size());
    std::ifstream from(file, std::ios::binary);
    from.seekg(bytes * frame);
    return from.read(reinterpret_cast<char*>(image.pixels.data()), bytes).good();
}

// Decodes on one thread. Time is the processor's, so that other programs matter little.
bool measure(const Path& clip, const Path& truth, bool water, Figures& figures) {
    const media::Input input = media::openInput(clip);
    if (!input || avformat_find_stream_info(input.get(), nullptr) < 0) return false;
    media::Decoder decoder;
    if (!decoder.open(*input->streams[0], media::FrameThreading::None, 1)) return false;
    const media::Packet packet = media::makePacket();
    double decode_ms = 0, convert_ms = 0, bytes = 0, blocks = 0;
    int frames = 0, compared = 0;
    ImageRgb8 bgr, truthRgb;
    for (bool more = true; more;) {
        more = av_read_frame(input.get(), packet.get()) >= 0;
        double before = processor_ms();
        decoder.send(more ? packet.get() : nullptr);
        if (more && (packet->flags & AV_PKT_FLAG_KEY))
            figures.keyBytes += packet->size;
        else if (more)
            bytes += packet->size;
        if (more) av_packet_unref(packet.get());
        while (decoder.receive()) {
            decode_ms += processor_ms() - before;
            before = processor_ms();
            if (!decoder.convert(bgr)) return false;
            convert_ms += processor_ms() - before;
            if (frames % kEvery == kEvery / 2 && readTruth(truth, frames, truthRgb)) {
                figures.distance.add(truthRgb, bgr);
                blocks += blockiness(bgr);
                ++compared;
            }
            ++frames;
            before = processor_ms();
        }
        decode_ms += processor_ms() - before;
    }
    if (frames < 2 || compared == 0) return false;
    figures.frameBytes += bytes / (frames - 1);
    figures.decode_ms += decode_ms / frames;
    figures.convert_ms += convert_ms / frames;
    if (water) figures.blocks = blocks / compared;
    ++figures.clips;
    return true;
}

} // namespace

int main(int argc, char** argv) {
    if (lacksArguments(argc, 2, "bench_film FOLDER CLIP...")) return 2;
    media::setUpDecoders();
    const Path folder = argv[1];
    std::map<std::string, Figures> all; // by CODEC_WIDTH_QUALITY
    for (int i = 2; i < argc; ++i)
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            const std::string name = entry.path().stem().string(), clip = std::string(argv[i]) + "_";
            if (!name.starts_with(clip) || entry.path().extension() != ".mp4") continue;
            if (!measure(entry.path(), folder / (std::string(argv[i]) + ".rgb"), i == 2,
                         all[name.substr(clip.size())])) {
                std::fprintf(stderr, "bench_film: %s cannot be measured\n", entry.path().c_str());
                return 1;
            }
        }
    std::string table =
        "codec\twidth\tquality\tMB_a_minute\tdecode_ms\tconvert_ms\terror_percent\tpsnr_dB\tdetail\tblocks\n";
    for (const auto& [name, f] : all) {
        char codec[16];
        int width = 0, quality = 0;
        if (std::sscanf(name.c_str(), "%15[^_]_%d_%d", codec, &width, &quality) != 3) continue;
        const double film_MB = 1e-6 * (f.frameBytes * kFilmFrames + f.keyBytes * kFilmKeys) / f.clips;
        table += fmt::format("{}\t{}\t{}\t{:.1f}\t{:.2f}\t{:.2f}\t{:.2f}\t{:.2f}\t{:.0f}\t{:.2f}\n", codec,
                             width, quality, film_MB, f.decode_ms / f.clips, f.convert_ms / f.clips,
                             100 * f.distance.errorLinear(), f.distance.psnrLuma_dB(), f.distance.detail(),
                             f.blocks);
    }
    return exitStatus("bench_film", writeFileWhole(folder / "film.tsv", table));
}
