// Shadows of bodies on what a film shows, by direction from the film's camera.
//
// The place of each texel of a film's distances is known, and the light that a body hides from a place is a
// closed form (CastShadow.h). So shadows are computed at these places, once for both eyes; the passes that
// draw the film multiply its texels by the remaining share before they draw objects over them.
//
// Differential rendering (Debevec 1998, "Rendering Synthetic Objects into Real Scenes"): the factor is what
// the surface reflects in shadow divided by what it reflects without, so that a wrong estimate of the
// surface or the light makes only a small error.
#pragma once

#include "engine/core/Image.h"
#include "engine/render/CastShadow.h"
#include "engine/render/FrameTiles.h"
#include "engine/render/View.h"
#include "engine/water/Water.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace shoal::render {

// Returns the surface's share of the light in a film's texel; the rest is the water's own, which shadows do
// not dim. The surface is taken to be grey, as bright as the water's brightest colour.
glm::vec3 surfaceShare(const water::Water& water, float distance_m);

// Returns the factor for a texel's display values where shadows take `taken` (0 to 1) of its surface's
// irradiance. Display values are square roots of light (water/Water.h), except in frames coded as in the
// thesis, whose radiance is proportional to them (light/InverseToneMap.h). share: surfaceShare().
glm::vec3 remainingOf(const glm::vec3& taken, FrameCoding frames, const glm::vec3& share);

class FilmShadows {
  public:
    // Begins a frame without bodies. The film must live until the last add(). Allocates for new sizes only.
    void begin(const FilmSurface& film, FrameCoding frames, const water::Water& water);
    // Adds the shadow of a body, world frame, where an eye may see it. Surfaces that an eye beside the film's
    // camera sees and the camera does not are never shaded.
    void add(std::span<const occlusion::Ellipsoid> body, const CastingLight& light,
             std::span<const View> eyes);

    bool empty() const { return empty_; } // whether nothing is shaded since begin()
    // The tiles in which something may be shaded.
    const FrameTiles& tiles() const { return tiles_; }
    // Returns the factors for the film's texels, 255 for 1: lat-long, as fine as the distances, blue first.
    const Image<uint8_t, 4>& remaining() const { return remaining_; }
    // Identifies the shadows of one begin(); the owner of a copy compares it to see whether the copy is new.
    using Version = std::pair<const FilmShadows*, uint64_t>; // the number counts begin(), from 1
    Version version() const { return {this, number_}; }

    // A body's piece in the light's frame: metres along, aside and up to the light, from the film's camera.
    struct Occluder {
        float along, aside, up, halfAlong, halfAside;
        float lowest, perFade; // from `lowest` up the shadow grows by perFade per metre to `share`
        float share;           // factor, 0 to 1, which fades where the shadow has fallen far
        glm::vec3 spotWorld;   // middle of its shadow on the film's surface; the radius includes the penumbra
        float spotRadius_m;
    };

  private:
    // Returns an upper bound of the share of the light's disc that the body hides anywhere.
    float findOccluders(const CastingLight& light);
    void findTiles(std::span<const View> eyes);
    // Returns a box in the light's frame around all places of a tile, whose texels are low to high - 1.
    scene::Bounds extentOf(const glm::ivec2& tile, const glm::ivec2& low, const glm::ivec2& high) const;
    static bool reaches(const Occluder& piece, const scene::Bounds& extent, float discTangent);
    void shadeTile(const CastingLight& light, float strength, const glm::ivec2& tile);
    void findPlaces(const glm::ivec2& low, const glm::ivec2& high, int step);
    // Both return vectors from the film's camera, env frame; a place of unknown distance is far away.
    glm::vec3 directionAt(int x, int y) const;
    glm::vec3 placeAt(int x, int y) const;
    // Returns the cosine between the surface's normal at a texel of the map and towardsEnv.
    float cosineAt(int x, int y, const glm::vec3& towardsEnv) const;

    FilmSurface film_;
    FrameCoding frames_ = FrameCoding::Srgb;
    bool empty_ = true;
    uint64_t number_ = 0;
    FrameTiles tiles_;
    Image<uint8_t, 4> remaining_;
    std::vector<glm::vec3> columns_, rows_; // directions: of each column at the horizon, of each row ahead
    std::array<float, 256> distance_m_{};   // indexed by the map's code
    std::array<glm::vec3, 256> surface_{};  // by code: surfaceShare()
    glm::mat3 lightFromEnv_{1};             // for the body being added: along, aside, up
    std::vector<FlatPiece> pieces_;         // scratch: of one body
    std::vector<Occluder> occluders_;
    std::vector<size_t> reached_; // tiles that the shadow of the body being added may reach
    std::array<bool, FrameTiles::kAll> isReached_{}; // scratch: whether a tile is in reached_
    std::vector<float> along_, aside_, up_, hidden_; // of a tile's texels, in the light's frame
};

} // namespace shoal::render
