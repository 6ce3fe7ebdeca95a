#include "content/make/depth/SweepPass.h"

#include <algorithm>
#include <array>

namespace shoal::depth {

namespace {

constexpr std::array kPairsAway = {-4, -2, -1, 1, 2, 4};

} // namespace

const SweepImage& SweepPass::imageAt(int number) {
    while (firstImage_ + static_cast<int>(images_.size()) <= number) {
        images_.emplace_back();
        const int read = firstImage_ + static_cast<int>(images_.size()) - 1;
        makeSweepImage(film_.eye(int64_t{read} * kFilmStep), images_.back());
    }
    return images_[static_cast<size_t>(number - firstImage_)];
}

void SweepPass::frame(int number, DepthEstimate& out) {
    const int last = std::min(number + kPairsAway.back() * path_.step, film_.trackCount() - 1);
    const int first = std::max(number + kPairsAway.front() * path_.step, 0);
    if (firstImage_ < 0) firstImage_ = first;
    while (firstImage_ < first) images_.pop_front(), ++firstImage_;
    imageAt(last); // reads all before it too, so that images stay where they are
    std::vector<SweepView> views;
    for (const int pairs : kPairsAway)
        if (const auto pose = poseAlongChain(path_.motions, path_.baselines_m, number, pairs, path_.step))
            views.push_back({&imageAt(number + pairs * path_.step), glm::mat3(pose->fromReference),
                             glm::vec3(pose->at), pairs > 0});
    sweep_.estimate(imageAt(number), views, maxInverse_perM_, out);
}

} // namespace shoal::depth
