// Triangle meshes with the surface properties that lighting needs.
#pragma once

#include "content/make/video/Scene.h"

#include <functional>

namespace shoal::reef {

// Kinds of surface; each has its own fine relief and colour.
enum class Kind : uint8_t { Sand, Rock, Coral, Soft, Leaf, Lamp, Animal };

struct Vertex {
    vec3 p{0}, normal{0};
    vec3 albedo{0};
    Kind kind = Kind::Rock;
    float sway = 0;    // amplitude of its movement by the surge, metres; 0: it stands still
    uint32_t glow = 0; // emitted radiance, packed by glm::packF3x9_E1x5()
};

struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<glm::uvec3> triangles;

    uint32_t add(const Vertex& vertex) {
        vertices.push_back(vertex);
        return static_cast<uint32_t>(vertices.size() - 1);
    }
    // Adds another mesh with each p moved to place + turn * p * size, albedo times tint, sway times size.
    void add(const Mesh& part, const glm::mat3& turn, float size, const vec3& place, const vec3& tint);
    // Sets vertex normals to area-weighted means of the triangles' normals.
    void makeNormals();
    // Adds a tube along points, open at both ends; a last radius of 0 closes its end.
    void addTube(const std::vector<vec3>& points, const std::vector<float>& radii, int sides,
                 const std::function<vec3(float)>& albedoAlong, Kind kind, float swayAtEnd = 0);
    // Adds a grid of columns x rows vertices, row by row; `round` joins the last column to the first.
    void addGrid(int columns, int rows, bool round, const std::function<Vertex(float, float)>& at);
};

// Returns axes with y along up, turned about it by `angle`.
glm::mat3 frameAlong(const vec3& up, float angle);

} // namespace shoal::reef
