#include "engine/render/software/Coverage.h"

#include <algorithm>

namespace shoal::render {

void Coverage::find(std::span<const uint32_t> pixels, const glm::ivec2& size) {
    blocks_ = (size + kBlock - 1) / kBlock;
    covered_.assign(static_cast<size_t>(blocks_.x) * static_cast<size_t>(blocks_.y), 0);
    const uint32_t* row = pixels.data();
    for (int y = 0; y < size.y; ++y, row += size.x)
        for (int block = 0; block < blocks_.x; ++block) {
            uint32_t all = 0;
            const int end = std::min((block + 1) * kBlock, size.x);
            for (int x = block * kBlock; x < end; ++x) all |= row[x];
            covered_[static_cast<size_t>(y / kBlock * blocks_.x + block)] |= all != 0;
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
