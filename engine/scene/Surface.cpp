#include "engine/scene/Surface.h"

#include "engine/math/Colour.h"
#include "engine/scene/Vertices.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <span>

namespace shoal::scene {

namespace {

Bounds boundsOf(std::span<const glm::vec3> positions) {
    if (positions.empty()) return {};
    Bounds all{positions[0], positions[0]};
    for (const glm::vec3& p : positions) all = {glm::min(all.low, p), glm::max(all.high, p)};
    return all;
}

// Appends a node's primitive, morphed and skinned by the pose, to the surface.
void append(const Model& model, int index, const Pose& pose, std::span<const glm::mat4> joints,
            const Primitive& primitive, Surface& surface) {
    const Node& node = model.nodes[index];
    const bool skinned = node.skin >= 0 && !primitive.joints.empty();
    const auto first = static_cast<uint32_t>(surface.positions.size());
    for (size_t v = 0; v < primitive.positions.size(); ++v) {
        const auto [position, normal] = morphed(primitive, v, pose.morphWeights[index]);
        const glm::mat4 modelFromMesh =
            skinned ? skinMatrix(primitive, v, joints) : pose.modelFromNode[index];
        const int mover = skinned ? model.skins[node.skin].joints[primitive.joints[v][0]] : index;
        const glm::mat3 m(modelFromMesh);
        const glm::mat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
        const float side = glm::dot(cofactor[0], m[0]) < 0 ? -1.0f : 1.0f;
        surface.positions.emplace_back(modelFromMesh * glm::vec4(position, 1));
        surface.normals.push_back(safeNormalize(glm::dvec3(side * (cofactor * normal)), {0, 1, 0}));
        surface.nodesOf.push_back(static_cast<uint16_t>(mover));
    }
    const bool opaque = model.materialOf(primitive).alphaMode != AlphaMode::Blend;
    for (const uint32_t i : primitive.indices) {
        surface.indices.push_back(first + i);
        if (opaque) surface.opaque.push_back(first + i);
    }
}

// Factor on radii, so that spheres cover skin that several nodes move and triangles between two spheres;
// fingers bent by more than a right angle need it.
constexpr float kWider = 1.2f;
constexpr float kLongest = 1.6f;    // times the second longest side: longer boxes are halved
constexpr size_t kMinPositions = 8; // boxes with so few positions are not halved

void addSpheres(int node, std::span<glm::vec3> positions, std::vector<NodeSphere>& all) {
    const auto [low, high] = boundsOf(positions);
    const glm::vec3 sides = high - low, middle = 0.5f * (low + high);
    const int longest = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
    if (positions.size() > kMinPositions &&
        sides[longest] > kLongest * std::max(sides[(longest + 1) % 3], sides[(longest + 2) % 3])) {
        const auto half = std::ranges::partition(
            positions, [&](const glm::vec3& p) { return p[longest] < middle[longest]; });
        const size_t below = positions.size() - half.size();
        if (below > 0 && !half.empty()) {
            addSpheres(node, positions.first(below), all);
            return addSpheres(node, positions.subspan(below), all);
        }
    }
    float radius = 0;
    for (const glm::vec3& p : positions) radius = std::max(radius, glm::distance(p, middle));
    all.push_back({node, middle, kWider * radius});
}

// Minimum, ignoring the smallest hundredth of the values, and mean of a channel, 0 to 1.
struct ChannelStatistics {
    float minimum, mean;
};
ChannelStatistics statisticsOf(const ImageRgba8& texels, size_t channel) {
    std::array<size_t, 256> counts{};
    double sum = 0;
    for (size_t i = channel; i < texels.pixels.size(); i += 4)
        ++counts[texels.pixels[i]], sum += texels.pixels[i];
    size_t below = 0, value = 0;
    while (value < 255 && (below += counts[value]) * 100 <= texels.pixels.size() / 4) ++value;
    const auto bytes = static_cast<double>(std::max<size_t>(texels.pixels.size(), 4));
    return {static_cast<float>(value) / 255.0f, static_cast<float>(sum * 4 / (255.0 * bytes))};
}

} // namespace

Surface posedSurface(const Model& model, const Pose& pose) {
    Surface surface;
    std::vector<glm::mat4> joints;
    for (const int index : model.order) {
        const Node& node = model.nodes[index];
        if (node.mesh < 0) continue;
        if (node.skin >= 0) skinMatrices(model, node.skin, pose, joints);
        for (const Primitive& primitive : model.meshes[node.mesh].primitives)
            append(model, index, pose, joints, primitive, surface);
    }
    return surface;
}

Bounds posedBounds(const Model& model, const Pose& pose) {
    return boundsOf(posedSurface(model, pose).positions);
}

glm::vec3 meanBaseColour(const Model& model) {
    std::array<double, 256> linear;
    for (size_t i = 0; i < 256; ++i) linear[i] = math::linearFromSrgb(static_cast<double>(i) / 255);
    glm::dvec3 sum(0);
    double all = 0;
    for (const Mesh& mesh : model.meshes)
        for (const Primitive& primitive : mesh.primitives) {
            const Material& material = model.materialOf(primitive);
            glm::dvec3 colour(material.baseColourLin);
            if (const ImageRgba8* texels = model.imageOf(material.baseColour)) {
                constexpr size_t kEvery = 7; // texels; odd, so that no column is left out
                glm::dvec3 mean(0);
                double count = 0;
                for (size_t i = 0; i + 3 < texels->pixels.size(); i += 4 * kEvery, ++count)
                    for (int c = 0; c < 3; ++c) mean[c] += linear[texels->pixels[i + static_cast<size_t>(c)]];
                colour *= mean / std::max(count, 1.0);
            }
            double area = 0;
            for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
                const glm::vec3& a = primitive.positions[primitive.indices[i]];
                area += static_cast<double>(
                    glm::length(glm::cross(primitive.positions[primitive.indices[i + 1]] - a,
                                           primitive.positions[primitive.indices[i + 2]] - a)));
            }
            sum += area * colour, all += area;
        }
    return all > 0 ? glm::vec3(sum / all) : glm::vec3(0);
}

