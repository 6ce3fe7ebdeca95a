#include "engine/render/ModelGpu.h"

#include "engine/scene/Surface.h"
#include "engine/scene/Vertices.h"
#include "shaders/render/Attributes.glsl"

#include <glm/geometric.hpp>

#include <cstddef>
#include <numeric>

namespace shoal::render {

namespace {

constexpr int kFine = 512; // width in texels from which on textures are halved for Detail::Lean

struct FixedVertex { // attributes that morphing leaves unchanged
    glm::vec4 tangent{1, 0, 0, 1};
    glm::vec2 uv0{0}, uv1{0};
    glm::vec4 colour{1}; // linear or coded, as the reflectance is
    glm::u16vec4 joints{0};
    glm::vec4 weights{1, 0, 0, 0};
    glm::vec4 selfOcclusion{0}, selfOcclusionBesideOwn{0};
};

struct MorphVertex {
    glm::vec3 position, normal;
};

std::vector<MorphVertex> morphed(const scene::Primitive& primitive, std::span<const float> weights) {
    std::vector<MorphVertex> vertices(primitive.positions.size());
    for (size_t v = 0; v < vertices.size(); ++v) {
        const auto [position, normal] = scene::morphed(primitive, v, weights);
        const float length = glm::length(normal);
        vertices[v] = {position, length > 0 ? normal / length : glm::vec3(0, 1, 0)};
    }
    return vertices;
}

// Codes by the power 1 / 2.2, which is close enough to sRGB's curve for reflectances.
glm::vec4 coded(const glm::vec4& lin) {
    return {glm::pow(glm::max(glm::vec3(lin), 0.0f), glm::vec3(1 / 2.2f)), lin.a};
}

template <class T> gl::Buffer bufferOf(GLenum target, std::span<const T> values, GLenum usage) {
    gl::Buffer buffer = gl::Buffer::make();
    glBindBuffer(target, buffer.name());
    glBufferData(target, static_cast<GLsizeiptr>(values.size_bytes()), values.data(), usage);
    return buffer;
}

// vertices: indices of the primitive's vertices to upload, in this order.
DetailGpu uploadDetail(const scene::Primitive& primitive, Reflectance reflectance,
                       std::span<const uint32_t> vertices, std::span<const uint32_t> indices) {
    DetailGpu gpu;
    gpu.indexCount = static_cast<GLsizei>(indices.size());
    gpu.vertexArray = gl::VertexArray::make();
    glBindVertexArray(gpu.vertexArray.name());

    const std::vector<MorphVertex> all = morphed(primitive, {});
    std::vector<MorphVertex> moving;
    for (const uint32_t v : vertices) moving.push_back(all[v]);
    gpu.morphable = bufferOf<MorphVertex>(GL_ARRAY_BUFFER, moving,
                                          primitive.morphTargets.empty() ? GL_STATIC_DRAW : GL_DYNAMIC_DRAW);
    gl::setAttribute(ATTRIBUTE_POSITION, 3, sizeof(MorphVertex), offsetof(MorphVertex, position));
    gl::setAttribute(ATTRIBUTE_NORMAL, 3, sizeof(MorphVertex), offsetof(MorphVertex, normal));

    std::vector<FixedVertex> fixed(vertices.size());
    for (size_t i = 0; i < fixed.size(); ++i) {
        const auto take = [v = vertices[i]](const auto& values, auto& into) {
            if (!values.empty()) into = values[v];
        };
        take(primitive.tangents, fixed[i].tangent);
        take(primitive.texCoords[0], fixed[i].uv0);
        take(primitive.texCoords[1], fixed[i].uv1);
        take(primitive.coloursLin, fixed[i].colour);
        if (reflectance == Reflectance::Coded && !primitive.coloursLin.empty())
            fixed[i].colour = coded(fixed[i].colour);
        take(primitive.joints, fixed[i].joints);
        take(primitive.weights, fixed[i].weights);
        take(primitive.selfOcclusion, fixed[i].selfOcclusion);
        take(primitive.selfOcclusionBesideOwn, fixed[i].selfOcclusionBesideOwn);
    }
    gpu.vertices = bufferOf<FixedVertex>(GL_ARRAY_BUFFER, fixed, GL_STATIC_DRAW);
    constexpr size_t kStride = sizeof(FixedVertex);
    gl::setAttribute(ATTRIBUTE_TANGENT, 4, kStride, offsetof(FixedVertex, tangent));
    gl::setAttribute(ATTRIBUTE_UV0, 2, kStride, offsetof(FixedVertex, uv0));
    gl::setAttribute(ATTRIBUTE_UV1, 2, kStride, offsetof(FixedVertex, uv1));
    gl::setAttribute(ATTRIBUTE_COLOUR, 4, kStride, offsetof(FixedVertex, colour));
    gl::setAttribute(ATTRIBUTE_WEIGHTS, 4, kStride, offsetof(FixedVertex, weights));
    gl::setAttribute(ATTRIBUTE_SELF_OCCLUSION, 4, kStride, offsetof(FixedVertex, selfOcclusion));
    gl::setAttribute(ATTRIBUTE_SELF_OCCLUSION_BESIDE_OWN, 4, kStride,
                     offsetof(FixedVertex, selfOcclusionBesideOwn));
    glEnableVertexAttribArray(ATTRIBUTE_JOINTS);
    glVertexAttribIPointer(ATTRIBUTE_JOINTS, 4, GL_UNSIGNED_SHORT, kStride,
                           reinterpret_cast<const void*>(offsetof(FixedVertex, joints)));

    gpu.indices = bufferOf(GL_ELEMENT_ARRAY_BUFFER, indices, GL_STATIC_DRAW);
    glBindVertexArray(0);
    return gpu;
}

PrimitiveGpu uploadPrimitive(const scene::Primitive& primitive, Reflectance reflectance,
                             std::span<const glm::vec3> bent) {
    PrimitiveGpu gpu;
    gpu.material = primitive.material;
    gpu.skinned = !primitive.joints.empty();
    gpu.coloured = !primitive.coloursLin.empty();
    gpu.withSelfOcclusion = !primitive.selfOcclusion.empty();
    std::vector<uint32_t> every(primitive.positions.size());
    std::iota(every.begin(), every.end(), 0u);
    gpu.details.push_back(uploadDetail(primitive, reflectance, every, primitive.indices));
    for (const scene::Lod& lod : scene::makeLods(primitive, bent)) {
        gpu.details.push_back(uploadDetail(primitive, reflectance, lod.vertices, lod.indices));
        gpu.details.back().error = lod.error;
    }
    return gpu;
}

GLint wrapMode(scene::Texture::Wrap wrap) {
    constexpr GLint kModes[] = {GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE}; // in the order of Wrap
    return kModes[static_cast<size_t>(wrap)];
}

ImageRgba8 halved(const ImageRgba8& image) {
    ImageRgba8 half(image.width / 2, image.height / 2);
    for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x)
            for (int c = 0; c < 4; ++c)
                half.at(x, y)[c] = static_cast<uint8_t>(
                    (image.at(2 * x, 2 * y)[c] + image.at(2 * x + 1, 2 * y)[c] +
                     image.at(2 * x, 2 * y + 1)[c] + image.at(2 * x + 1, 2 * y + 1)[c] + 2) /
                    4);
    return half;
}

gl::Texture uploadTexture(const scene::Texture& texture, const ImageRgba8& image, bool srgb, Detail detail) {
    gl::Texture gpu = gl::makeTexture(
        detail == Detail::Lean ? GL_LINEAR_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_LINEAR,
        texture.nearest ? GL_NEAREST : GL_LINEAR, wrapMode(texture.wrapS), wrapMode(texture.wrapT));
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, image.width, image.height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, image.pixels.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    return gpu;
}

std::shared_ptr<const TexturesGpu> uploadTextures(const scene::Model& model, Reflectance reflectance,
                                                  Detail detail) {
    TexturesGpu gpu;
    gpu.colour.resize(model.textures.size());
    gpu.data.resize(model.textures.size());
    // srgb: whether the sampler decodes it. Lean pictures have no pixels as small as the finest texels, and
    // show the relief only of an object that fills them: they halve a map as often as `halvings`.
    const auto want = [&](const scene::TextureUse& use, bool srgb, int halvings = 1) {
        if (use.texture < 0) return;
        const auto index = static_cast<size_t>(use.texture);
        gl::Texture& slot = (srgb ? gpu.colour : gpu.data)[index];
        const int image = model.textures[index].image;
        if (slot || image < 0) return;
        const ImageRgba8* texels = &model.images[static_cast<size_t>(image)];
        const int fine = kFine / halvings;
        ImageRgba8 smaller;
        for (; detail == Detail::Lean && halvings > 0 && texels->width >= fine; --halvings)
            smaller = halved(*texels), texels = &smaller;
        slot = uploadTexture(model.textures[index], *texels, srgb, detail);
    };
    // Materials that only another variant of the model uses need no textures.
    for (const scene::Mesh& mesh : model.meshes)
        for (const scene::Primitive& primitive : mesh.primitives) {
            const scene::Material& material = model.materialOf(primitive);
            want(material.baseColour, reflectanceFor(material, reflectance) == Reflectance::Linear);
            want(material.emissive, true);
            if (detail == Detail::Full) want(material.metallicRoughness, false); // lean: its mean
            want(material.normal, false, 2);
            want(material.occlusion, false);
            want(material.specular, false);
            want(material.specularColour, true);
            want(material.coat, false);
            want(material.coatRoughness, false);
        }
    return std::make_shared<const TexturesGpu>(std::move(gpu));
}

} // namespace

