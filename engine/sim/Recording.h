// Replays: the inputs of every tick and the hash of the state each led to. A bug report, a determinism test
// and a benchmark in one file.
//
// The file, little-endian: "SHOALRE2", uint32 length and uint32 CRC-32 of the JSON header, the header; then
// blocks of up to one second: uint32 ticks, uint32 length of the packed body, uint32 CRC-32 of
// these two and the body, the body. The body is one zlib stream of, per tick, the input bytes XOR those of
// the tick before in the same block, then the 8 bytes of the hash. A block of no ticks ends the file. Blocks
// are written as they fill: after a crash the file is read up to its last whole block.
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
    // Marks the end, and waits until the disk has it. Without this the file ends after its last whole block,
    // as after a crash.
    Status finish();

  private:
    RecordingWriter(GrowingFile file, uint32_t inputBytes) : file_(std::move(file)), before_(inputBytes) {}
    Status endBlock();

    GrowingFile file_;
    std::vector<uint8_t> before_; // the last tick's input
    std::string body_;            // the present block, not yet packed
    uint32_t ticks_ = 0;          // ticks of the present block
};

struct RecordedTick {
    std::span<const uint8_t> input; // valid until the next tick is read
    uint64_t hash;
};

// Reads one from its first tick to its last. The file is held as it is, packed; copies share it and read on
// by themselves.
class RecordingReader {
  public:
    // Fails on anything that is not a recording of this tick rate. What follows damage is left out.
    static Result<RecordingReader> open(const Path& file);

    const RecordingHeader& header() const { return file_->header; }
    uint64_t ticks() const { return file_->ticks; }
    // False: the end mark is missing; the program that wrote it was stopped.
    bool complete() const { return file_->complete; }
    uint64_t position() const { return position_; } // ticks read
    bool atEnd() const { return position_ == ticks(); }

    // !atEnd()
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
    size_t block_ = 0;           // the next one to unpack
    std::vector<uint8_t> body_;  // the present block, unpacked
    size_t at_ = 0;              // bytes of it that have been read
    std::vector<uint8_t> input_; // input of the last tick read
};

// Fails, naming the tick, where the hash of its state now is not the recorded one.
Status sameState(uint64_t tick, uint64_t recorded, uint64_t now);

} // namespace shoal::sim
