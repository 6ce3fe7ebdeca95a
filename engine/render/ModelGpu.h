// A model's triangles and textures on the graphics side.
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
    float error = 0; // how far the surface lies off at most, in the mesh's units
};

struct PrimitiveGpu {
    std::vector<DetailGpu> details; // finest first; at least one
    int material = -1;
    bool skinned = false;
    bool coloured = false;          // by the vertex
    bool withSelfOcclusion = false; // hides something of the world from itself
    scene::Gloss gloss;             // of its material

    // The coarsest that is off by no more than this, in the mesh's units.
    const DetailGpu& detail(float tolerance) const;
};

struct MeshGpu {
    std::vector<PrimitiveGpu> primitives;
};

// In which space surfaces scale light. The thesis' inverse tone mapping scales a video's coded values as they
// come, so its "radiance" is still gamma-coded, and since coding is nearly a power, code(a L) = code(a)
// code(L): a surface of reflectance a must scale it by a's coded value. Light that was measured linear is
// scaled by a itself.
enum class Reflectance { Linear, Coded };

// Of one material in such a model: an unlit one scales no light.
inline Reflectance reflectanceFor(const scene::Material& material, Reflectance ofLit) {
    return material.unlit ? Reflectance::Linear : ofLit;
}

// Per Model::textures; empty where a texture is not used in that way.
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

// Lean: what a software renderer gains most by and hardly anybody sees in a moving picture. Textures come
// from the nearest mip level (linear within it), large normal maps have half the texels, roughness and
// metalness are a material's means, the nearest of the glossy maps stands for a mixture of two, diffuse light
// comes by the vertex, shapes may be 1.6 pixels off, and what does not fill the picture has no relief and
// all its light by the vertex.
enum class Detail { Full, Lean };

// textures: of another model with the same pictures and materials, to be shared; else they are made.
ModelGpu uploadModel(const scene::Model& model, Reflectance reflectance, Detail detail = Detail::Full,
                     std::shared_ptr<const TexturesGpu> textures = nullptr);

// Rewrites the positions and normals of a mesh with morph targets for these weights.
void uploadMorphed(const scene::Mesh& mesh, std::span<const float> weights, MeshGpu& gpu);

} // namespace shoal::render
