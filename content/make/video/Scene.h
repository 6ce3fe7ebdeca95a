// Description of a scene (Reef.toml, Night.toml, Kelp.toml): the data from which its meshes are built.
// Metres, +Y up, the water's surface at y = 0; radiance in one arbitrary unit throughout.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Result.h"

#include <glm/glm.hpp>

#include <optional>
#include <string>
#include <vector>

namespace shoal::reef {

using glm::vec2;
using glm::vec3;
using glm::vec4;

struct Water {
    vec3 attenuation{0}; // per metre
    vec3 scattered{0};   // share of the attenuation that is scattering
    float forward = 0, forwardShare = 0;

    vec3 transmittance(float metres) const { return glm::exp(-attenuation * metres); }
    // Share of scattered light that turns by an angle of this cosine, per steradian: integrates to 1.
    float phase(float cosine) const;
};

struct Sun {
    vec3 toSunAir{0}, toSunWater{0}; // unit; the second refracted at the level surface
    vec3 irradiance{0};              // on a plane facing it, just below the surface
    vec3 sky{0};                     // radiance overhead in air
    vec3 horizon{0};                 // radiance at the horizon in air
};

// A spotlight under water: set somewhere, or carried by the camera.
struct Lamp {
    vec3 place{0};                    // metres; relative to the camera if it is carried
    vec3 towards{0};                  // unit
    float cosInner = 1, cosOuter = 1; // full light within the first, none outside the second
    vec3 intensity{0};                // irradiance at one metre
    bool carried = false;
};

// Plankton: specks that flash at different times.
struct Plankton {
    int count = 0;
    vec3 radiance{0}; // of a speck of one millimetre
};

struct Waves {
    float tile = 0, rmsSlope = 0, longest = 0, shortest = 0, wind = 0; // metres, radians
};

struct Film {
    int frames = 0, fps = 0, width = 0;
    int drawn = 0; // width of the traced frames, which are enlarged for the encoder
    int start = 0; // frame of the closed path at which the film starts
    int every = 1; // frames from one that is traced to the next
};

struct CameraData {
    float exposure = 1, adaptation = 0, noise = 0;
    std::optional<float> mean; // meter reading that gets `exposure` itself; empty: the film's mean reading
    vec3 white{1};
    int snow = 0;
};

struct Blob {
    vec3 centre{0}, radius{0};
};

struct Rock {
    float voxel = 0;
    std::vector<Blob> blobs;
    std::vector<std::vector<vec4>> carve; // tubes: centre and radius of their joints
};

struct Growth {
    std::string kind;
    int count = 0;
    vec2 size{0}, light{0, 1};
    float up = 0;
    float clear = 0; // metres that its root keeps from the camera's path; 0: by its size
    vec3 glow{0};    // radiance that some colonies emit where their albedo is 1/3
    bool onSand = false;
};

struct Scene {
    Film film;
    std::vector<vec3> path;
    Water water;
    Sun sun;
    Waves waves;
    CameraData camera;
    float sandHeight = 0;
    vec3 sandAlbedo{0};
    std::vector<Rock> rocks;
    std::vector<Growth> growths;
    std::vector<Lamp> lamps;
    Plankton plankton;
    uint64_t key = 0; // hash of everything that the stored light depends on
};

// Refractive index of sea water.
constexpr float kWaterIndex = 1.34f;

// A file may name another as its `base` and state only what differs: tables are joined, all else replaced.
Result<Scene> readScene(const Path& file);

} // namespace shoal::reef
