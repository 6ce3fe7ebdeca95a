// One interface for every method of image-based lighting that the chart of speed against accuracy measures:
// plain values which hold functions. Used by tests and the bench; the game knows only engine/light itself.
#pragma once

#include "engine/light/EnvironmentLight.h"
#include "engine/light/FrameView.h"

#include <glm/vec3.hpp>

#include <functional>
#include <span>
#include <string>

namespace shoal::light::baselines {

enum class Role {
    Baseline,
    Thesis,  // what the thesis chose
    Default, // what the game uses
};

struct Label {
    std::string name;   // unique within its list
    std::string brief;  // a few letters, for a picture
    std::string family; // methods of one family share a colour and a shape
    std::string source; // who, when, what
    Role role = Role::Baseline;
};

// One frame of an environment. Just one of coded and radianceLin is there; the pyramid always is.
struct Input {
    const RadiancePyramid* pyramid = nullptr; // solid-angle weighted, 512 or 1024 texels around level 0
    FrameView coded;                          // pixels is null where the environment is an HDR picture
    const ImageRgbF* radianceLin = nullptr;   // null where the environment is a coded frame
};

// Called for each frame. Keeps its buffers.
using Update = std::function<void(const Input&)>;

// Radiance leaving a white matte surface by its normal: irradiance / pi.
struct DiffuseMethod {
    Label label;
    bool readsPyramid = true; // which somebody has to make for it; else it makes its own
    Update update;
    // Unit normals, env frame; out is as long.
    std::function<void(std::span<const glm::vec3> normals, std::span<glm::vec3> out)> shade;
};

// Radiance filtered by a GGX lobe (EnvironmentLight.h, GlossyLevel).
struct GlossyMethod {
    Label label;
    bool readsPyramid = true;
    Update update;
    // Unit mirror directions, env frame; one roughness for all of them; out is as long.
    std::function<void(std::span<const glm::vec3> dirs, float roughness, std::span<glm::vec3> out)> shade;
};

// Way from a coded frame to the radiance pyramid.
struct PyramidMethod {
    Label label;
    std::function<void(const FrameView& frame, RadiancePyramid& out)> make;
};

// Operator from a coded frame to linear radiance, of any scale.
struct InverseToneMapMethod {
    Label label;
    std::function<void(const ImageRgb8& frame, ImageRgbF& radianceLin)> expand;
};

} // namespace shoal::light::baselines
