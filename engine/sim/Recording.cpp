#include "engine/sim/Recording.h"

#include "engine/core/WriteFile.h"

#include <nlohmann/json.hpp>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>

namespace shoal::sim {

static_assert(std::endian::native == std::endian::little, "recordings are little-endian");

namespace {

constexpr std::string_view kMagic = "SHOALRE2";
constexpr int kVersion = 3;
constexpr uint32_t kMaxInputBytes = 65536, kMaxHeaderBytes = 1u << 20;
constexpr uint32_t kBlockTicks = static_cast<uint32_t>(kTickRate_Hz);
constexpr size_t kBlockPrefix = 12, kHashBytes = 8;

template <class T> void append(std::string& to, T value) {
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T> T take(const uint8_t*& from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    from += sizeof value;
    return value;
}

uint32_t crcOf(std::span<const uint8_t> bytes, uint32_t crc = 0) {
    // zlib begins anew where it is given no address.
    return bytes.empty() ? crc : static_cast<uint32_t>(crc32_z(crc, bytes.data(), bytes.size()));
}

std::span<const uint8_t> asBytes(std::string_view text) {
    return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

// zlib's, for what comes in small parts.
uint64_t longestPacked(uint64_t bytes) { return compressBound(bytes) + 4096; }

std::string blockPrefix(uint32_t ticks, std::span<const uint8_t> packed) {
    std::string prefix;
    append(prefix, ticks);
    append(prefix, static_cast<uint32_t>(packed.size()));
    append(prefix, crcOf(packed, crcOf(asBytes(prefix))));
    return prefix;
}

Result<RecordingHeader> parseHeader(std::span<const uint8_t> text) {
    const auto fail = [](std::string reason) { return Error{"", std::move(reason)}; };
    RecordingHeader header;
    try {
        const auto json = nlohmann::json::parse(text.begin(), text.end());
        const auto whole = [&](const char* key) { return json.at(key).get_ref<const uint64_t&>(); };
        if (const uint64_t written = whole("version"); written != kVersion)
            return fail("has version " + std::to_string(written) + ", this game reads version " +
                        std::to_string(kVersion));
        if (const uint64_t rate_Hz = whole("tick_rate_Hz"); rate_Hz != kTickRate_Hz)
            return fail("ticks at " + std::to_string(rate_Hz) + " Hz, this game at " +
                        std::to_string(kTickRate_Hz));
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

struct RecordingWriter::State {
    State(GrowingFile opened, uint32_t bytes)
        : file(std::move(opened)), before(bytes), tick(bytes + kHashBytes) {
        packed.resize(longestPacked(uint64_t{kBlockTicks} * tick.size()));
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() { deflateEnd(&stream); }

    void beginBlock() {
        ticks = 0;
        std::ranges::fill(before, uint8_t{0});
        deflateReset(&stream);
        stream.next_out = packed.data();
        stream.avail_out = static_cast<uInt>(packed.size());
    }

    Status endBlock() {
        if (ticks == 0) return Done{};
        stream.next_in = nullptr;
        stream.avail_in = 0;
        if (deflate(&stream, Z_FINISH) != Z_STREAM_END) return Error{"", "a recording could not be packed"};
        const std::span body(packed.data(), stream.total_out);
        std::string block = blockPrefix(ticks, body);
        block.append(reinterpret_cast<const char*>(body.data()), body.size());
        beginBlock();
        return file.write(block);
    }

    GrowingFile file;
    z_stream stream{};
    std::vector<uint8_t> before, tick, packed; // the last tick's input; a tick as it is packed; the block
    uint32_t ticks = 0;                        // in the block
    std::optional<Error> failure;              // for which nothing more is written
};

Result<RecordingWriter> RecordingWriter::create(const Path& file, const RecordingHeader& header) {
    assert(header.inputBytes > 0 && header.inputBytes <= kMaxInputBytes);
    auto opened = GrowingFile::create(file);
    if (!opened) return opened.error();
    const nlohmann::json json = {{"version", kVersion},          {"seed", header.seed},
                                 {"dive", header.dive},          {"settings", header.settings},
                                 {"tick_rate_Hz", kTickRate_Hz}, {"input_bytes", header.inputBytes}};
    const std::string text = json.dump();
    std::string bytes(kMagic);
    append(bytes, static_cast<uint32_t>(text.size()));
    append(bytes, crcOf(asBytes(text)));
    if (Status written = opened->write(bytes + text); !written) return written.error();
    auto state = makeHidden<State>(std::move(*opened), header.inputBytes);
    if (deflateInit(&state->stream, Z_DEFAULT_COMPRESSION) != Z_OK)
        return Error{file.string(), "cannot be written: not enough memory"};
    state->beginBlock();
    return RecordingWriter(std::move(state));
}

Status RecordingWriter::add(std::span<const uint8_t> input, uint64_t hash) {
    State& s = *state_;
    assert(input.size() == s.before.size());
    if (s.failure) return *s.failure;
    for (size_t i = 0; i < input.size(); ++i) s.tick[i] = input[i] ^ s.before[i];
    std::memcpy(s.tick.data() + input.size(), &hash, kHashBytes);
    std::ranges::copy(input, s.before.begin());
    s.stream.next_in = s.tick.data();
    s.stream.avail_in = static_cast<uInt>(s.tick.size());
    deflate(&s.stream, Z_NO_FLUSH);
    if (++s.ticks < kBlockTicks) return Done{};
    const Status written = s.endBlock();
    if (!written) s.failure = written.error();
    return written;
}

Status RecordingWriter::finish() {
    State& s = *state_;
    if (s.failure) return *s.failure;
    Status written = s.endBlock();
    if (written) written = s.file.write(blockPrefix(0, {}));
    if (written) written = s.file.finish();
    if (!written) s.failure = written.error();
    return written;
}

// An open recording, and where its blocks are.
struct RecordingReader::File {
    struct Block {
        uint64_t at; // of the packed body
        uint64_t ticks;
        uint64_t packedBytes;
    };

    File() = default;
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    ~File() {
        if (descriptor >= 0) ::close(descriptor);
    }

    // False: these bytes are not there.
    bool read(uint64_t at, std::span<uint8_t> to) const {
        while (!to.empty()) {
            const ssize_t got = ::pread(descriptor, to.data(), to.size(), static_cast<off_t>(at));
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) return false;
            at += static_cast<uint64_t>(got);
            to = to.subspan(static_cast<size_t>(got));
        }
        return true;
    }

    uint64_t stride() const { return uint64_t{header.inputBytes} + kHashBytes; }
    Error fail(std::string reason) const { return Error{path.string(), std::move(reason)}; }
    Status open(uint64_t maxBlockBytes);
    Status readHeader();
    bool addBlock(uint64_t& at, std::vector<uint8_t>& body);

    Path path;
    int descriptor = -1;
    uint64_t size = 0;
    RecordingHeader header;
    std::vector<Block> blocks;
    uint64_t ticks = 0;
    bool complete = false;
};

Status RecordingReader::File::open(uint64_t maxBlockBytes) {
    // As readFile() words it: not a FIFO, whose opening would wait.
    std::error_code code;
    const auto status = std::filesystem::status(path, code);
    if (!std::filesystem::exists(status)) return fail("there is no such file");
    if (!std::filesystem::is_regular_file(status)) return fail("is not a regular file");
    descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat found {};
    if (descriptor < 0 || ::fstat(descriptor, &found) != 0)
        return fail("cannot be opened; check its permissions");
    size = static_cast<uint64_t>(found.st_size);
    std::array<uint8_t, 8> magic{};
    const bool read8 = read(0, magic);
    const std::string_view begin(reinterpret_cast<const char*>(magic.data()), magic.size());
    if (!read8 || begin != kMagic) return fail("is not a recording of this game");
    if (Status opened = readHeader(); !opened) return opened;
    if (stride() * kBlockTicks > maxBlockBytes) return fail("claims more input than is allowed");
    return Done{};
}

Status RecordingReader::File::readHeader() {
    constexpr uint64_t kPrefix = 8 + 4 + 4;
    std::array<uint8_t, kPrefix> prefix;
    if (!read(0, prefix)) return fail("is cut short");
    const uint8_t* at = prefix.data() + kMagic.size();
    const auto headerBytes = take<uint32_t>(at);
    const auto crc = take<uint32_t>(at);
    if (headerBytes > kMaxHeaderBytes || headerBytes > size - kPrefix)
        return fail("is cut short or damaged: its lengths do not add up");
    std::vector<uint8_t> body(headerBytes);
    if (!read(kPrefix, body)) return fail("is cut short");
    if (crcOf(body) != crc) return fail("is damaged: its checksum is wrong");
    auto parsed = parseHeader(body);
    if (!parsed) return fail(parsed.error().reason);
    header = std::move(*parsed);
    uint64_t next = kPrefix + headerBytes;
    while (addBlock(next, body)) {
    }
    return Done{};
}

// at: where the block begins; then where it ends. False: it was the last, or it is not whole.
bool RecordingReader::File::addBlock(uint64_t& at, std::vector<uint8_t>& body) {
    std::array<uint8_t, kBlockPrefix> prefix;
    if (size - at < kBlockPrefix || !read(at, prefix)) return false;
    at += kBlockPrefix;
    const uint8_t* field = prefix.data();
    const auto blockTicks = take<uint32_t>(field);
    const auto packedBytes = take<uint32_t>(field);
    const auto crc = take<uint32_t>(field);
    if (blockTicks > kBlockTicks || packedBytes > longestPacked(blockTicks * stride()) ||
        packedBytes > size - at)
        return false;
    body.resize(packedBytes);
    if (!read(at, body) || crcOf(body, crcOf(std::span(prefix).first<8>())) != crc) return false;
    if (blockTicks == 0) {
        complete = at == size;
        return false;
    }
    blocks.push_back({at, blockTicks, packedBytes});
    ticks += blockTicks;
    at += packedBytes;
    return true;
}

RecordingReader::RecordingReader(std::shared_ptr<const File> file)
    : file_(std::move(file)), input_(file_->header.inputBytes) {}

Result<RecordingReader> RecordingReader::open(const Path& path, uint64_t maxBlockBytes) {
    auto file = std::make_shared<File>();
    file->path = path;
    if (Status opened = file->open(maxBlockBytes); !opened) return opened.error();
    return RecordingReader(std::move(file));
}

const RecordingHeader& RecordingReader::header() const { return file_->header; }
uint64_t RecordingReader::ticks() const { return file_->ticks; }
bool RecordingReader::complete() const { return file_->complete; }

Status RecordingReader::unpackBlock() {
    const File::Block& block = file_->blocks[block_];
    std::vector<uint8_t> packed(block.packedBytes);
    body_.resize(block.ticks * file_->stride());
    uLongf bodyBytes = body_.size();
    uLong consumed = packed.size();
    if (!file_->read(block.at, packed) ||
        uncompress2(body_.data(), &bodyBytes, packed.data(), &consumed) != Z_OK ||
        bodyBytes != body_.size() || consumed != packed.size())
        return file_->fail("is damaged: its ticks cannot be unpacked from tick " + std::to_string(position_) +
                           " on");
    std::ranges::fill(input_, uint8_t{0});
    at_ = 0;
    ++block_;
    return Done{};
}

Result<RecordedTick> RecordingReader::next() {
    assert(!atEnd());
    if (at_ == body_.size())
        if (Status unpacked = unpackBlock(); !unpacked) return unpacked.error();
    const uint8_t* from = body_.data() + at_;
    for (size_t i = 0; i < input_.size(); ++i) input_[i] ^= from[i];
    uint64_t hash;
    std::memcpy(&hash, from + input_.size(), kHashBytes);
    at_ += file_->stride();
    ++position_;
    return RecordedTick{input_, hash};
}

Status sameState(uint64_t tick, uint64_t recorded, uint64_t now) {
    if (recorded == now) return Done{};
    return Error{"", "tick " + std::to_string(tick) + ": the state differs from the recorded one"};
}

} // namespace shoal::sim
