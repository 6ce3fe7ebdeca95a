// One interface for all methods of diffuse light under occlusion: structs of functions.
#pragma once

#include "content/make/models/occlusion/Silhouettes.h"
#include "engine/light/EnvironmentLight.h"
#include "engine/math/SphericalHarmonics.h"
#include "tests/bench/occlusion/Scene.h"

namespace shoal::bench {

enum class Part { Baseline, Thesis, Game, Off, Exact };

struct OcclusionLabel {
    std::string name, brief, family, source;
    Part part = Part::Baseline;
};

// An environment in the forms that methods read.
struct Lit {
    std::string name;
    bool pointSun = false;
    light::EnvironmentLight light;
    math::ShRgb harmonics{};
};

struct OcclusionMethod {
    OcclusionLabel label;
    // Called once for each scene, and again whenever something in it moves if `moves` is Rebuilt.
    std::function<void(const Scene&, const Rays&)> build;
    std::function<size_t()> bytes;           // memory for the whole scene, after build
    std::function<void(const Lit&)> relight; // called once for each frame of an environment
    std::function<void(std::span<const Receiver>, std::span<glm::vec3>)> shade;
    enum class Moves {
        Free,    // follows bones and bodies at no cost
        Rigid,   // follows whole bodies; correct for a body in the pose that it was built in
        Rebuilt, // correct for the scene as it was built
    } moves = Moves::Free;
    // Optional: works out beforehand what does not depend on the environment, for these receivers in the
    // calls of shade() that follow; none: forgets it. For the errors alone, never while time is taken.
    std::function<void(std::span<const Receiver>)> foresee = {};
};

// Returns the method that ignores occlusion.
OcclusionMethod ignored();

// The other methods, each defined in a file of its own kind.
OcclusionMethod bakedOcclusion(bool ownBodyAtRest);
OcclusionMethod transfer(int bands, bool ownBodyAtRest);
OcclusionMethod coherentShadowMaps(int directions, int size);
OcclusionMethod layeredDepth(int directions, int size);
OcclusionMethod exactRays(int directions);
// Occluders: the other bodies' ellipsoids; also each body's self-occlusion at rest; and also its own
// ellipsoids if it bends sharply.
enum class Casting { Others, OthersAndFolds, All };
OcclusionMethod ellipsoids(Casting casting);
// Returns a body's ellipsoids, in the world.
std::vector<occlusion::Ellipsoid> ellipsoidsOf(const Body& body);
// Returns, for each body, the ellipsoids of all other bodies.
std::vector<std::vector<occlusion::Occluder>> castingOnOthers(const Scene& scene);
// Layered fragment buffers, asked in some directions: 6 cells^2 views of the thesis', or views of the cured.
constexpr int kUsualCells = 5, kUsualViews = 6 * kUsualCells * kUsualCells, kUsualPixels = 64;
OcclusionMethod thesisLayers(int directions, int cells = kUsualCells, int resolution = kUsualPixels);
OcclusionMethod curedLayers(int directions, int views = kUsualViews, int resolution = kUsualPixels);

} // namespace shoal::bench
