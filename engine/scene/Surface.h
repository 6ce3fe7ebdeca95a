// The surface of a posed model as one triangle mesh, means over its materials, and bounding spheres that hold
// in every pose.
#pragma once

#include "engine/scene/Model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::scene {

struct Surface {
    std::vector<glm::vec3> positions, normals; // model frame; normals unit
    std::vector<uint32_t> indices;             // three a triangle
    std::vector<uint32_t> opaque;              // the indices of opaque triangles
    std::vector<uint16_t> nodesOf;             // node that moves each position most: a joint, or the mesh's
};

// Joins every primitive of every node, in the order of model.order. The pose's globals must be up to date.
Surface posedSurface(const Model& model, const Pose& pose);

// Returns the mean linear base colour of all primitives, weighted by the area of their triangles; a texture
// counts by its mean colour.
glm::vec3 meanBaseColour(const Model& model);

// Roughness and metalness of a material, from factors and textures: they decide which light maps are made.
struct Gloss {
    // The least perceptual roughness, that of the clearcoat included. Of a texture the smoothest hundredth of
    // the texels is ignored.
    float minRoughness = 1;
    float meanRoughness = 1, meanMetallic = 1; // means over their texture, times the factors
};

Gloss glossOf(const Model& model, const Material& material);

// Returns the minimum of each member over all materials that a mesh uses; 1 without materials.
Gloss minGloss(const Model& model);

// A sphere in a node's frame around vertices that the node moves most. Each such vertex lies in a sphere of
// the node; spheres of neighbouring joints overlap, so that they cover the skin between them.
struct NodeSphere {
    int node = 0;
    glm::vec3 centre{0};
    float radius = 0;
};

// Makes one sphere or more for each node that moves anything. The pose's globals must be up to date; the
// model's meshes must still be there.
std::vector<NodeSphere> boundingSpheresOf(const Model& model, const Pose& rest);

// Computes the spheres in the world frame for another pose. worldFromModel may contain a uniform scale.
void placeSpheres(const std::vector<NodeSphere>& reach, const Pose& pose, const glm::mat4& worldFromModel,
                  std::vector<Sphere>& spheres);

Sphere boundingSphereOf(std::span<const Sphere> spheres); // contains all of them

} // namespace shoal::scene
