// Everything solid under the water: traced, shadowed, and lit by what its surroundings send back.
#pragma once

#include "content/make/video/Embree.h"
#include "content/make/video/Lamps.h"
#include "content/make/video/Mesh.h"
#include "content/make/video/Route.h"

#include <array>
#include <memory>

namespace shoal::reef {

struct Hit {
    float distance = 0;
    vec3 p{0}, normal{0}; // the normal faces the viewer
    vec3 albedo{0};
    vec3 indirect{0}; // irradiance from all but sun and lamps themselves
    vec3 glow{0};     // radiance of its own
    Kind kind = Kind::Rock;
};

constexpr float kGridCell = 0.5f; // metres

class World {
  public:
    // Grows; is dark as yet.
    World(const Scene& scene, const Route& route);

    // Lights all once: read from `cache` if it holds it, and kept there if not.
    void lightOnce(const Path& cache);

    // Moves what sways near the camera. turn: 0..1.
    void advance(float turn, const vec3& camera);

    bool trace(const vec3& origin, const vec3& dir, float furthest, Hit& hit) const;
    // The share of the sun that solid things leave at a place.
    float sunlit(const vec3& p) const;
    float sunlitSoft(const vec3& p) const; // with the penumbra that waves and disc make
    // Mean radiance over all directions but the sun's and the lamps'.
    vec3 ambient(const vec3& p) const;
    const Lamps& lamps() const { return lamps_; }

  private:
    void raise(Mesh&& still, Mesh&& swaying);
    void castShadows();
    void light();
    void lightGrid(int rays);
    void lightVertices(int rays);
    void smooth(size_t part);
    vec3 incoming(const vec3& origin, const vec3& dir, bool& fromBehind) const;
    bool load(const Path& cache, uint64_t key);
    void save(const Path& cache, uint64_t key) const;

    struct Release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    };
    const Scene& scene_;
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device_;
    std::unique_ptr<std::remove_pointer_t<RTCScene>, Release> stillScene_, swayingScene_;
    std::array<Mesh, 2> parts_; // still, swaying
    std::array<std::vector<vec3>, 2> indirect_;
    std::vector<vec3> moved_; // the swaying part's places now
    float duration_ = 0;
    std::vector<float>
        shadow_; // height of what the sun meets first, by the place where its ray enters the water
    Lamps lamps_;
    vec3 gridLow_{0};
    glm::ivec3 gridCells_{0};
    std::vector<vec3> grid_;
    size_t cell(int x, int y, int z) const {
        return static_cast<size_t>((z * gridCells_.y + y) * gridCells_.x + x);
    }
};

} // namespace shoal::reef
