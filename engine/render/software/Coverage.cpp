#include "engine/render/software/Coverage.h"

#include <algorithm>
#include <cstddef>

namespace shoal::render {

namespace {

bool isAny(const uint32_t* pixels, int count) {
    uint32_t all = 0;
    if (count == Coverage::kBlock) // a loop of known length becomes a few vectors
        for (int i = 0; i < Coverage::kBlock; ++i) all |= pixels[i];
    else
        for (int i = 0; i < count; ++i) all |= pixels[i];
    return all != 0;
}

} // namespace

void Coverage::find(std::span<const uint32_t> pixels, const glm::ivec2& size) {
    blocks_ = (size + kBlock - 1) / kBlock;
    covered_.assign(static_cast<size_t>(blocks_.x) * static_cast<size_t>(blocks_.y), 0);
    const uint32_t* row = pixels.data();
    for (int y = 0; y < size.y; ++y, row += size.x) {
        uint8_t* covered = covered_.data() + ptrdiff_t{y / kBlock} * blocks_.x;
        for (int block = 0; block < blocks_.x; ++block)
            covered[block] |= isAny(row + block * kBlock, std::min(kBlock, size.x - block * kBlock));
    }
}

bool Coverage::any(const glm::ivec2& low, const glm::ivec2& high) const {
    const int left = std::max(low.x, 0) / kBlock, right = std::min(high.x / kBlock, blocks_.x - 1),
              bottom = std::max(low.y, 0) / kBlock, top = std::min(high.y / kBlock, blocks_.y - 1);
    if (high.x < 0 || high.y < 0) return false;
    for (int y = bottom; y <= top; ++y)
        for (int x = left; x <= right; ++x)
            if (covered_[static_cast<size_t>(y * blocks_.x + x)]) return true;
    return false;
}

} // namespace shoal::render
