// A glTF 2.0 model in memory, checked, in types that can be drawn and posed.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/math/Sphere.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace shoal::scene {

// Model frame: glTF's, right-handed, +Y up, the model faces +Z, metres.

struct Texture {
    int image = -1; // index into Model::images
    enum class Wrap { Repeat, Mirror, Clamp } wrapS = Wrap::Repeat, wrapT = Wrap::Repeat;
    bool nearest = false; // magnification filter
};

struct TextureUse {
    int texture = -1; // index into Model::textures; -1: none
    int texCoord = 0; // 0 or 1
};

enum class AlphaMode { Opaque, Mask, Blend };

struct Material {
    std::string name;
    glm::vec4 baseColourLin{1};
    float metallic = 1;
    float roughness = 1; // perceptual; alpha = roughness^2
    // Fresnel reflectance of the dielectric part at normal incidence (F0) and at grazing angles (F90)
    glm::vec3 dielectricF0{0.04f};
    float dielectricF90 = 1;
    float clearcoat = 0, clearcoatRoughness = 0; // strength, perceptual roughness
    glm::vec3 emissiveLin{0};
    float normalScale = 1;
    float occlusionStrength = 1;
    AlphaMode alphaMode = AlphaMode::Opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;
    bool unlit = false; // shown in its base colour, without lighting; most other members keep their defaults
    TextureUse baseColour, metallicRoughness, normal, occlusion, emissive;
    TextureUse specular, specularColour; // A multiplies F0 and F90 of dielectrics, RGB multiplies F0
    TextureUse coat, coatRoughness;      // R multiplies clearcoat, G clearcoatRoughness

    std::array<TextureUse, 9> textures() const {
        return {baseColour, metallicRoughness, normal, occlusion,    emissive,
                specular,   specularColour,    coat,   coatRoughness};
    }
};

struct MorphTarget { // deltas; each empty or one per vertex
    std::vector<glm::vec3> positions, normals;
};

struct Primitive { // triangles
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;      // always there: flat ones are generated where the file has none
    std::vector<glm::vec4> tangents;     // w: handedness; empty unless the material has a normal map
    std::vector<glm::vec2> texCoords[2]; // empty if absent
    std::vector<glm::vec4> coloursLin;   // empty if absent
    std::vector<glm::u16vec4> joints;    // indices into Skin::joints; empty if absent
    std::vector<glm::vec4> weights;      // heaviest first, sum 1; empty if absent
    // Self-occlusion at rest, in the mesh's frame: at a vertex the body occludes the share w + dot(xyz, d) of
    // the light from direction d. Empty without self-occlusion.
    std::vector<glm::vec4> selfOcclusion;
    std::vector<glm::vec4> selfOcclusionBesideOwn; // in a bent pose, beyond what its own ellipsoids occlude
    std::vector<uint32_t> indices;                 // a multiple of 3, all below positions.size()
    std::vector<MorphTarget> morphTargets;
    int material = -1;                 // index into Model::materials; -1: glTF's default material
    std::vector<int> variantMaterials; // by variant; -1: `material`; empty without variants
};

struct Mesh {
    std::vector<Primitive> primitives;
    std::vector<float> morphWeights; // defaults; one per target
};

struct Skin {
    std::vector<int> joints;              // node indices
    std::vector<glm::mat4> jointFromMesh; // inverse bind matrices; one per joint
};

struct Transform {
    glm::vec3 translation{0};
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 scale{1};
};

struct Node {
    std::string name;
    Transform parentFromNode;
    std::optional<glm::mat4> matrix; // replaces the transform if the file's matrix cannot be decomposed
    int parent = -1;
    std::vector<int> children;
    int mesh = -1;
    int skin = -1;
    std::vector<float> morphWeights; // overrides the mesh's defaults if not empty
};

