// A model's triangles and textures on the GPU.
#pragma once

#include "engine/gl/Objects.h"
#include "engine/scene/Model.h"
#include "engine/scene/Surface.h"

#include <memory>
#include <span>
#include <vector>

namespace shoal::render {

// One level of detail: the same surface, drawn with fewer triangles.
struct DetailGpu {
    gl::VertexArray vertexArray;
    gl::Buffer vertices, indices,
        morphable; // morphable: position and normal, rewritten as the weights change
    GLsizei indexCount = 0;
    float error = 0; // greatest distance of the surface from the finest one, in the mesh's units
};

struct PrimitiveGpu {
    std::vector<DetailGpu> details; // finest first; at least one
    int material = -1;
    bool skinned = false;
    bool coloured = false;          // by vertex colours
    bool withSelfOcclusion = false; // whether its vertices have baked self-occlusion
    scene::Gloss gloss;             // of its material

    // Returns the coarsest level whose error is at most `tolerance`, in the mesh's units.
    const DetailGpu& detail(float tolerance) const;
};

using MeshGpu = std::vector<PrimitiveGpu>;

// The space in which surfaces scale light. The thesis' inverse tone mapping scales a video's coded values
// directly, so its "radiance" is still gamma-coded, and since coding is nearly a power, code(a L) = code(a)
// code(L): a surface of reflectance a must scale it by a's coded value. Light that was measured linear is
// scaled by a itself.
enum class Reflectance { Linear, Coded };

// Returns a material's space: ofLit for a lit one, Linear for an unlit one, which scales no light.
inline Reflectance reflectanceFor(const scene::Material& material, Reflectance ofLit) {
    return material.unlit ? Reflectance::Linear : ofLit;
}

// Textures by index into Model::textures; empty where a texture is not used in that way.
struct TexturesGpu {
    std::vector<gl::Texture> colour; // sRGB, decoded by the sampler
    std::vector<gl::Texture> data;   // values as stored
};

struct ModelGpu {
    std::vector<MeshGpu> meshes;
    std::shared_ptr<const TexturesGpu> textures;
    Reflectance reflectance = Reflectance::Linear; // the space of base colours, in maps too
    std::vector<scene::Material> materials;        // the last is glTF's default material

    const scene::Material& materialOf(const PrimitiveGpu& primitive) const {
        return primitive.material < 0 ? materials.back() : materials[static_cast<size_t>(primitive.material)];
    }
};

// Lean leaves out what costs a software renderer most and is hardly seen in a moving picture: textures are
// sampled from the nearest mip level (linearly within it), large textures have half the texels each way,
// roughness and metalness are a material's means, the nearest glossy map replaces a mixture of two, diffuse
// light is computed per vertex, surfaces may be 1.6 pixels off, and an object that does not fill the picture
// has no relief and all its light computed per vertex.
enum class Detail { Full, Lean };

// textures: shared with another model that has the same pictures and materials; null: new ones are made.
// bent: positions of a one-primitive model in the pose in which detail is measured; empty: at rest.
ModelGpu uploadModel(const scene::Model& model, Reflectance reflectance, Detail detail = Detail::Full,
                     std::shared_ptr<const TexturesGpu> textures = nullptr,
                     std::span<const glm::vec3> bent = {});

// Rewrites the positions and normals of a mesh with morph targets for these weights.
void uploadMorphed(const scene::Mesh& mesh, std::span<const float> weights, MeshGpu& gpu);

} // namespace shoal::render
