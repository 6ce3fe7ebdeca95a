#include "game/views/AnimalLight.h"

#include "engine/math/Trigonometry.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace shoal::app {

namespace {
constexpr size_t kEachTime = 4; // animals looked up for each picture, so 35 animals take nine pictures
constexpr float kFollow_s = 0.25f;
constexpr float kJump_m = 0.5f; // movement between two pictures from which it counts as another animal
} // namespace

void AnimalLight::follow(const game::Snapshot& snapshot, const depth::LightDifference* light,
                         const glm::mat3& envFromWorld) {
    if (!light) {
        animals_.clear();
        return;
    }
    const auto passed_s = static_cast<float>(snapshot.time_s - time_s_);
    time_s_ = snapshot.time_s;
    const float share = passed_s < 0 || passed_s > 1 ? 1 : math::followShare(passed_s, kFollow_s);
    const size_t known = animals_.size(), count = snapshot.creatures.size();
    animals_.resize(count);
    const size_t turns = std::min(kEachTime, count);
    for (size_t i = 0; i < count; ++i) {
        Animal& animal = animals_[i];
        const glm::vec3 position = snapshot.creatures[i].position;
        const bool jumped = i >= known || share == 1 || glm::distance(position, animal.position) > kJump_m;
        animal.position = position;
        if (jumped || (i + count - next_ % count) % count < turns)
            animal.found = light->at(envFromWorld * position);
        for (size_t k = 0; k < animal.now.size(); ++k)
            animal.now[k] += (jumped ? 1 : share) * (animal.found[k] - animal.now[k]);
    }
    next_ = count > 0 ? (next_ + turns) % count : 0;
}

} // namespace shoal::app
