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
#include "engine/render/ObjectBounds.h"
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
        float highlight = 0;                 // strength of a rim that marks it for the player, 0 to 1
        bool isInRoom = false; // whether it stands for something in the player's room, such as a hand
        // Its light minus that at the film's camera; null: none. Not used in the player's room.
        const depth::LightHarmonics* lightDifference = nullptr;
    };

    void begin();
    void add(const Object& object); // all meshes of it
    // Uploads the objects added since begin(). The light's frame is env.
    void upload(const glm::mat3& envFromWorld);

    // Draws opaque objects front to back, then blended ones back to front. Nearer parts of the film hide
    // objects, except in the player's room. There an object with isInRoom draws only its depth, so that it
    // hides the objects behind it.
    Status draw(const EyePicture& picture, const water::Water& water, Glossy glossy);

    const ObjectBounds& bounds() const { return bounds_; } // bounds of the objects since begin()

    // The bodies of the objects since begin(), as ellipsoids.
    const NearBodies& bodies() const { return near_; }
    bool isInRoom(size_t body) const { return inRoom_[body]; } // Object::isInRoom

    int drawCount() const { return drawCount_; } // since begin()
    int triangleCount() const { return triangleCount_; }
    size_t programCount() const { return programs_.count(); } // compiled so far

  private:
    struct Item {
        const ModelGpu* gpu;
        const PrimitiveGpu* primitive;
        size_t object;       // index, in the order of add()
        size_t matrixOffset; // bytes, in the buffer of matrices
        float scale;         // world metres per unit of the mesh
        bool mirrored;       // whether its transform turns triangles clockwise (glTF 2.0, 3.7.4)
        int body;            // index in near_; -1: none
        glm::vec3 albedo;    // mean albedo of the object's own body
        float highlight;
        bool isInRoom;
    };

    enum class Stage { DepthAlone, Opaque, Blended };
    struct ToDraw {
        Stage stage;
        float order; // within the stage
        bool cut;    // whether nearer parts of the film may hide a part of it
        size_t item;
        auto operator<=>(const ToDraw&) const = default;
    };

    struct Shade {              // the occluders that take light from a body
        size_t offset = 0;      // bytes, in the buffer of matrices
        int count = 0, own = 0; // the first `own` of `count` are its own parts
        float ownStrength = 0;  // strength of its own parts, 0 to 1
    };

    bool shaded(const Item& item) const;
    size_t append(const void* block, size_t bytes); // appends to the matrices; returns the offset
    Result<const gl::Program*> programFor(unsigned features);
    void sortVisible(const EyePicture& picture);
    unsigned featuresFor(const ToDraw& next, unsigned shared, const EyePicture& picture, Glossy glossy) const;
    void use(const gl::Program& program, unsigned features, const EyePicture& picture,
             const water::Water& water) const;
    void drawItem(const gl::Program& program, const Item& item, unsigned features, const EyePicture& picture);

    gl::Variants programs_;
    Detail detail_ = Detail::Full;
    bool occlusion_ = true;
    ShownQuantity shown_ = ShownQuantity::Light;
    const occlusion::LayersGpu* layers_ = nullptr;
    gl::Texture dfg_, white_; // white_ replaces maps that a material does not have
    gl::Buffer matrixBuffer_;
    size_t matrixAlignment_ = 256;
    std::vector<Item> items_;
    std::vector<ToDraw> order_;     // scratch
    std::vector<uint8_t> matrices_; // matrices and occluders
    NearBodies near_;
    std::vector<bool> inRoom_;  // by body
    std::vector<Shade> shades_; // by body
    std::vector<glm::mat4> joints_;
    ObjectBounds bounds_;
    std::vector<depth::LightHarmonics> matteDifferences_; // by object, for render/LightDifference.glsl
    std::vector<ObjectBounds::Seen> seen_;                // scratch: by object, in the view that is drawn
    int drawCount_ = 0, triangleCount_ = 0;
};

} // namespace shoal::render