struct Channel {
    enum class Target { Translation, Rotation, Scale, Weights } target = Target::Translation;
    enum class Interpolation { Step, Linear, CubicSpline } interpolation = Interpolation::Linear;
    int node = -1;
    std::vector<float> times_s;
    std::vector<float> values; // per key: 3, 4 (x y z w) or the number of weights; times 3 for cubic splines
};

struct Animation {
    std::string name;
    float duration_s = 0;
    std::vector<Channel> channels;
};

struct Model {
    std::vector<Node> nodes; // a parent may come after its children; order gives parents before children
    std::vector<int> order;  // node indices of the default scene, parents first
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<ImageRgba8> images; // as stored: colour images sRGB-coded, data images linear
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    std::vector<std::string> variants; // names of its material variants

    int findAnimation(const std::string& name) const; // -1 if absent
    int findNode(const std::string& name) const;      // -1 if absent
    const Material& materialOf(const Primitive&) const;
    const ImageRgba8* imageOf(const TextureUse&) const; // null without one
};

struct LoadLimits {
    uint64_t maxFileBytes = 256u << 20;   // each file read, buffers and images included
    uint64_t maxTotalBytes = 1u << 30;    // all of them together
    uint64_t maxVertices = 4'000'000;     // in all, with those of morph targets and those split for normals
    uint64_t maxIndices = 12'000'000;     // in all
    uint64_t maxImagePixels = 64'000'000; // in all
    uint64_t maxKeyValues = 16'000'000;   // numbers in all animations' keys
    uint32_t maxNodes = 65'536;           // also the limit of other lists, but four times that for accessors
    uint32_t maxJoints = 256;             // in each skin
};

// Loads a model from a .glb or .gltf file, which is untrusted; reads only files at or below its own folder.
// The result is valid: indices and joints are in range, positions finite, nodes without cycles. Generates
// flat normals and tangents (per glTF, MikkTSpace's convention) if they are missing. Errors name the file and
// the glTF element that is wrong. Each warning (odd, but drawable) is logged once. variant: applied, and only
// its images are read; empty: all are, and applyVariant() may follow.
Result<Model> loadModel(const Path& file, const std::string& variant = {}, const LoadLimits& limits = {});

// Gives each primitive its material of this variant. False if there is no such variant.
bool applyVariant(Model&, const std::string& variant);

// The pose of a model at one moment. Reused between frames; nothing allocates after the first use.
struct Pose {
    std::vector<Transform> local;                 // per node
    std::vector<glm::mat4> modelFromNode;         // per node
    std::vector<std::vector<float>> morphWeights; // per node; empty without morph targets
};

// Sets the pose that the file gives without animation, modelFromNode included.
void restPose(const Model&, Pose&);

// Overwrites the animated transforms and weights of pose.local at this time (clamped to the animation's span;
// the caller wraps loops). weight blends between the given pose (0) and the animation (1).
void animate(const Model&, int animation, float time_s, Pose&, float weight = 1);

// Fills modelFromNode from local, for the nodes in model.order; the others keep theirs.
void updateGlobals(const Model&, Pose&);

// Computes the modelFromMesh matrices of a skin's joints: modelFromNode * jointFromMesh. out is resized to
// the joint count.
void skinMatrices(const Model&, int skin, const Pose&, std::vector<glm::mat4>& out);
// Returns the weighted skinning matrix of a vertex. joints: result of skinMatrices().
glm::mat4 skinMatrix(const Primitive&, size_t vertex, std::span<const glm::mat4> joints);

struct MorphedVertex {
    glm::vec3 position, normal; // the normal is not normalised
};
// Returns a vertex with its morph targets applied. weights: by target; missing weights are 0.
MorphedVertex morphed(const Primitive&, size_t vertex, std::span<const float> weights);

struct Bounds {
    glm::vec3 low{0}, high{0};
};
using shoal::Sphere;
// Returns the bounds of the posed model's vertices, skinned and morphed, in the model frame.
Bounds posedBounds(const Model&, const Pose&);

} // namespace shoal::scene
