// Where bodies shade what a film shows: what they leave of it, by direction from the film's camera.
//
// Of each texel of a film's distances the place is known, and what a body hides of the light from a place is
// a closed form (CastShadow.h). So shadows are not drawn but worked out at the places themselves, once for
// both eyes; whoever draws the film multiplies its texels with what is left before objects come over them.
//
// Differential rendering (Debevec 1998, "Rendering Synthetic Objects into Real Scenes"): the film is
// multiplied by what the surface would send back shaded over what it sends back unshaded, never more than 1,
// so that a wrong guess at the surface or the light is a faint mistake.
#pragma once

#include "engine/core/Image.h"
#include "engine/render/CastShadow.h"
#include "engine/render/FrameTiles.h"
#include "engine/render/View.h"
#include "engine/water/Water.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace shoal::render {

// What of the display values of a surface is left where a shadow takes that share of its irradiance, 0 to 1.
// Display values are taken for square roots of light (water/Water.h), but where frames are coded as the
// thesis has them, whose radiance goes by display values where it is not bright (light/InverseToneMap.h). The
// water between mixes squares, of which `arrives` comes through it; its own light, which is not dimmed, is
// taken to be as bright as the surface.
glm::vec3 leftOf(const glm::vec3& taken, FrameCoding frames, const glm::vec3& arrives);

class FilmShadows {
  public:
    // Once a frame: forgets the bodies of the last. The film must live until the last add(). Allocates
    // nothing once there has been a map of that size.
    void begin(const FilmSurface& film, FrameCoding frames, const water::Water& water);
    // body: world frame. What none of the eyes sees is left out; those beside the film's camera see a little
    // more than it does from there.
    void add(std::span<const occlusion::Ellipsoid> body, const CastingLight& light,
             std::span<const View> eyes);

    bool empty() const { return empty_; } // since begin()
    // Those in which something may be shaded.
    const FrameTiles& tiles() const { return tiles_; }
    // Lat-long, as fine as the distances; 255: all is left. Channels as DisplayFrame has them, blue first.
    const Image<uint8_t, 4>& left() const { return left_; }
    // Which shadows, since which begin(): tells whoever has a copy whether it is up to date.
    struct Version {
        const FilmShadows* of = nullptr;
        uint64_t number = 0; // of begin(), from 1 on
        bool operator==(const Version&) const = default;
    };
    Version version() const { return {this, number_}; }

    // A body's piece in the light's frame: metres along, aside and up towards the light, from the film's
    // camera.
    struct Occluder {
        float along, aside, up, halfAlong, halfAside;
        float lowest, perFade; // what lies lower than this is beyond the surface that the shadow falls on
        float share;
    };

  private:
    void findOccluders(const CastingLight& light);
    void reachTiles(const CastingLight& light, std::span<const View> eyes);
    // A box in the light's frame.
    struct Extent {
        glm::vec3 low, high;
    };
    // Holds all places of a tile.
    Extent extentOf(const glm::ivec2& low, const glm::ivec2& high) const;
    static bool reaches(const Occluder& piece, const Extent& extent, float discTangent);
    bool hideInTile(const CastingLight& light); // whether anything is
    void shadeTile(const CastingLight& light, float strength, const glm::ivec2& tile);
    void chooseAround(const glm::ivec2& tile);
    void findPlaces(const glm::ivec2& low, const glm::ivec2& high);
    // From the film's camera, env frame; a place where nothing is known is far away.
    glm::vec3 directionAt(int x, int y) const;
    glm::vec3 placeAt(int x, int y) const;
    // Of the angle between the surface's normal at a texel of the map and a direction, env frame.
    float cosineAt(int x, int y, const glm::vec3& towardsEnv) const;

    FilmSurface film_;
    FrameCoding frames_ = FrameCoding::Srgb;
    bool empty_ = true;
    uint64_t number_ = 0;
    FrameTiles tiles_;
    Image<uint8_t, 4> left_;
    std::vector<glm::vec2> columns_, rows_; // of the map: sine and cosine of longitude, of latitude
    std::array<float, 256> distance_m_{};   // by a map's code
    std::array<glm::vec3, 256> arrives_{};  // of light squared, through the water
    glm::mat3 lightFromEnv_{1};             // of the body that is added: along, aside, up
    std::vector<FlatPiece> pieces_;         // scratch: of one body
    std::vector<Spot> spots_;
    std::vector<Occluder> occluders_;
    std::vector<glm::ivec2> reached_; // tiles, by one body
    std::vector<uint32_t> reachedBy_; // of each tile the last body, as they are counted
    uint32_t bodies_ = 0;
    std::vector<float> along_, aside_, up_, hidden_; // of a tile's texels, in the light's frame
};

} // namespace shoal::render
