// Recordings of the input of every tick, with the hash of the state after it. A file serves as a bug report,
// a determinism test and a benchmark.
//
// The file, little-endian: "SHOALRE2", uint32 length and uint32 CRC-32 of the JSON header, the header; then
// blocks of up to one second: uint32 ticks, uint32 length of the packed body, uint32 CRC-32 of these two and
// the body, the body. The body is one zlib stream with, for each tick, the input bytes XOR those of the
// previous tick in the block, then the 8 bytes of the hash. A block without ticks ends the file. A block is
// written when it is full: after a crash the file can be read up to its last complete block.
#pragma once

#include "engine/core/WriteFile.h"
#include "engine/sim/FixedStep.h"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace shoal::sim {

struct RecordingHeader {
    uint64_t seed = 0;
    std::string dive;        // name of content/dives/NAME.toml
    uint32_t inputBytes = 0; // per tick; 1 to 65536
    // Other settings of the simulation, by name. At most 64.
    std::map<std::string, std::string> settings{};

    bool operator==(const RecordingHeader&) const = default;
};

// Writes a recording to its final name as the ticks come. Memory does not depend on its length.
class RecordingWriter {
  public:
    static Result<RecordingWriter> create(const Path& file, const RecordingHeader& header);

    // input.size() == header.inputBytes. After an error, such as a full disk, nothing more may be added.
    Status add(std::span<const uint8_t> input, uint64_t hash);
    // Writes the end mark, and waits until the file is on the disk. Without this call the file ends after its
    // last complete block, as after a crash.
    Status finish();

  private:
    RecordingWriter(GrowingFile file, uint32_t inputBytes) : file_(std::move(file)), before_(inputBytes) {}
    Status endBlock();

    GrowingFile file_;
    std::vector<uint8_t> before_; // the last tick's input
    std::string body_;            // the current block, not yet packed
    uint32_t ticks_ = 0;          // ticks of the current block
};

struct RecordedTick {
    std::span<const uint8_t> input; // valid until the next tick is read
    uint64_t hash;
};

// Reads a recording tick by tick. The packed file is kept in memory; copies of a reader share it, each with
// its own position.
class RecordingReader {
  public:
    // Fails if the file is not a recording of this tick rate. Ticks after a damaged block are left out.
    static Result<RecordingReader> open(const Path& file);

    const RecordingHeader& header() const { return file_->header; }
    uint64_t ticks() const { return file_->ticks; }
    // Returns whether the file has its end mark; it is missing if the recording program was stopped.
    bool complete() const { return file_->complete; }
    uint64_t position() const { return position_; } // ticks read
    bool atEnd() const { return position_ == ticks(); }

    // Reads the next tick. Requires !atEnd().
    Result<RecordedTick> next();

  private:
    struct Block {
        uint32_t ticks;
        std::span<const uint8_t> packed; // a part of `bytes`
    };
    struct File {
        Path path;
        std::vector<uint8_t> bytes;
        RecordingHeader header{};
        std::vector<Block> blocks{};
        uint64_t ticks = 0;
        bool complete = false;
    };
    explicit RecordingReader(std::shared_ptr<const File> file)
        : file_(std::move(file)), input_(file_->header.inputBytes) {}
    static void findBlocks(File& file, std::span<const uint8_t> rest);

    std::shared_ptr<const File> file_;
    uint64_t position_ = 0;
    size_t block_ = 0;           // index of the next block
    std::vector<uint8_t> body_;  // the current block, unpacked
    size_t at_ = 0;              // bytes of it that have been read
    std::vector<uint8_t> input_; // input of the last tick read
};

// Fails, with the tick in its message, if the recorded hash differs from that of the state now.
Status sameState(uint64_t tick, uint64_t recorded, uint64_t now);

} // namespace shoal::sim
