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

// What a method answers for receivers that it has nothing to say of; they are left out of its error.
inline const glm::vec3 kUnknown{-1e9f};

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
        Bending, // follows whole bodies; and their bending by building again
        Rebuilt, // true for the scene as it was built
    } moves = Moves::Free;
    // Where set: works out beforehand what does not depend on the environment, for these receivers in the
    // calls of shade() that follow; none: forgets it. For the errors alone, never while time is taken.
    std::function<void(std::span<const Receiver>)> foresee = {};
    // Where set: before build(), once for each scene: makes what is kept of bodies however they move.
    std::function<void(const Scene&)> load = {};
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
OcclusionMethod spheres();
OcclusionMethod screenSpace(int samples);
OcclusionMethod boneDistances(int cones, int cells);
// What takes light: others' ellipsoids; each body's self-occlusion at rest too; and of what bends sharply its
// own ellipsoids.
enum class Casting { Others, OthersAndFolds, All };
OcclusionMethod ellipsoids(Casting casting);
OcclusionMethod thesisLayers(int directions);
OcclusionMethod curedLayers(int directions);
OcclusionMethod skinnedLayers(int directions); // at rest, asked through the skin
OcclusionMethod rebuiltLayers(int directions); // at the worst, just before they are seen anew

} // namespace shoal::bench
