#include "engine/physics/Push.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace shoal::physics {

namespace {

constexpr size_t kMax = 64; // contacts looked at: two hands have 48 bones

// min |v - velocity|^2 + kSoftness |impulses|^2 so that v . n >= goal, impulses >= 0.
template <class Goal> glm::vec3 solve(glm::vec3 velocity, std::span<const Contact> contacts, Goal goal) {
    std::array<float, kMax> impulse{};
    const size_t count = std::min(contacts.size(), kMax);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        bool done = true;
        for (size_t i = 0; i < count; ++i) {
            const glm::vec3 n = contacts[i].normal;
            const float lacks = goal(contacts[i]) - glm::dot(velocity, n) - kSoftness * impulse[i];
            const float next = std::max(0.0f, impulse[i] + lacks / (1 + kSoftness));
            if (next == impulse[i]) continue;
            velocity += n * (next - impulse[i]);
            impulse[i] = next;
            done = false;
        }
        if (done) break;
    }
    return velocity;
}

} // namespace

glm::vec3 pushed(glm::vec3 velocity, std::span<const Contact> contacts) {
    return solve(velocity, contacts, [](const Contact& c) { return glm::dot(c.moverVelocity, c.normal); });
}

glm::vec3 parting(std::span<const Contact> contacts) {
    const glm::vec3 velocity = solve(glm::vec3(0), contacts, [](const Contact& c) {
        if (!c.lasting) return 0.0f;
        return std::min(kPartRate_Hz * std::max(0.0f, c.depth - kPartSlop_m), kPartMax_mps);
    });
    const float speed = glm::length(velocity); // in a wedge, more than any one contact asks
    return speed > kPartMax_mps ? velocity * (kPartMax_mps / speed) : velocity;
}

} // namespace shoal::physics
