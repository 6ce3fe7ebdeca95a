#include "engine/audio/Along.h"

#include "engine/audio/Device.h"

#include <algorithm>
#include <cmath>

namespace shoal::audio {

namespace {

constexpr int kRate_Hz = 48000;
constexpr double kMostBend = 0.005;
constexpr double kClosedIn_s = 2;  // to 1/e of a small distance
constexpr double kJump_s = 0.08;   // from there on it starts anew: lips and bubbles would be seen to be wrong
constexpr double kLead_s = 0.05;   // how far beyond the picture it begins to read, for that takes a moment
constexpr double kSmoothing = 0.1; // of each new reading of the distance
constexpr int kStartWith = 4;      // pieces at least
constexpr double kMostSilence_s = 0.1; // that it is started with

int64_t framesOf(double seconds) { return std::llround(seconds * kRate_Hz); }

// To -half .. half of the length.
double wrapped(double seconds, double length_s) {
    return seconds - length_s * std::round(seconds / length_s);
}

} // namespace

double rateFor(double ahead_s) { return 1 - std::clamp(ahead_s / kClosedIn_s, -kMostBend, kMostBend); }

void Along::setUp() {
    alGenSources(1, &source_);
    alGenBuffers(kBuffers, buffers_.data());
    alSourcei(source_, AL_SOURCE_RELATIVE, AL_TRUE);
    alSourcei(source_, AL_DIRECT_CHANNELS_SOFT, AL_TRUE);
    getOffset_ = reinterpret_cast<LPALGETSOURCEI64VSOFT>(alGetProcAddress("alGetSourcei64vSOFT"));
    state_ = State::Stopped;
}

void Along::tearDown() {
    stop();
    if (source_) alDeleteSources(1, &source_);
    if (buffers_[0]) alDeleteBuffers(kBuffers, buffers_.data());
    source_ = 0;
    buffers_ = {};
}

void Along::stop() {
    if (source_) {
        alSourceStop(source_);
        alSourcei(source_, AL_BUFFER, 0); // lets go of all that is queued
    }
    spare_ = buffers_;
    spares_ = kBuffers;
    ahead_s_ = 0;
    state_ = State::Stopped;
}

void Along::begin(const Accompaniment& sound, double position_s) {
    stop();
    next_ = framesOf(position_s + kLead_s);
    sound.seek(next_);
    state_ = State::Waiting;
}

// Into a spare buffer; false if nothing is ready.
bool Along::queue(const Accompaniment& sound) {
    const size_t frames = sound.read(piece_);
    if (frames == 0) return false;
    const ALuint buffer = spare_[static_cast<size_t>(--spares_)];
    alBufferData(buffer, AL_FORMAT_STEREO16, piece_.data(),
                 static_cast<ALsizei>(frames * 2 * sizeof(int16_t)), kRate_Hz);
    alSourceQueueBuffers(source_, 1, &buffer);
    next_ += static_cast<int64_t>(frames);
    return true;
}

void Along::queueSilence(int64_t frames) {
    std::fill(piece_.begin(), piece_.end(), int16_t{0});
    while (frames > 0) {
        const int64_t some = std::min<int64_t>(frames, kPieceFrames);
        const ALuint buffer = spare_[static_cast<size_t>(--spares_)];
        alBufferData(buffer, AL_FORMAT_STEREO16, piece_.data(), static_cast<ALsizei>(some * 4), kRate_Hz);
        alSourceQueueBuffers(source_, 1, &buffer);
        frames -= some;
    }
}

// Starts when the sound's place has come, to the sample.
void Along::prime(const Accompaniment& sound, double position_s) {
    const double length_s = static_cast<double>(sound.length) / kRate_Hz;
    const double ahead_s = wrapped(static_cast<double>(next_) / kRate_Hz - position_s, length_s);
    if (std::abs(ahead_s) > 1) return begin(sound, position_s); // the picture went elsewhere meanwhile
    if (ahead_s > kMostSilence_s) return;                       // not yet
    for (int64_t late = framesOf(-ahead_s); late > 0;) {        // what should have been heard already
        const auto most = static_cast<size_t>(std::min<int64_t>(late, kPieceFrames));
        const auto frames = static_cast<int64_t>(sound.read(std::span(piece_).first(2 * most)));
        if (frames == 0) return;
        next_ += frames;
        late -= frames;
    }
    const int64_t early = std::max<int64_t>(framesOf(ahead_s), 0);
    queueBegins_ = next_ - early;
    queueSilence(early);
    int queued = 0;
    while (spares_ > 0 && queue(sound)) ++queued;
    if (queued < kStartWith) return begin(sound, position_s); // it would not last until the next frame
    alSourcePlay(source_);
    state_ = State::Playing;
}

void Along::refill(const Accompaniment& sound) {
    ALint done = 0;
    alGetSourcei(source_, AL_BUFFERS_PROCESSED, &done);
    for (; done > 0; --done) {
        ALuint buffer = 0;
        ALint bytes = 0;
        alSourceUnqueueBuffers(source_, 1, &buffer);
        alGetBufferi(buffer, AL_SIZE, &bytes);
        queueBegins_ += bytes / static_cast<ALint>(2 * sizeof(int16_t));
        spare_[static_cast<size_t>(spares_++)] = buffer;
    }
    while (spares_ > 0 && queue(sound)) {
    }
}

// What leaves the device now, as a position of the sound.
double Along::heard_s() const {
    if (getOffset_) {
        std::array<ALint64SOFT, 2> offset{}; // frames as 32.32, and nanoseconds on the way to the ear
        getOffset_(source_, AL_SAMPLE_OFFSET_LATENCY_SOFT, offset.data());
        return static_cast<double>(queueBegins_) / kRate_Hz +
               static_cast<double>(offset[0]) / (4294967296.0 * kRate_Hz) -
               static_cast<double>(offset[1]) * 1e-9;
    }
    ALint offset = 0;
    alGetSourcei(source_, AL_SAMPLE_OFFSET, &offset);
    return static_cast<double>(queueBegins_ + offset) / kRate_Hz;
}

void Along::update(const Accompaniment& sound, double position_s, float gain, bool paused) {
    if (!source_ || sound.length <= 0) return;
    // A pause is first heard as silence, to which OpenAL glides without a click, and then made.
    alSourcef(source_, AL_GAIN, paused ? 0 : std::clamp(gain, 0.0f, 1.0f));
    if (paused) {
        if (paused_ && state_ == State::Playing) alSourcePause(source_);
        paused_ = true;
        return;
    }
    ALint state = AL_STOPPED;
    alGetSourcei(source_, AL_SOURCE_STATE, &state);
    if (paused_ && state == AL_PAUSED) alSourcePlay(source_);
    const bool ranDry = state_ == State::Playing && state == AL_STOPPED;
    paused_ = false;
    if (state_ == State::Stopped || ranDry) begin(sound, position_s);
    if (state_ == State::Waiting) {
        prime(sound, position_s);
        return;
    }
    refill(sound);
    const double length_s = static_cast<double>(sound.length) / kRate_Hz;
    const double ahead_s = wrapped(heard_s() - position_s, length_s);
    if (std::abs(ahead_s) > kJump_s) {
        begin(sound, position_s);
        return;
    }
    ahead_s_ += kSmoothing * (ahead_s - ahead_s_);
    alSourcef(source_, AL_PITCH, static_cast<ALfloat>(rateFor(ahead_s_)));
}

} // namespace shoal::audio
