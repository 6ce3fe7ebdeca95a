#include "engine/sim/Recording.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

namespace shoal::sim {

static_assert(std::endian::native == std::endian::little, "recordings are little-endian");

namespace {

using Bytes = std::span<const uint8_t>;

constexpr std::string_view kMagic = "SHOALRE2";
constexpr int kVersion = 5;
constexpr uint32_t kMaxInputBytes = 65536, kMaxHeaderBytes = 1u << 20;
constexpr uint64_t kMaxFileBytes = uint64_t{4} << 30;
constexpr auto kBlockTicks = static_cast<uint32_t>(kTickRate_Hz);
constexpr size_t kHeaderPrefix = 16, kBlockPrefix = 12, kHashBytes = 8;

template <class T> std::string bytesOf(T value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

template <class T> T valueAt(Bytes bytes, size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

Bytes asBytes(std::string_view text) { return {reinterpret_cast<const uint8_t*>(text.data()), text.size()}; }

uint32_t crcOf(Bytes bytes, uint32_t crc = 0) {
    // zlib would start a new checksum if it were given a null pointer.
    return bytes.empty() ? crc : static_cast<uint32_t>(crc32_z(crc, bytes.data(), bytes.size()));
}

std::string blockOf(uint32_t ticks, std::string_view packed) {
    const std::string prefix = bytesOf(ticks) + bytesOf(static_cast<uint32_t>(packed.size()));
    return prefix + bytesOf(crcOf(asBytes(packed), crcOf(asBytes(prefix)))) + std::string(packed);
}

Result<RecordingHeader> parseHeader(std::span<const uint8_t> text) {
    const auto fail = [](std::string reason) { return Error{"", std::move(reason)}; };
    RecordingHeader header;
    try {
        const auto json = nlohmann::json::parse(text.begin(), text.end());
        const auto whole = [&](const char* key) { return json.at(key).get_ref<const uint64_t&>(); };
        if (const uint64_t written = whole("version"); written != kVersion)
            return fail(fmt::format("has version {}, this game reads version {}", written, kVersion));
        if (const uint64_t rate_Hz = whole("tick_rate_Hz"); rate_Hz != kTickRate_Hz)
            return fail(fmt::format("ticks at {} Hz, this game at {}", rate_Hz, kTickRate_Hz));
        header.seed = whole("seed");
        json.at("dive").get_to(header.dive);
        header.inputBytes = static_cast<uint32_t>(std::min<uint64_t>(whole("input_bytes"), UINT32_MAX));
        json.at("settings").get_to(header.settings);
    } catch (const nlohmann::json::exception&) {
        return fail("has a header that cannot be read");
    }
    if (header.settings.size() > 64) return fail("claims too many settings");
    if (header.inputBytes == 0 || header.inputBytes > kMaxInputBytes)
        return fail("claims an impossible size of input");
    return header;
}

} // namespace

Result<RecordingWriter> RecordingWriter::create(const Path& file, const RecordingHeader& header) {
    assert(header.inputBytes > 0 && header.inputBytes <= kMaxInputBytes);
    auto opened = GrowingFile::open(file);
    if (!opened) return opened.error();
    const nlohmann::json json = {{"version", kVersion},          {"seed", header.seed},
                                 {"dive", header.dive},          {"settings", header.settings},
                                 {"tick_rate_Hz", kTickRate_Hz}, {"input_bytes", header.inputBytes}};
    const std::string text = json.dump();
    const Status written = opened->write(std::string(kMagic) + bytesOf(static_cast<uint32_t>(text.size())) +
                                         bytesOf(crcOf(asBytes(text))) + text);
    if (!written) return written.error();
    return RecordingWriter(std::move(*opened), header.inputBytes);
}

Status RecordingWriter::add(std::span<const uint8_t> input, uint64_t hash) {
    assert(input.size() == before_.size());
    for (size_t i = 0; i < input.size(); ++i) body_ += static_cast<char>(input[i] ^ before_[i]);
    body_ += bytesOf(hash);
    std::ranges::copy(input, before_.begin());
    return ++ticks_ < kBlockTicks ? Done{} : endBlock();
}

Status RecordingWriter::endBlock() {
    if (ticks_ == 0) return Done{};
    uLongf size = compressBound(body_.size());
    std::string packed(size, 0);
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, asBytes(body_).data(), body_.size(),
                  Z_BEST_SPEED) != Z_OK)
        return Error{"", "a recording could not be packed"};
    packed.resize(size);
    body_.clear();
    std::ranges::fill(before_, uint8_t{0});
    return file_.write(blockOf(std::exchange(ticks_, 0), packed));
}

Status RecordingWriter::finish() {
    Status written = endBlock();
    if (written) written = file_.write(blockOf(0, {}));
    return written ? file_.finish() : written;
}

Result<RecordingReader> RecordingReader::open(const Path& path) {
    auto bytes = readFile(path, kMaxFileBytes);
    if (!bytes) return bytes.error();
    const auto fail = [&](std::string reason) { return Error{path.string(), std::move(reason)}; };
    auto file = std::make_shared<File>(File{path, std::move(*bytes)});
    const Bytes all = file->bytes;
    if (all.size() < kHeaderPrefix || !std::ranges::equal(all.first(kMagic.size()), asBytes(kMagic)))
        return fail("is not a recording of this game");
    const auto length = valueAt<uint32_t>(all, 8);
    if (length > kMaxHeaderBytes || length > all.size() - kHeaderPrefix)
        return fail("is cut short or damaged: its lengths do not add up");
    const Bytes header = all.subspan(kHeaderPrefix, length);
    if (crcOf(header) != valueAt<uint32_t>(all, 12)) return fail("is damaged: its checksum is wrong");
    if (Status s = parseHeader(header).moveTo(file->header); !s) return fail(s.error().reason);
    findBlocks(*file, all.subspan(kHeaderPrefix + length));
    return RecordingReader(std::move(file));
}

// Finds the complete blocks, up to the first that is incomplete or damaged. rest: the bytes after the header.
void RecordingReader::findBlocks(File& file, Bytes rest) {
    while (rest.size() >= kBlockPrefix) {
        const auto ticks = valueAt<uint32_t>(rest, 0), length = valueAt<uint32_t>(rest, 4);
        if (ticks > kBlockTicks || length > rest.size() - kBlockPrefix) return;
        const Bytes packed = rest.subspan(kBlockPrefix, length);
        if (crcOf(packed, crcOf(rest.first(8))) != valueAt<uint32_t>(rest, 8)) return;
        rest = rest.subspan(kBlockPrefix + length);
        if (ticks == 0) {
            file.complete = rest.empty();
            return;
        }
        file.blocks.push_back({ticks, packed});
        file.ticks += ticks;
    }
}

Result<RecordedTick> RecordingReader::next() {
    assert(!atEnd());
    if (at_ == body_.size()) {
        const Block& block = file_->blocks[block_++];
        body_.resize(block.ticks * (input_.size() + kHashBytes));
        uLongf size = body_.size();
        uLong consumed = block.packed.size();
        if (uncompress2(body_.data(), &size, block.packed.data(), &consumed) != Z_OK || size != body_.size())
            return Error{file_->path.string(),
                         fmt::format("is damaged: its ticks cannot be unpacked from tick {} on", position_)};
        std::ranges::fill(input_, uint8_t{0});
        at_ = 0;
    }
    for (uint8_t& byte : input_) byte ^= body_[at_++];
    const auto hash = valueAt<uint64_t>(body_, at_);
    at_ += kHashBytes;
    ++position_;
    return RecordedTick{input_, hash};
}

Status sameState(uint64_t tick, uint64_t recorded, uint64_t now) {
    if (recorded == now) return Done{};
    return Error{"", fmt::format("tick {}: the state differs from the recorded one", tick)};
}

} // namespace shoal::sim
