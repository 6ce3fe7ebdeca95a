#include "engine/render/LayerPass.h"
#include "tests/Test.h"

namespace shoal::render {
namespace {

// A wider view holds one turned about any axis until a corner leaves. The reference tests many points.
TEST(View, HoldsWhatIsInside) {
    const View wide = widened({.shift = {0.1f, -0.2f}}, 1.2f);
    int held = 0;
    for (int i = 0; i < 400; ++i) {
        const float around = static_cast<float>(i) * 0.7f, turn = static_cast<float>(i % 40) * 0.005f;
        const glm::vec3 axis =
            glm::normalize(glm::vec3(std::cos(around), std::sin(around), std::sin(3 * around)));
        const View view{
            .eyeWorld = {0, 0, 0.009f}, .worldFromEye = glm::angleAxis(turn, axis), .shift = wide.shift};
        bool inside = true;
        for (int k = 0; k < 404; ++k) {
            const float s = static_cast<float>(k % 101) / 50 - 1;
            const glm::vec2 edge = k < 101   ? glm::vec2(s, -1)
                                   : k < 202 ? glm::vec2(s, 1)
                                   : k < 303 ? glm::vec2(-1, s)
                                             : glm::vec2(1, s);
            const glm::vec3 ray = view.worldFromEye * glm::vec3(edge * view.halfExtent() + view.shift, -1);
            const glm::vec2 off = glm::abs(glm::vec2(ray) / -ray.z - wide.shift) - wide.halfExtent();
            inside &= off.x <= 1e-5f && off.y <= 1e-5f;
        }
        EXPECT_EQ(holds(wide, view), inside) << i;
        held += inside;
    }
    EXPECT_GT(held, 100);
    EXPECT_LT(held, 300);
    EXPECT_FALSE(holds(wide, {.eyeWorld = {0, 0, 0.02f}, .shift = wide.shift}));
    EXPECT_FALSE(
        holds(wide, {.worldFromEye = glm::angleAxis(std::numbers::pi_v<float>, glm::vec3(0, 1, 0))}));
}

} // namespace
} // namespace shoal::render
