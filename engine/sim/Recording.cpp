#include "engine/sim/Recording.h"

#include <nlohmann/json.hpp>
#include <zlib.h>

#include <bit>
#include <cassert>
#include <cstring>

namespace shoal::sim {

static_assert(std::endian::native == std::endian::little, "recordings are little-endian");

namespace {

constexpr char kMagic[8] = {'S', 'H', 'O', 'A', 'L', 'R', 'E', 'C'};
constexpr size_t kPrefix = sizeof kMagic + 4 + 8 + 8 + 4;
constexpr int kVersion = 1;
constexpr uint64_t kMaxFileBytes = 256u << 20;
constexpr uint32_t kMaxInputBytes = 65536, kMaxHeaderBytes = 1u << 20;

template <class T> void append(std::string& to, T value) {
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T> T take(const uint8_t*& from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    from += sizeof value;
    return value;
}

uint32_t crcOf(const uint8_t* data, size_t size, uint32_t crc = 0) {
    return static_cast<uint32_t>(crc32_z(crc, data, size));
}

} // namespace

Recording::Recording(RecordingHeader header, size_t reserveTicks) : header_(std::move(header)) {
    assert(header_.inputBytes > 0 && header_.inputBytes <= kMaxInputBytes);
    inputs_.reserve(reserveTicks * header_.inputBytes);
    hashes_.reserve(reserveTicks);
}

std::span<const uint8_t> Recording::input(size_t tick) const {
    assert(tick < ticks());
    return std::span(inputs_).subspan(tick * header_.inputBytes, header_.inputBytes);
}

void Recording::add(std::span<const uint8_t> input, uint64_t hash) {
    assert(input.size() == header_.inputBytes);
    inputs_.insert(inputs_.end(), input.begin(), input.end());
    hashes_.push_back(hash);
}

Status Recording::compare(size_t tick, uint64_t hash) const {
    const std::string where = "tick " + std::to_string(tick) + ": ";
    if (tick >= ticks()) return Error{"", where + "the recording ends before it"};
    if (hashes_[tick] != hash) return Error{"", where + "the state differs from the recorded one"};
    return Done{};
}

Status writeRecording(const Path& file, const Recording& recording) {
    const size_t inputBytes = recording.header().inputBytes, stride = inputBytes + 8;
    std::vector<uint8_t> body(recording.ticks() * stride);
    for (size_t tick = 0; tick < recording.ticks(); ++tick) {
        const auto now = recording.input(tick);
        uint8_t* out = body.data() + tick * stride;
        for (size_t i = 0; i < inputBytes; ++i)
            out[i] = tick == 0 ? now[i] : now[i] ^ recording.input(tick - 1)[i];
        const uint64_t hash = recording.hash(tick);
        std::memcpy(out + inputBytes, &hash, 8);
    }
    std::vector<uint8_t> packed(compressBound(body.size()));
    uLongf packedSize = packed.size();
    if (compress2(packed.data(), &packedSize, body.data(), body.size(), 6) != Z_OK)
        return Error{file.string(), "could not be packed"};

    const nlohmann::json json = {{"version", kVersion},
                                 {"seed", recording.header().seed},
                                 {"dive", recording.header().dive},
                                 {"settings", recording.header().settings},
                                 {"tick_rate_Hz", kTickRate_Hz},
                                 {"input_bytes", inputBytes}};
    const std::string header = json.dump();
    uint32_t crc = crcOf(reinterpret_cast<const uint8_t*>(header.data()), header.size());
    crc = crcOf(packed.data(), packedSize, crc);
    std::string bytes(kMagic, sizeof kMagic);
    append(bytes, static_cast<uint32_t>(header.size()));
    append(bytes, static_cast<uint64_t>(recording.ticks()));
    append(bytes, static_cast<uint64_t>(packedSize));
    append(bytes, crc);
    bytes += header;
    bytes.append(reinterpret_cast<const char*>(packed.data()), packedSize);
    return writeFileWhole(file, bytes);
}

Result<Recording> readRecording(const Path& file, uint64_t maxUnpackedBytes) {
    auto read = readFile(file, kMaxFileBytes);
    if (!read) return read.error();
    const auto fail = [&](std::string reason) { return Error{file.string(), std::move(reason)}; };
    const std::vector<uint8_t>& bytes = *read;
    if (bytes.size() < kPrefix || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
        return fail("is not a recording of this game");

    const uint8_t* at = bytes.data() + sizeof kMagic;
    const auto headerSize = take<uint32_t>(at);
    const auto ticks = take<uint64_t>(at);
    const auto packedSize = take<uint64_t>(at);
    const auto crc = take<uint32_t>(at);
    const uint64_t rest = bytes.size() - kPrefix;
    if (headerSize > kMaxHeaderBytes || headerSize > rest || packedSize != rest - headerSize)
        return fail("is cut short or damaged: its lengths do not add up");
    if (crcOf(at, rest) != crc) return fail("is damaged: its checksum is wrong");

    RecordingHeader header;
    try {
        const auto json = nlohmann::json::parse(at, at + headerSize);
        if (const int version = json.at("version"); version != kVersion)
            return fail("has version " + std::to_string(version) + ", this game reads version " +
                        std::to_string(kVersion));
        if (const int rate_Hz = json.at("tick_rate_Hz"); rate_Hz != kTickRate_Hz)
            return fail("ticks at " + std::to_string(rate_Hz) + " Hz, this game at " +
                        std::to_string(kTickRate_Hz));
        json.at("seed").get_to(header.seed);
        json.at("dive").get_to(header.dive);
        json.at("input_bytes").get_to(header.inputBytes);
        json.at("settings").get_to(header.settings);
    } catch (const nlohmann::json::exception&) {
        return fail("has a header that cannot be read");
    }
    if (header.settings.size() > 64) return fail("claims too many settings");
    if (header.inputBytes == 0 || header.inputBytes > kMaxInputBytes)
        return fail("claims an impossible size of input");
    const uint64_t stride = uint64_t{header.inputBytes} + 8;
    if (ticks > maxUnpackedBytes / stride) return fail("claims more ticks than are allowed");

    std::vector<uint8_t> body(ticks * stride);
    uLongf bodySize = body.size();
    uLong consumed = packedSize;
    uint8_t nothing = 0; // zlib wants an address even where no byte is expected
    if (uncompress2(body.empty() ? &nothing : body.data(), &bodySize, at + headerSize, &consumed) != Z_OK ||
        bodySize != body.size() || consumed != packedSize)
        return fail("is damaged: its ticks cannot be unpacked");

    Recording recording(header, ticks);
    std::vector<uint8_t> input(header.inputBytes, 0);
    for (uint64_t tick = 0; tick < ticks; ++tick) {
        const uint8_t* from = body.data() + tick * stride;
        for (size_t i = 0; i < input.size(); ++i) input[i] ^= from[i];
        uint64_t hash;
        std::memcpy(&hash, from + input.size(), 8);
        recording.add(input, hash);
    }
    return recording;
}

} // namespace shoal::sim