Gloss glossOf(const Model& model, const Material& material) {
    float least = material.roughness, roughness = material.roughness, metallic = material.metallic;
    if (const ImageRgba8* texels = model.imageOf(material.metallicRoughness)) {
        const ChannelStatistics rough = statisticsOf(*texels, 1);
        least *= rough.minimum;
        roughness *= rough.mean;
        metallic *= statisticsOf(*texels, 2).mean;
    }
    if (material.clearcoat > 0) {
        const ImageRgba8* texels = model.imageOf(material.coatRoughness);
        least =
            std::min(least, material.clearcoatRoughness * (texels ? statisticsOf(*texels, 1).minimum : 1));
    }
    return {least, roughness, metallic};
}

Gloss minGloss(const Model& model) {
    Gloss least;
    for (const Mesh& mesh : model.meshes)
        for (const Primitive& primitive : mesh.primitives) {
            const Gloss gloss = glossOf(model, model.materialOf(primitive));
            least = {std::min(least.minRoughness, gloss.minRoughness),
                     std::min(least.meanRoughness, gloss.meanRoughness),
                     std::min(least.meanMetallic, gloss.meanMetallic)};
        }
    return least;
}

std::vector<NodeSphere> boundingSpheresOf(const Model& model, const Pose& rest) {
    const Surface surface = posedSurface(model, rest);
    std::map<int, std::vector<glm::vec3>> byNode; // positions, each in its node's frame
    for (size_t v = 0; v < surface.positions.size(); ++v)
        byNode[surface.nodesOf[v]].push_back(surface.positions[v]);
    std::vector<NodeSphere> all;
    for (auto& [node, positions] : byNode) {
        const glm::mat4 nodeFromModel = glm::inverse(rest.modelFromNode[node]);
        for (glm::vec3& p : positions) p = glm::vec3(nodeFromModel * glm::vec4(p, 1));
        addSpheres(node, positions, all);
    }
    return all;
}

void placeSpheres(const std::vector<NodeSphere>& reach, const Pose& pose, const glm::mat4& worldFromModel,
                  std::vector<Sphere>& spheres) {
    spheres.clear();
    for (const NodeSphere& each : reach) {
        const glm::mat4 world = worldFromModel * pose.modelFromNode[each.node];
        spheres.push_back(
            {glm::vec3(world * glm::vec4(each.centre, 1)), each.radius * glm::length(glm::vec3(world[0]))});
    }
}

Sphere boundingSphereOf(std::span<const Sphere> spheres) {
    if (spheres.empty()) return {};
    glm::vec3 low = spheres[0].centre, high = low;
    for (const Sphere& s : spheres)
        low = glm::min(low, s.centre - s.radius), high = glm::max(high, s.centre + s.radius);
    Sphere around{0.5f * (low + high), 0};
    for (const Sphere& sphere : spheres)
        around.radius = std::max(around.radius, glm::distance(sphere.centre, around.centre) + sphere.radius);
    return around;
}

} // namespace shoal::scene
