// Replays: the inputs of every tick and the hash of the state each led to. A bug report, a determinism test
// and a benchmark in one file.
//
// The file: "SHOALREC", then little-endian uint32 length of the JSON header, uint64 tick count, uint64 length
// of the packed body, uint32 CRC-32 of header and packed body, the header, the body. The body is one zlib
// stream of, per tick, the input bytes XOR those of the tick before, then the 8 bytes of the hash.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"
#include "engine/sim/FixedStep.h"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace shoal::sim {

struct RecordingHeader {
    uint64_t seed = 0;
    std::string dive;        // name of content/dives/NAME.toml
    uint32_t inputBytes = 0; // per tick; 1 to 65536
    // What else the simulation was set up with, by name; empty in files of earlier versions. At most 64.
    std::map<std::string, std::string> settings{};

    bool operator==(const RecordingHeader&) const = default;
};

class Recording {
  public:
    explicit Recording(RecordingHeader, size_t reserveTicks = 0);

    const RecordingHeader& header() const { return header_; }
    size_t ticks() const { return hashes_.size(); }
    std::span<const uint8_t> input(size_t tick) const;
    uint64_t hash(size_t tick) const { return hashes_[tick]; }

    // input.size() == header().inputBytes
    void add(std::span<const uint8_t> input, uint64_t hash);

    // Fails with "tick N: ..." where the hash differs from the recorded one, or the recording has no such
    // tick.
    Status compare(size_t tick, uint64_t hash) const;

  private:
    RecordingHeader header_;
    std::vector<uint8_t> inputs_; // ticks * inputBytes
    std::vector<uint64_t> hashes_;
};

Status writeRecording(const Path& file, const Recording&);
// Fails on anything that is not exactly one whole recording of this version and tick rate.
Result<Recording> readRecording(const Path& file, uint64_t maxUnpackedBytes = 1u << 30);

} // namespace shoal::sim
