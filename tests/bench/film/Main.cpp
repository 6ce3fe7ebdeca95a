// bench_film FOLDER CLIP.. : measures every FOLDER/CLIP_CODEC_WIDTH_QUALITY.mp4 against FOLDER/CLIP.rgb (raw,
// kTruthWidth wide, 3 bytes a pixel) and writes FOLDER/film.tsv, a row for each codec, width and quality over
// all clips.
#include "engine/core/WriteFile.h"
#include "tests/bench/film/Measure.h"
#include "tests/bench/light/Timing.h"

#include "engine/media/PictureDecoder.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace shoal;
using namespace shoal::bench;

constexpr int kTruthWidth = 4096, kEvery = 5; // frames that are compared
constexpr double kFilmFrames = 1440, kFilmKeys = 6;

struct Figures {
    double frameBytes = 0, keyBytes = 0, decode_ms = 0, convert_ms = 0, blocks = 0;
    int clips = 0;
    Distance distance;
};

bool readTruth(const Path& file, int frame, ImageRgb8& image) {
    image = ImageRgb8(kTruthWidth, kTruthWidth / 2);
    std::FILE* from = std::fopen(file.c_str(), "rb");
    if (!from) return false;
    const auto bytes = image.pixels.size();
    const bool read = std::fseek(from, static_cast<long>(bytes) * frame, SEEK_SET) == 0 &&
                      std::fread(image.pixels.data(), 1, bytes, from) == bytes;
    std::fclose(from);
    return read;
}

// Decodes on one thread. Time is the processor's, so that other programs matter little.
bool measure(const Path& clip, const Path& truth, bool water, Figures& figures) {
    const media::Input input = media::openInput(clip);
    if (!input || avformat_find_stream_info(input.get(), nullptr) < 0) return false;
    media::PictureDecoder decoder;
    const AVStream& stream = *input->streams[0];
    if (!decoder.open(*stream.codecpar, stream.time_base, media::FrameThreading::None, 1)) return false;
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
    if (argc < 3) return 2;
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
        char row[200];
        std::snprintf(row, sizeof row, "%s\t%d\t%d\t%.1f\t%.2f\t%.2f\t%.2f\t%.2f\t%.0f\t%.2f\n", codec, width,
                      quality, film_MB, f.decode_ms / f.clips, f.convert_ms / f.clips,
                      100 * f.distance.errorLinear(), f.distance.psnrLuma_dB(), f.distance.detail(),
                      f.blocks);
        table += row;
    }
    const Status written = writeFileWhole(folder / "film.tsv", table);
    if (!written) std::fprintf(stderr, "bench_film: %s\n", written.error().message().c_str());
    return written ? 0 : 1;
}
