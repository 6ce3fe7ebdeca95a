// The sounds in content/sounds, measured.
#include "game/feedback/Feedback.h"
#include "game/rules/DiveFile.h"
#include "tests/Test.h"

namespace shoal::game {

void PrintTo(const SoundRow& row, std::ostream* out) { *out << row.file; } // in the tests' names

namespace {

// K-weighting of ITU-R BS.1770-4 at 48 kHz, table 1 and 2, in direct form 2 transposed.
struct Biquad {
    double b0, b1, b2, a1, a2, s1 = 0, s2 = 0;
    double step(double x) {
        const double y = b0 * x + s1;
        s1 = b1 * x - a1 * y + s2;
        s2 = b2 * x - a2 * y;
        return y;
    }
};

// LUFS of the loudest `window` frames; silence follows the end.
double loudness(const audio::Clip& clip, size_t window) {
    const auto channels = static_cast<size_t>(clip.channels);
    const size_t frames = clip.samples.size() / channels;
    std::vector<double> sums(frames + 1, 0);
    for (size_t c = 0; c < channels; ++c) {
        Biquad shelf{1.53512485958697, -2.69169618940638, 1.19839281085285, -1.69065929318241,
                     0.73248077421585};
        Biquad high{1, -2, 1, -1.99004745483398, 0.99007225036621};
        double sum = 0;
        for (size_t i = 0; i < frames; ++i) {
            const double k = high.step(shelf.step(clip.samples[i * channels + c] / 32768.0));
            sum += k * k;
            sums[i + 1] += sum;
        }
    }
    double loudest = 0;
    for (size_t i = 1; i <= frames; ++i)
        loudest = std::max(loudest, sums[i] - sums[i > window ? i - window : 0]);
    return -0.691 + 10 * std::log10(loudest / static_cast<double>(window));
}

audio::Clip clipOf(const std::string& file) {
    return tests::valueOf(audio::readClip(dataRoot() / "content" / "sounds" / (file + ".flac")));
}

class Sounds : public testing::TestWithParam<SoundRow> {
  protected:
    bool bed() const { return std::string_view(GetParam().file).starts_with("bed"); }
    bool loops() const { return bed() || std::string_view(GetParam().file) == "struggle"; }

