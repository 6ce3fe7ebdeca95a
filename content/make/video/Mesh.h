// Triangles with what the light needs to know of their surface.
#pragma once

#include "content/make/video/Scene.h"

#include <functional>

namespace shoal::reef {

// Kinds of surface; each has its own fine relief and colour.
enum class Kind : uint8_t { Sand, Rock, Coral, Soft, Leaf, Lamp };

struct Vertex {
    vec3 p{0}, normal{0};
    vec3 albedo{0};
    Kind kind = Kind::Rock;
    float sway = 0;    // metres that the surge moves it to either side; 0 for what stands still
    uint32_t glow = 0; // radiance that it sends by itself, as glm::packF3x9_E1x5 packs it
};

struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<glm::uvec3> triangles;

    uint32_t add(const Vertex& vertex) {
        vertices.push_back(vertex);
        return static_cast<uint32_t>(vertices.size() - 1);
    }
    // Another mesh, moved by p -> place + turn * p * size; its albedo times tint, its sway times size.
    void add(const Mesh& part, const glm::mat3& turn, float size, const vec3& place, const vec3& tint);
    // Area-weighted means of the triangles' normals.
    void makeNormals();
    // A tube along points, closed at its end by a point; the last radius may be 0.
    void addTube(const std::vector<vec3>& points, const std::vector<float>& radii, int sides,
                 const std::function<vec3(float)>& albedoAlong, Kind kind, float swayAtEnd = 0);
    // A grid of columns x rows vertices, in rows; closed in columns if `round`.
    void addGrid(int columns, int rows, bool round, const std::function<Vertex(float, float)>& at);
};

// A frame with y along up, turned by `angle` about it.
glm::mat3 frameAlong(const vec3& up, float angle);

} // namespace shoal::reef
