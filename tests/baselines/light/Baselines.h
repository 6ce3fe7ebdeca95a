// Every method of image-based lighting there is, with one interface for the chart of speed against accuracy:
// plain values which hold functions. Used by tests and the bench; the game knows only engine/light itself.
// Numbers are checked by assertions, not by results.
#pragma once

#include "engine/light/EnvironmentLight.h"
#include "engine/light/FrameView.h"

#include <glm/glm.hpp>

#include <functional>
#include <span>
#include <string>
#include <vector>

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
    Update update;
    // Unit normals, env frame; out is as long.
    std::function<void(std::span<const glm::vec3> normals, std::span<glm::vec3> out)> shade;
    bool readsPyramid = true; // which somebody has to make for it; else it makes its own
};

// Radiance filtered by a GGX lobe (EnvironmentLight.h, GlossyLevel).
struct GlossyMethod {
    Label label;
    Update update;
    // Unit mirror directions, env frame; one roughness for all of them; out is as long.
    std::function<void(std::span<const glm::vec3> dirs, float roughness, std::span<glm::vec3> out)> shade;
    bool readsPyramid = true;
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

// --- Diffuse ---------------------------------------------------------------------------------------------

// The game's method: LightMaker and lookUp().
DiffuseMethod shoalDiffuse(bool videoOnly);

// Thesis eq. 2.2: every texel of a width x width / 2 map gathers every texel of the pyramid's level of that
// width. The thesis uses 64.
DiffuseMethod bruteForce(int width);

// Real spherical harmonics of 1 to kMaxBands bands. Ramamoorthi and Hanrahan 2001, "An Efficient
// Representation for Irradiance Environment Maps", is 3 bands. windowed: each band weighed by a Hanning
// window that ends at twice the bands, against ringing; Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks".
DiffuseMethod harmonicDiffuse(int bands, bool windowed);

// Two bands and of the third only what is symmetric around their axis. Roughton, Sloan, Silvennoinen,
// Iwanicki and Shirley 2024, "ZH3: Quadratic Zonal Harmonics".
DiffuseMethod zonalHarmonicsDiffuse();

// Spherical Gaussians of one width on a Fibonacci lattice, their strengths by least squares. Spherical radial
// basis functions light 360-degree video in Michiels et al. 2014, "Interactive Augmented Omnidirectional
// Video with Realistic Lighting".
DiffuseMethod sphericalGaussians(int lobes);

// --- Glossy ----------------------------------------------------------------------------------------------

// The game's method: LightMaker and lookUpGlossy().
GlossyMethod shoalGlossy(bool videoOnly);

// The thesis' 36 samples for each pixel: engine/light/Lookup.h.
GlossyMethod thesisRings();

// So many samples of the GGX lobe for each pixel, each read from the level whose texels are as large as its
// share. Krivanek and Colbert 2008, "Real-time Shading with Filtered Importance Sampling".
GlossyMethod filteredImportanceSampling(int samples);

// Maps of fixed roughness filled for each frame by the same samples, then one lookup for each pixel. Karis
// 2013, "Real Shading in Unreal Engine 4", with filtered samples. Six maps, 256 texels around for the mirror,
// half as many for each step of 0.2 in roughness but never fewer than `narrowest`.
GlossyMethod importancePrefilter(int samples, int narrowest);

// The same maps filled by few samples whose places and weights were fitted to the lobe beforehand. After
// Manson and Sloan 2016, "Fast Filtering of Reflection Probes"; the fit is our own, see FittedTaps.h.
GlossyMethod fittedPrefilter(int narrowest);

// Harmonics of the radiance times those of the lobe. Fit for wide lobes only.
GlossyMethod harmonicGlossy(int bands);

// --- From frame to pyramid -------------------------------------------------------------------------------

enum class PyramidSource {
    Whole,
    HalfDropped, // every second texel of every second row
    HalfMean,    // means of 2 x 2 coded bytes, as a decoder that scales would give
};

// weighted: levels are means weighed by solid angle (PyramidMaker); else plain means, as the thesis has them.
PyramidMethod pyramidFrom(PyramidSource source, bool weighted);

// --- From display to light -------------------------------------------------------------------------------

// Thesis eq. 4.1 to 4.3. linearised: of sRGB-decoded values instead of coded ones.
InverseToneMapMethod thesisInverse(bool linearised);

// Decoded sRGB and nothing more.
InverseToneMapMethod plainLinear();

// Shoal's: clipped light by what the ground sends back (engine/light/ClippedLight.h).
InverseToneMapMethod clippedLight();

// Luminance by thesis eq. 2.3, ((L - least) / (most - least))^gamma, of decoded values. Akyuz, Fleming,
// Riecke, Reinhard and Buelthoff 2007, "Do HDR Displays Support LDR Content?", found gamma 1 to serve.
InverseToneMapMethod akyuz(float gamma);

// Decoded values stay below 0.5 of luminance; above they are blended towards ten times themselves with the
// square of how far above. Landis 2002, "Production-Ready Global Illumination".
InverseToneMapMethod landis();

// Luminance to a power by the picture's key k, the place of its logarithmic mean between least and most.
// Masia, Agustin, Fleming, Sorkine and Gutierrez 2009, "Evaluation of Reverse Tone Mapping Through Varying
// Exposure Conditions".
InverseToneMapMethod masia2009();
// Exponent by key, logarithmic mean and share of clipped pixels. Masia, Serrano and Gutierrez 2017, "Dynamic
// Range Expansion Based on Image Statistics".
InverseToneMapMethod masia2017();

// Decoded values times 1 to 4 by how near clipped pixels are. Their blur is made on 128 x 64 texels; the
// first one's stop at strong edges is left out.
// Rempel et al. 2007, "Ldr2Hdr: On-the-Fly Reverse Tone Mapping of Legacy Video and Photographs".
InverseToneMapMethod rempel();
// The blur weighed by likeness of luminance. Kovaleski and Oliveira 2014, "High-Quality Reverse Tone Mapping
// for a Wide Range of Exposures".
InverseToneMapMethod kovaleski();
// The inverse of Reinhard's operator, white to 10, weighed by the density of lights: Banterle.cpp.
InverseToneMapMethod banterle();

// --- All of them, in the order of the chart --------------------------------------------------------------

std::vector<DiffuseMethod> diffuseMethods();
std::vector<GlossyMethod> glossyMethods();
std::vector<PyramidMethod> pyramidMethods();
std::vector<InverseToneMapMethod> inverseToneMapMethods();

} // namespace shoal::light::baselines
