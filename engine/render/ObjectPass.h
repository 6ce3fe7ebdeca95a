// Draws models in the light of the surround. Pairs with shaders/render/Object.
//
// A frame: begin(), add() for each object, then draw() once for each eye. Nothing allocates once the vectors
// have grown.
#pragma once

#include "engine/gl/Variants.h"
#include "engine/render/LayerPass.h"
#include "engine/render/ModelGpu.h"
#include "engine/render/NearBodies.h"
#include "engine/render/SurroundGpu.h"
#include "engine/render/View.h"
#include "engine/water/Water.h"

#include <array>
#include <vector>

namespace shoal::render {

enum class Glossy { Prefiltered, PhongRings }; // PhongRings: the thesis' 36 samples, for reference

class ObjectPass {
  public:
    // occlusion: bodies take light from each other.
    static Result<ObjectPass> make(Detail detail = Detail::Full, bool occlusion = true);

    void begin();
    // Every mesh of the posed model. model and gpu must live until draw(); pose is copied.
    // bound: a ball in the world that holds the posed model; what lies outside the view is not drawn. body:
    // what it takes from others' light, and they from its own; null: nothing. parts: smaller balls that hold
    // it as well, all together, for seen() and ballsSeen(); empty: none are known.
    void add(const scene::Model& model, const ModelGpu& gpu, const scene::Pose& pose,
             const glm::mat4& worldFromModel, const Ball& bound, const BodyOccluders* body = nullptr,
             std::span<const Ball> parts = {});
    // Sends what was added to the graphics side. Light's frame is env.
    void upload(const glm::mat3& envFromWorld);

    enum class Part { Opaque, Blended };
    // Opaque objects front to back, before the backdrop; blended ones back to front, after it.
    Status draw(Part part, const SurroundGpu& surround, const View& view, const glm::mat3& envFromWorld,
                const Exposure& exposure, const water::Water& water, Glossy glossy);

    // Where in the picture the objects are that the view sees; may be more, never less. Good until the next
    // call.
    std::span<const Box> seen(const View& view);
    // The same objects in the world.
    std::span<const Ball> ballsSeen(const View& view);

    int drawCount() const { return drawCount_; } // since begin()
    int triangleCount() const { return triangleCount_; }

  private:
    struct Item {
        const ModelGpu* gpu;
        const PrimitiveGpu* primitive;
        size_t matrixOffset; // bytes into the buffer of matrices
        size_t matrixBytes;
        Ball bound;       // world
        float scale;      // world metres for one of the mesh's units
        int body;         // of near_; -1: none
        glm::vec3 albedo; // mean, of the body that folds
    };

    struct Object {
        Ball bound;
        size_t firstPart, parts; // of parts_
    };

    struct Shade {              // what takes light from a body
        size_t offset = 0;      // bytes into the buffer of matrices
        int count = 0, own = 0; // the first are its own parts,
        float ownStrength = 0;  // which count that much
    };

    bool shaded(const Item& item) const;
    size_t append(const void* block, size_t bytes); // to the matrices; its offset
    Result<const gl::Program*> programFor(unsigned features);
    void drawItem(const gl::Program& program, const Item& item, const View& view);

    gl::Variants programs_;
    Detail detail_ = Detail::Full;
    bool occlusion_ = true;
    gl::Texture dfg_;
    gl::Buffer matrixBuffer_;
    size_t matrixAlignment_ = 256;
    std::vector<Item> items_;
    std::vector<std::pair<float, size_t>> order_;
    std::vector<uint8_t> matrices_; // and occluders
    NearBodies near_;
    std::vector<Shade> shades_; // by body
    std::vector<glm::mat4> joints_;
    std::vector<Object> objects_;
    std::vector<Ball> parts_;
    std::vector<Box> boxes_; // scratch
    std::vector<Ball> balls_;
    int drawCount_ = 0, triangleCount_ = 0;
};

} // namespace shoal::render
