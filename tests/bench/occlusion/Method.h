// One interface for all methods of diffuse light under occlusion: plain values which hold functions.
#pragma once

#include "engine/light/EnvironmentLight.h"
#include "engine/math/SphericalHarmonics.h"
#include "tests/bench/occlusion/Scene.h"

#include <functional>
#include <span>
#include <string>

namespace shoal::bench {

enum class Part { Baseline, Thesis, Game, Off, Exact };

struct OcclusionLabel {
    std::string name, brief, family, source;
    Part part = Part::Baseline;
};

// An environment as methods get it.
struct Lit {
    std::string name;
    bool pointSun = false;
    light::EnvironmentLight light;
    math::ShRgb harmonics{};
};

struct OcclusionMethod {
    OcclusionLabel label;
    // Once for each scene, and where `moves` is Rebuilt again whenever something in it moves.
    std::function<void(const Scene&, const Rays&)> build;
    std::function<size_t()> bytes;           // for the whole scene, after build
    std::function<void(const Lit&)> relight; // once for each frame of an environment
    std::function<void(std::span<const Receiver>, std::span<glm::vec3>)> shade;
    enum class Moves {
        Free,    // follows bones and bodies for nothing
        Rigid,   // follows whole bodies; true for a body as it was built
        Rebuilt, // true for the scene as it was built
    } moves = Moves::Free;
    // Optional: works out beforehand what does not depend on the environment, for these receivers in the
    // calls of shade() that follow; none: forgets it. For the errors alone, never while time is taken.
    std::function<void(std::span<const Receiver>)> foresee = {};
};

// Radiance leaving a white matte surface with nothing in the way.
OcclusionMethod ignored();

std::vector<OcclusionMethod> occlusionMethods();

// Each by the file that makes it.
OcclusionMethod bakedOcclusion(bool ownBodyAtRest);
OcclusionMethod transfer(int bands, bool ownBodyAtRest);
OcclusionMethod coherentShadowMaps(int directions, int size);
OcclusionMethod layeredDepth(int directions, int size);
OcclusionMethod exactRays(int directions);
// Occluders: others' ellipsoids; each body's self-occlusion at rest too; and of what bends sharply its
// own ellipsoids.
enum class Casting { Others, OthersAndFolds, All };
OcclusionMethod ellipsoids(Casting casting);
OcclusionMethod thesisLayers(int directions);
OcclusionMethod curedLayers(int directions);

} // namespace shoal::bench
