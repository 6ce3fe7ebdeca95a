// Draws models in the light of the environment. Pairs with shaders/render/Object.
//
// A frame: begin(), add() for each object, then draw() once for each eye. Nothing allocates once the vectors
// have grown.
#pragma once

#include "engine/depth/LightDifference.h"
#include "engine/gl/Program.h"
#include "engine/occlusion/gpu/LayersGpu.h"
#include "engine/render/BodyOccluders.h"
#include "engine/render/EyePicture.h"
#include "engine/render/ModelGpu.h"
#include "engine/water/Water.h"

#include <cmath>
#include <compare>
#include <vector>

namespace shoal::render {

class ObjectPass {
  public:
    // occlusion: whether bodies take light from each other.
    static Result<ObjectPass> make(Detail detail = Detail::Full, bool occlusion = true,
                                   ShownQuantity shown = ShownQuantity::Light);

    // Treats all objects drawn from now on as one body at rest in the world, whose self-occlusion is computed
    // by rays through these layers instead of ellipsoids, baked values and occlusion maps; null: no layers.
    // Needs OpenGL 4.3 and Detail::Full. The layers must live until draw().
    void setLayers(const occlusion::LayersGpu* layers) { layers_ = layers; }

    // A posed model. model and gpu must live until draw(); the rest is copied.
    struct Object {
        const scene::Model& model;
        const ModelGpu& gpu;
        const scene::Pose& pose;
        glm::mat4 worldFromModel = glm::mat4(1);
        Sphere bound;                        // world; holds the posed model; outside the view it is not drawn
        std::span<const Sphere> parts = {};  // smaller spheres that together hold it; empty: unknown
        const BodyOccluders* body = nullptr; // its occluders; null: no occlusion with other bodies
        float opacity = 1;                   // below 1, what is behind shows through it; it hides itself
        float highlight = 0;                 // strength of a rim that marks it for the player, 0 to 1
        bool isInRoom = false; // whether it stands for something in the player's room, such as a hand
        // Its light minus that at the film's camera; null: none. Not used in the player's room.
        const depth::LightHarmonics* lightDifference = nullptr;
    };

    void begin();
    void add(const Object& object); // all meshes of it

    // Draws opaque objects front to back (lean ones by program and model, because a software renderer takes
    // longer to change these than to draw pixels twice), then blended ones back to front. Nearer parts of the
    // film hide objects, except in the player's room. There an object with isInRoom draws only its depth, so
    // that it hides the objects behind it.
    Status draw(const EyePicture& picture, const water::Water& water, Glossy glossy);

    // Adds spheres that together hold all objects that the view sees, world frame.
    void addVisible(const View& view, std::vector<Sphere>& out) const;

    // The bodies of the objects since begin(), as ellipsoids. Other threads may read them during draw().
    const NearBodies& bodies() const { return near_; }
    bool isInRoom(size_t body) const { return inRoom_[body]; } // Object::isInRoom

    int drawCount() const { return drawCount_; } // since begin()
    int triangleCount() const { return triangleCount_; }
    size_t programCount() const { return programs_.count(); } // compiled so far

  private:
    enum class BehindFilm { Nothing, Perhaps, All }; // share of an object behind nearer parts of the film
    struct Seen {                                    // an object as a view sees it
        bool any = false;
        float nearest_m = INFINITY; // distance from the eye to the nearest part in the view
        // Radius divided by distance; if its sphere holds the eye, the largest such ratio of visible parts.
        float slope = 0;
        BehindFilm behind = BehindFilm::Nothing; // Nothing in the player's room, where the film is not seen
    };
    struct Shade {              // the occluders that take light from an object's body
        size_t offset = 0;      // bytes, in the buffer of matrices
        int count = 0, own = 0; // the first `own` of `count` are its own parts
        float ownStrength = 0;  // strength of its own parts, 0 to 1
        bool isKnown = false;
    };
    struct Placed { // an object since begin()
        Sphere bound;
        size_t firstPart, partCount;           // range of parts_; at least one
        depth::LightHarmonics matteDifference; // for render/LightDifference.glsl
        int body;                              // index in near_; -1: none, or without occlusion
        glm::vec3 albedo;                      // mean albedo of its own body
        float opacity, highlight;
        bool isInRoom;
        Shade shade{};
        Seen seen{}; // in the view that is drawn
    };
    struct Item {
        const ModelGpu* gpu;
        const PrimitiveGpu* primitive;
        size_t object;       // index in objects_
        size_t matrixOffset; // bytes, in the buffer of matrices
        float scale;         // world metres per unit of the mesh
        bool mirrored;       // whether its transform turns triangles clockwise (glTF 2.0, 3.7.4)
    };

    // FadedDepth: as DepthAlone, after the opaque.
    enum class Stage { DepthAlone, Opaque, FadedDepth, Blended };
    struct ToDraw {
        Stage stage;
        unsigned program; // sorts by the program's features before the order; 0: by the order alone
        float order;      // within the stage
        size_t item;
        unsigned features; // of its program
        auto operator<=>(const ToDraw&) const = default;
    };

    std::span<const Sphere> partsOf(const Placed& object) const;
    Seen seenIn(const Placed& object, const EyePicture& picture) const;
    BehindFilm behindFilm(const Placed& object, const EyePicture& picture) const;
    size_t append(const void* block, size_t bytes); // appends to the matrices; returns the offset
    Result<const gl::Program*> programFor(unsigned features);
    void sortVisible(const EyePicture& picture, unsigned shared, Glossy glossy);
    void shadeVisible(const glm::mat3& envFromWorld);
    unsigned featuresFor(const Item& item, unsigned shared, const EyePicture& picture, Glossy glossy) const;
    void use(const gl::Program& program, unsigned features, const EyePicture& picture,
             const water::Water& water) const;
    void setMaterial(const gl::Program& program, const Item& item, unsigned features) const;
    void drawItem(const gl::Program& program, const Item& item, unsigned features, const EyePicture& picture);

    gl::Variants programs_;
    Detail detail_ = Detail::Full;
    bool occlusion_ = true;
    ShownQuantity shown_ = ShownQuantity::Light;
    const occlusion::LayersGpu* layers_ = nullptr;
    gl::Texture dfg_, white_; // white_ replaces maps that a material does not have
    gl::Buffer matrixBuffer_;
    size_t matrixAlignment_ = 256;
    std::vector<Placed> objects_;
    std::vector<Sphere> parts_; // of all objects
    std::vector<Item> items_;
    std::vector<ToDraw> order_;     // scratch
    std::vector<uint8_t> matrices_; // matrices and occluders
    size_t uploaded_ = 0;           // size of matrices_ when the buffer took them
    NearBodies near_;
    std::vector<bool> inRoom_; // by body
    std::vector<glm::mat4> joints_;
    int drawCount_ = 0, triangleCount_ = 0;
};

} // namespace shoal::render
