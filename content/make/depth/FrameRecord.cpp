#include "content/make/depth/FrameRecord.h"

#include "engine/core/Hash.h"
#include "engine/math/LatLong.h"

#include <algorithm>
#include <cstddef>

namespace shoal::depth {

namespace {

constexpr float kCodes = 16384; // code of an inverse distance of 1

uint64_t checkOf(const FrameRecord& record) {
    Hash hash;
    hash.bytes(&record, offsetof(FrameRecord, check));
    return hash.value();
}

} // namespace

glm::vec3 estimateDirection(size_t texel) {
    const int at = static_cast<int>(texel);
    return texelDirection(at % kEstimateWidth, at / kEstimateWidth, kEstimateWidth, kEstimateHeight);
}

void FrameRecord::set(const DepthEstimate& depth) {
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        inverse[i] = static_cast<uint16_t>(std::clamp(depth.inverse[i] * kCodes, 0.0f, 65535.0f));
        confidence[i] = static_cast<uint8_t>(depth.confidence[i] * 255 + 0.5f);
    }
}

void FrameRecord::get(double inverseFactor, DepthEstimate& depth) const {
    depth.inverse.resize(kEstimateTexels), depth.confidence.resize(kEstimateTexels);
    const auto factor = static_cast<float>(inverseFactor / static_cast<double>(kCodes));
    for (size_t i = 0; i < kEstimateTexels; ++i) {
        depth.inverse[i] = static_cast<float>(inverse[i]) * factor;
        depth.confidence[i] = static_cast<float>(confidence[i]) / 255.0f;
    }
}

RecordFile::RecordFile(Path file, uint64_t identity, int count)
    : file_(std::move(file)), head_{kMagic, identity} {
    std::ifstream in(file_, std::ios::binary);
    uint64_t head[2] = {};
    if (!in.read(reinterpret_cast<char*>(head), sizeof head) || head[0] != head_[0] || head[1] != head_[1])
        return;
    FrameRecord record;
    while (done_ < count && in.read(reinterpret_cast<char*>(&record), sizeof record) &&
           record.check == checkOf(record))
        ++done_;
}

Status RecordFile::begin() {
    const uint64_t kept = sizeof head_ + static_cast<uint64_t>(done_) * sizeof(FrameRecord);
    if (Status s = GrowingFile::open(file_, done_ > 0 ? kept : 0).moveTo(out_); !s) return s;
    return done_ > 0 ? Status(Done{}) : out_->write({reinterpret_cast<const char*>(head_), sizeof head_});
}

Status RecordFile::add(FrameRecord& record) {
    record.check = checkOf(record);
    ++done_;
    return out_->write({reinterpret_cast<const char*>(&record), sizeof record});
}

bool RecordFile::read(int number, FrameRecord& record) {
    if (!in_.is_open()) in_.open(file_, std::ios::binary);
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(sizeof head_ + static_cast<size_t>(number) * sizeof record));
    return in_.read(reinterpret_cast<char*>(&record), sizeof record) && record.check == checkOf(record);
}

void RecordFile::remove() {
    in_.close(), out_.reset();
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
}

} // namespace shoal::depth