const DetailGpu& PrimitiveGpu::detail(float tolerance) const {
    size_t k = details.size() - 1;
    while (k > 0 && details[k].error > tolerance) --k;
    return details[k];
}

ModelGpu uploadModel(const scene::Model& model, Reflectance reflectance, Detail detail,
                     std::shared_ptr<const TexturesGpu> textures, std::span<const glm::vec3> bent) {
    ModelGpu gpu;
    gpu.reflectance = reflectance;
    gpu.materials = model.materials;
    gpu.materials.emplace_back();
    for (scene::Material& material : gpu.materials)
        if (reflectanceFor(material, reflectance) == Reflectance::Coded)
            material.baseColourLin = coded(material.baseColourLin);
    for (const scene::Mesh& mesh : model.meshes) {
        MeshGpu& meshGpu = gpu.meshes.emplace_back();
        for (const scene::Primitive& primitive : mesh.primitives) {
            PrimitiveGpu& uploaded = meshGpu.emplace_back(
                uploadPrimitive(primitive, reflectanceFor(model.materialOf(primitive), reflectance),
                                bent.empty() ? primitive.positions : bent));
            uploaded.gloss = scene::glossOf(model, gpu.materialOf(uploaded));
        }
    }
    gpu.textures = textures ? std::move(textures) : uploadTextures(model, reflectance, detail);
    return gpu;
}

void uploadMorphed(const scene::Mesh& mesh, std::span<const float> weights, MeshGpu& gpu) {
    for (size_t p = 0; p < mesh.primitives.size(); ++p) {
        if (mesh.primitives[p].morphTargets.empty()) continue;
        const std::vector<MorphVertex> vertices = morphed(mesh.primitives[p], weights);
        glBindBuffer(GL_ARRAY_BUFFER, gpu[p].details[0].morphable.name());
        glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(vertices.size() * sizeof(MorphVertex)),
                        vertices.data());
    }
}

} // namespace shoal::render
