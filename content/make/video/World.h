// Everything solid under the water, with ray tracing, sun shadows and stored indirect light.
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
    vec3 indirect{0}; // irradiance without the direct light of sun and lamps
    vec3 glow{0};     // emitted radiance
    Kind kind = Kind::Rock;
};

constexpr float kGridCell = 0.5f; // metres

class World {
  public:
    // Builds the meshes; lightOnce() computes their light.
    World(const Scene& scene, const Route& route);

    // Reads the indirect light from `cache` or, if it is not there, computes it and writes it there.
    void lightOnce(const Path& cache);

    // Moves the swaying meshes near the camera. turn: time in films, 0..1.
    void advance(float turn, const vec3& camera);

    // Puts an animal into the scene in place of the last, and lights it. World frame.
    void putAnimal(Mesh&& animal);

    bool trace(const vec3& origin, const vec3& dir, float furthest, Hit& hit) const;
    // Returns the share of the sun that solid things do not block at a place.
    float sunlit(const vec3& p) const;
    float sunlitSoft(const vec3& p) const; // with the penumbra that waves and the sun's disc cause
    bool isShadedByAnimal(const vec3& p) const;
    // Returns the mean radiance over all directions, without the direct light of sun and lamps.
    vec3 ambient(const vec3& p) const;
    const Lamps& lamps() const { return lamps_; }

  private:
    enum Part : size_t { kStill, kSwaying, kAnimal, kParts };
    void raise(Part part, Mesh&& mesh);
    void castShadows();
    void light();
    void lightGrid(int rays);
    void lightVertices(Part part, int rays);
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
    std::array<std::unique_ptr<std::remove_pointer_t<RTCScene>, Release>, kParts> scenes_; // null: empty
    std::array<Mesh, kParts> parts_;
    std::array<std::vector<vec3>, kParts> indirect_;
    std::vector<vec3> moved_; // current positions of the swaying part
    float duration_ = 0;
    std::vector<float>
        shadow_; // shadow map: height of the first surface on a sun ray, by where the ray enters the water
    Lamps lamps_;
    vec3 gridLow_{0};
    glm::ivec3 gridCells_{0};
    std::vector<vec3> grid_;
    size_t cell(int x, int y, int z) const {
        return static_cast<size_t>((z * gridCells_.y + y) * gridCells_.x + x);
    }
};

} // namespace shoal::reef