    const audio::Clip clip = clipOf(GetParam().file);
};

// The step over a loop's seam is like those around it: its second difference, which shows clicks even in a
// smooth rumble, is within those of 4800 samples on both sides.
void expectNoClickAtSeam(const audio::Clip& clip) {
    const auto channels = static_cast<size_t>(clip.channels);
    const auto& s = clip.samples;
    for (size_t c = 0; c < channels; ++c) {
        const size_t frames = s.size() / channels, around = 4800;
        const auto at = [&](size_t i) { return static_cast<int>(s[(i % frames) * channels + c]); };
        const auto bend = [&](size_t i) { return std::abs(at(i) - 2 * at(i + 1) + at(i + 2)); };
        int usual = 0;
        for (size_t i = 0; i < around; ++i) usual = std::max({usual, bend(i), bend(frames - around - 2 + i)});
        EXPECT_LE(bend(frames - 2), usual);
        EXPECT_LE(bend(frames - 1), usual);
    }
}

TEST_P(Sounds, FitsTheGame) {
    EXPECT_EQ(clip.rate_Hz, 48000);
    EXPECT_EQ(clip.channels, bed() ? 2 : 1); // a stereo sound has no place
    int peak = 0;
    for (const int16_t sample : clip.samples) peak = std::max(peak, std::abs(static_cast<int>(sample)));
    EXPECT_LE(20 * std::log10(peak / 32768.0), -3);
    // LEVELS of content/make/sound: beds at -23 over all, others between -27 and -17 at their loudest 400 ms.
    // Half a decibel: what its circular filter and this running one may differ by.
    const size_t frames = clip.samples.size() / static_cast<size_t>(clip.channels);
    const double lufs = loudness(clip, loops() ? frames : 19200);
    EXPECT_GT(lufs, loops() ? -23.5 : -27.5);
    EXPECT_LT(lufs, loops() ? -22.5 : -16.5);
    if (loops()) return expectNoClickAtSeam(clip);
    EXPECT_LE(std::abs(clip.samples.front()), 33); // -60 dB
    EXPECT_LE(std::abs(clip.samples.back()), 33);
}

// Returns the themes of all dives.
std::set<std::string> themes() {
    std::set<std::string> names;
    for (const std::string& dive : diveNames()) names.insert(tests::valueOf(loadDiveFiles(dive)).dive.music);
    return names;
}

double rms_dB(const audio::Clip& clip) {
    double sum = 0;
    for (const int16_t sample : clip.samples) sum += std::pow(sample / 32768.0, 2);
    return 10 * std::log10(sum / static_cast<double>(clip.samples.size()));
}

// The layers of a theme stay in step for as long as they play, because they have one length; they loop
// without a click and stay below the bed, which stands at -24 dB.
TEST(Music, OfEachDiveHasLayersThatLoopInStepAndAreQuiet) {
    EXPECT_EQ(themes().size(), diveNames().size()); // each dive has its own
    for (const std::string& theme : themes()) {
        std::optional<size_t> length;
        for (const char* layer : kMusicLayers) {
            SCOPED_TRACE(theme + " " + layer);
            const audio::Clip clip = clipOf("music_" + theme + "_" + layer);
            EXPECT_EQ(clip.channels, 2);
            EXPECT_EQ(clip.rate_Hz, 24000);
            EXPECT_EQ(clip.samples.size(), length.value_or(clip.samples.size()));
            length = clip.samples.size();
            expectNoClickAtSeam(clip);
            EXPECT_GT(rms_dB(clip), -36);
            EXPECT_LT(rms_dB(clip), -30);
        }
    }
}

// The sea is heard above 3 kHz too, where shrimps crackle, but softly: the whole bed stands at -24 dB.
TEST(Beds, ReachBeyondThreeKilohertz) {
    for (const char* bed : {"bed_open", "bed_tunnel"}) {
        audio::Clip clip = clipOf(bed);
        Biquad first{0.75708, -1.51415, 0.75708, -1.45424, 0.57406}, second = first; // high-pass, 3 kHz
        std::vector<int16_t> high;
        for (size_t i = 0; i < clip.samples.size(); i += 2)
            high.push_back(static_cast<int16_t>(second.step(first.step(clip.samples[i]))));
        clip.samples = high;
        EXPECT_GT(rms_dB(clip), -70) << bed;
        EXPECT_LT(rms_dB(clip), -45) << bed;
    }
}

// Power of the samples between two times, and, by Goertzel's algorithm, of one frequency in them.
double powerOf(const audio::Clip& clip, double from_s, double to_s) {
    double sum = 0;
    const auto first = static_cast<size_t>(from_s * 48000), last = static_cast<size_t>(to_s * 48000);
    for (size_t i = first; i < last; ++i) sum += std::pow(clip.samples.at(i) / 32768.0, 2);
    return sum / static_cast<double>(last - first);
}
double powerOf(const audio::Clip& clip, double from_s, double to_s, double frequency_Hz) {
    const double turn = 2 * std::cos(2 * std::numbers::pi * frequency_Hz / 48000);
    double s1 = 0, s2 = 0;
    for (auto i = static_cast<size_t>(from_s * 48000); i < static_cast<size_t>(to_s * 48000); ++i) {
        const double s = clip.samples.at(i) / 32768.0 + turn * s1 - s2;
        s2 = std::exchange(s1, s);
    }
    return s1 * s1 + s2 * s2 - turn * s1 * s2;
}

// Each miss is told from the others: by which way two notes go (D4 and A4), or by its rhythm.
TEST(SoundsOfMisses, TooFarRisesAndBehindFalls) {
    constexpr double kLow_Hz = 293.7, kHigh_Hz = 440, kSecond_s = 0.3, kEnd_s = 0.5;
    const audio::Clip far = clipOf("miss_too_far"), behind = clipOf("miss_behind");
    const auto rises = [&](const audio::Clip& clip) {
        const auto high = [&](double from_s, double to_s) {
            return powerOf(clip, from_s, to_s, kHigh_Hz) / powerOf(clip, from_s, to_s, kLow_Hz);
        };
        return high(kSecond_s, kEnd_s) / high(0.14, kSecond_s);
    };
    EXPECT_GT(rises(far), 4); // 6 dB: nobody hears the wrong note as the louder one
    EXPECT_LT(rises(behind), 0.25);
}

TEST(SoundsOfMisses, TooEarlyHasARestAndTooFastHasNone) {
    const audio::Clip early = clipOf("miss_too_early"), fast = clipOf("miss_too_fast");
    const double knock = powerOf(early, 0.02, 0.1), rest = powerOf(early, 0.2, 0.28),
                 late = powerOf(early, 0.45, 0.6);
    EXPECT_LT(rest, 0.1 * knock); // 10 dB
    EXPECT_LT(rest, 0.1 * late);
    EXPECT_LT(powerOf(fast, 0.35, 0.5), 0.01 * powerOf(fast, 0.05, 0.3)); // over in a third of a second
}

INSTANTIATE_TEST_SUITE_P(Content, Sounds, testing::ValuesIn(kSounds),
                         [](const auto& row) { return std::string(row.param.file); });

TEST(SoundsFolder, HoldsNoMoreThanIsUsedAndStaysSmall) {
    uintmax_t bytes = 0;
    size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(dataRoot() / "content" / "sounds")) {
        bytes += entry.file_size();
        ++files;
    }
    EXPECT_EQ(files, kSounds.size() + themes().size() * kMusicLayers.size());
    EXPECT_LT(bytes, 6600000u);
}

} // namespace
} // namespace shoal::game
