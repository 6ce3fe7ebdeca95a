// Draws models in the light of the environment. Pairs with shaders/render/Object.
//
// A frame: begin(), add() for each object, then draw() once for each eye. Nothing allocates once the vectors
// have grown.
#pragma once

#include "engine/depth/LightBeside.h"
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
    // occlusion: bodies take light from each other.
    static Result<ObjectPass> make(Detail detail = Detail::Full, bool occlusion = true,
                                   ShownQuantity shown = ShownQuantity::Light);

    // From now on all that is drawn is one body, at rest in the world, that takes light from itself by rays
    // through these layers and not by ellipsoids, baked values or occlusion maps; null: none. Needs
    // OpenGL 4.3, Detail::Full. Must live until draw().
    void setLayers(const occlusion::LayersGpu* layers) { layers_ = layers; }

    // A posed model. model and gpu must live until draw(), all else is copied.
    struct Object {
        const scene::Model& model;
        const ModelGpu& gpu;
        const scene::Pose& pose;
        glm::mat4 worldFromModel = glm::mat4(1);
        Sphere bound;                        // world; holds the posed model: outside the view it is not drawn
        std::span<const Sphere> parts = {};  // smaller spheres that hold it all together; empty: not known
        const BodyOccluders* body = nullptr; // what it takes of others' light, and they of its; null: nothing
        float highlight = 0;                 // 0 to 1, of a rim that marks it for the player
        bool isInRoom = false; // it stands for what is in the player's room as well, such as a hand
        // Its light beyond that of the film's camera; null: none. In the player's room it is left out.
        const depth::LightHarmonics* beside = nullptr;
    };

    void begin();
    void add(const Object& object); // every mesh of it
    // Sends what was added to the graphics side. Light's frame is env.
    void upload(const glm::mat3& envFromWorld);

    // Opaque objects front to back, then blended ones back to front.
    // What of the film is nearer than an object hides it. In the player's room nothing of the film does, and
    // what is there as well only hides what is behind it: it leaves depth alone.
    Status draw(const EyePicture& picture, const water::Water& water, Glossy glossy);

    const ObjectBounds& bounds() const { return bounds_; } // of what was added since begin()

    // The bodies of what was added since begin(), as ellipsoids.
    const NearBodies& bodies() const { return near_; }
    bool isInRoom(size_t body) const { return inRoom_[body]; } // as its Object said

    int drawCount() const { return drawCount_; } // since begin()
    int triangleCount() const { return triangleCount_; }
    size_t programCount() const { return programs_.count(); } // compiled so far

  private:
    struct Item {
        const ModelGpu* gpu;
        const PrimitiveGpu* primitive;
        size_t object;       // in the order of add()
        size_t matrixOffset; // bytes into the buffer of matrices
        float scale;         // world metres for one of the mesh's units
        bool mirrored;       // by its transform: what was counter-clockwise is clockwise (glTF 2.0, 3.7.4)
        int body;            // of near_; -1: none
        glm::vec3 albedo;    // mean, of the body that self-occlusion
        float highlight;
        bool isInRoom;
    };

    enum class Stage { DepthAlone, Opaque, Blended };
    struct ToDraw {
        Stage stage;
        float order; // within it
        bool cut;    // by what of the film is nearer
        size_t item;
        auto operator<=>(const ToDraw&) const = default;
    };

    struct Shade {              // what takes light from a body
        size_t offset = 0;      // bytes into the buffer of matrices
        int count = 0, own = 0; // the first are its own parts,
        float ownStrength = 0;  // which count that much
    };

    bool shaded(const Item& item) const;
    size_t append(const void* block, size_t bytes); // to the matrices; its offset
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
    gl::Texture dfg_, white_; // white: for a map that a material has not got
    gl::Buffer matrixBuffer_;
    size_t matrixAlignment_ = 256;
    std::vector<Item> items_;
    std::vector<ToDraw> order_;     // scratch
    std::vector<uint8_t> matrices_; // and occluders
    NearBodies near_;
    std::vector<bool> inRoom_;  // by body
    std::vector<Shade> shades_; // by body
    std::vector<glm::mat4> joints_;
    ObjectBounds bounds_;
    std::vector<depth::LightHarmonics> matteBeside_; // by object, as render/LightBeside.glsl has it
    std::vector<ObjectBounds::Seen> seen_;           // scratch: of the objects, in the view that is drawn
    int drawCount_ = 0, triangleCount_ = 0;
};

} // namespace shoal::render
