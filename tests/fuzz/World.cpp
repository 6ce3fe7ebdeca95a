// The physics world with bodies of any size, speed and place: what it gives back is finite, and does not
// depend on what the world was used for before.
#include "tests/LevelFloor.h"
#include "tests/fuzz/Target.h"

#include <glm/geometric.hpp>

#include <bit>
#include <cmath>

using namespace shoal;
using namespace shoal::physics;
using fuzz::Bytes;

namespace {

constexpr float kDt = 1.0f / 120;

// Metres to both sides in steps of a millimetre, or any bits at all.
glm::vec3 vectorFrom(Bytes& bytes, bool any) {
    if (any) return bytes.next<glm::vec3>();
    const auto x = bytes.next<int16_t>(), y = bytes.next<int16_t>(), z = bytes.next<int16_t>();
    return 0.0001f * glm::vec3(x, y, z);
}

struct Scene {
    std::vector<Body> bodies;
    std::vector<Mover> movers;
    std::vector<LooseBody> loose;

    explicit Scene(Bytes& bytes) {
        const auto capsule = [&](bool any) {
            const glm::vec3 a = vectorFrom(bytes, any), half = 0.05f * vectorFrom(bytes, any);
            return Capsule{a - half, a + half, 0.0005f * (1 + bytes.next<uint8_t>())};
        };
        const size_t fish = bytes.next<uint8_t>() % 12, bones = bytes.next<uint8_t>() % 24,
                     things = bytes.next<uint8_t>() % 8;
        for (size_t i = 0; i < fish; ++i) {
            const bool any = bytes.next<uint8_t>() % 32 == 0;
            bodies.push_back({static_cast<uint32_t>(i), capsule(any), capsule(any), vectorFrom(bytes, any)});
            bodies.back().after.radius = bodies.back().before.radius;
        }
        for (size_t i = 0; i < bones; ++i) {
            const bool any = bytes.next<uint8_t>() % 32 == 0;
            movers.push_back({capsule(any), capsule(any), vectorFrom(bytes, any), vectorFrom(bytes, any),
                              static_cast<int>(i % 2), static_cast<int>(i)});
            movers.back().after.radius = movers.back().before.radius;
        }
        for (size_t i = 0; i < things; ++i) { // the rules' own state: of any size, speed and place
            LooseBody& b = loose.emplace_back();
            b.id = static_cast<uint32_t>(20 + i);
            b.radius = 0.001f * static_cast<float>(1 + bytes.next<uint8_t>());
            b.half = 0.001f * static_cast<float>(bytes.next<uint8_t>());
            b.density_kgpm3 = static_cast<float>(100 + bytes.next<uint16_t>() % 8000);
            b.position = vectorFrom(bytes, false);
            b.velocity = 100.0f * vectorFrom(bytes, false);
            b.spin = 100.0f * vectorFrom(bytes, false);
        }
    }

    // Steps a tick and checks what comes of it.
    void step(World& world, std::vector<Contact>& contacts) {
        const std::vector<Contact> last = std::move(contacts);
        world.touch(bodies, movers, kDt, last, contacts);
        for (const Contact& contact : contacts) {
            fuzz::expect(std::isfinite(contact.depth) && contact.depth >= 0);
            fuzz::expect(std::fabs(glm::length(contact.normal) - 1) < 0.01f);
        }
        std::vector<Knock> knocks;
        world.move(loose, bodies, tests::levelFloor(-1), kDt, knocks);
        for (const Knock& knock : knocks)
            fuzz::expect(knock.closing_mps > 0 && std::isfinite(knock.closing_mps));
        for (const LooseBody& b : loose) {
            fuzz::expect(std::isfinite(glm::dot(b.position, b.position)) && glm::length(b.velocity) < 15.1f);
            fuzz::expect(glm::length(b.spin) < 20.1f && std::fabs(glm::length(b.worldFromBody) - 1) < 0.01f);
        }
    }
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Bytes bytes(data, size);
    static World used;
    for (int scene = 0; scene < 4 && !bytes.empty(); ++scene) {
        Scene one(bytes), other = one;
        World fresh;
        std::vector<Contact> contacts, others;
        for (int tick = 0; tick < 6; ++tick) {
            one.step(used, contacts);
            other.step(fresh, others);
            fuzz::expect(contacts.size() == others.size());
            for (size_t i = 0; i < one.loose.size(); ++i)
                fuzz::expect(one.loose[i].position == other.loose[i].position &&
                             one.loose[i].spin == other.loose[i].spin);
        }
    }
    return 0;
}
