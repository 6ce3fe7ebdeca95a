// The surface of a posed model as one triangle mesh, means over its materials, and spheres that hold it
// however its joints turn.
#pragma once

#include "engine/scene/Model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace shoal::scene {

struct Surface {
    std::vector<glm::vec3> positions, normals; // model frame; normals unit
    std::vector<uint32_t> indices;             // three a triangle
    std::vector<uint32_t> opaque;              // those of them that let no light through
    std::vector<uint16_t> nodesOf; // the node that moves each position most: a joint, or the mesh's own
};

// Joins every primitive of every node, in the order of model.order. The pose's globals must be up to date.
Surface posedSurface(const Model& model, const Pose& pose);

bool isBlended(const Model& model, const Primitive& primitive);

// Returns the mean reflectance over the texels of all materials in use, weighed by the area of their
// triangles in the mesh; linear.
glm::vec3 meanBaseColour(const Model& model);

// Roughness and metalness of a material, from factors and textures: they decide which prefiltered light maps
// are made.
struct Gloss {
    // The least perceptual roughness, of the clearcoat too; where a texture gives it, all but the smoothest
    // hundredth of its texels are at least as rough.
    float minRoughness = 1;
    float meanRoughness = 1, meanMetallic = 1; // over the texture that gives them, times the factors
};

Gloss glossOf(const Model& model, const Material& material);

// Returns the least of each over all materials that some mesh uses; 1 where there are none.
Gloss minGloss(const Model& model);

// A sphere in a node's frame around vertices that the node moves most. All of them lie in the node's spheres,
// and skin between two joints in the spheres of both.
struct NodeSphere {
    int node = 0;
    glm::vec3 centre{0};
    float radius = 0;
};

// Makes one sphere or more for each node that moves anything. The pose's globals must be up to date; the
// model's meshes must still be there.
std::vector<NodeSphere> boundingSpheresOf(const Model& model, const Pose& rest);

// Places each sphere by another pose, in the world frame. worldFromModel may scale, alike in all directions.
void placeSpheres(const std::vector<NodeSphere>& reach, const Pose& pose, const glm::mat4& worldFromModel,
                  std::vector<Sphere>& spheres);

Sphere boundingSphereOf(std::span<const Sphere> spheres); // holds them all

} // namespace shoal::scene
