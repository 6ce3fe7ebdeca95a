// A recording in memory, for tests that compare its ticks.
#pragma once

#include "engine/sim/Recording.h"
#include "game/rules/Dive.h"

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::tests {

class Recorded {
  public:
    explicit Recorded(sim::RecordingHeader header) : header_(std::move(header)) {}

    const sim::RecordingHeader& header() const { return header_; }
    size_t ticks() const { return hashes_.size(); }
    std::span<const uint8_t> input(size_t tick) const {
        return std::span(inputs_).subspan(tick * header_.inputBytes, header_.inputBytes);
    }
    uint64_t hash(size_t tick) const { return hashes_[tick]; }
    void add(std::span<const uint8_t> input, uint64_t hash) {
        inputs_.insert(inputs_.end(), input.begin(), input.end());
        hashes_.push_back(hash);
    }

  private:
    sim::RecordingHeader header_;
    std::vector<uint8_t> inputs_; // ticks * inputBytes
    std::vector<uint64_t> hashes_;
};

inline game::TickInput inputAt(const Recorded& recorded, size_t tick) {
    return game::fromBytes(recorded.input(tick).first<game::kTickInputBytes>());
}

inline Status write(const Path& file, const Recorded& recorded) {
    auto writer = sim::RecordingWriter::create(file, recorded.header());
    if (!writer) return writer.error();
    for (size_t tick = 0; tick < recorded.ticks(); ++tick)
        if (Status added = writer->add(recorded.input(tick), recorded.hash(tick)); !added) return added;
    return writer->finish();
}

// Reads all ticks that can be read, from the reader's place on.
inline Result<Recorded> readAll(sim::RecordingReader reader) {
    Recorded recorded(reader.header());
    while (!reader.atEnd()) {
        const auto tick = reader.next();
        if (!tick) return tick.error();
        recorded.add(tick->input, tick->hash);
    }
    return recorded;
}

// Reads a whole recording; fails if it is cut short.
inline Result<Recorded> readRecorded(const Path& file) {
    auto reader = sim::RecordingReader::open(file);
    if (!reader) return reader.error();
    if (!reader->complete()) return Error{file.string(), "is cut short"};
    return readAll(std::move(*reader));
}

} // namespace shoal::tests
