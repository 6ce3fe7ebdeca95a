#include "engine/scene/Tangents.h"

#include "engine/scene/Vertices.h"

#include <glm/geometric.hpp>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace shoal::scene {

namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

struct Triangle {
    glm::vec3 alongU{0};   // unit, or zero
    bool rightWay = false; // u, v turn the same way as the corners (v downwards)
    bool anyWay = false;   // no area in the texture: joins whichever group reaches it first
    bool degenerate = false;
    std::array<uint32_t, 3> neighbour{kNone, kNone, kNone}; // across the edge from corner k to corner k + 1
    std::array<uint32_t, 3> group{kNone, kNone, kNone};     // of corner k
};

struct Group {
    glm::vec3 sum{0};
    bool rightWay = false;
};

class Builder {
  public:
    Builder(const Primitive& primitive, int texCoord)
        : primitive_(primitive), uv_(primitive.texCoords[texCoord]),
          triangles_(primitive.indices.size() / 3) {}

    TangentSplit build() {
        weld();
        measure();
        joinNeighbours();
        makeGroups();
        addUp();
        return split();
    }

  private:
    uint32_t vertex(size_t triangle, int corner) const {
        return primitive_.indices[3 * triangle + static_cast<size_t>(corner)];
    }
    uint32_t welded(size_t triangle, int corner) const { return welded_[vertex(triangle, corner)]; }
    glm::dvec3 position(size_t triangle, int corner) const {
        return glm::dvec3(primitive_.positions[vertex(triangle, corner)]);
    }

    // Vertices that differ in nothing that shapes the tangent count as one.
    void weld() {
        std::vector<std::array<float, 8>> keys(primitive_.positions.size());
        for (size_t v = 0; v < keys.size(); ++v) {
            const glm::vec3 &p = primitive_.positions[v], &n = primitive_.normals[v];
            keys[v] = {p.x, p.y, p.z, n.x, n.y, n.z, uv_[v].x, uv_[v].y};
            for (float& number : keys[v]) number += 0.0f; // -0 becomes 0: bytes are compared
        }
        welded_.resize(keys.size());
        meshopt_generateVertexRemap(welded_.data(), nullptr, keys.size(), keys.data(), keys.size(),
                                    sizeof keys[0]);
    }

    void measure() {
        for (size_t t = 0; t < triangles_.size(); ++t) {
            Triangle& triangle = triangles_[t];
            const glm::dvec3 p0 = position(t, 0), p1 = position(t, 1), p2 = position(t, 2);
            const glm::dvec2 uv0(uv_[vertex(t, 0)]), uv1(uv_[vertex(t, 1)]), uv2(uv_[vertex(t, 2)]);
            const glm::dvec2 e1 = uv1 - uv0, e2 = uv2 - uv0;
            const double twiceArea = e1.x * e2.y - e1.y * e2.x;
            triangle.degenerate = p0 == p1 || p1 == p2 || p2 == p0;
            triangle.rightWay = twiceArea > 0;
            // From p1 - p0 = e1.u U + e1.v V and p2 - p0 = e2.u U + e2.v V, solved for U up to its length.
            const glm::dvec3 along = (e2.y * (p1 - p0) - e1.y * (p2 - p0)) * (twiceArea < 0 ? -1.0 : 1.0);
            triangle.alongU = safeNormalize(along, glm::vec3(0));
            triangle.anyWay = twiceArea == 0 || triangle.alongU == glm::vec3(0);
        }
    }

    // Two triangles are neighbours where one goes along an edge as the other goes back; each edge is used
    // once.
    void joinNeighbours() {
        struct Edge {
            uint32_t low, high, corner; // 3 * triangle + corner
        };
        std::vector<Edge> edges;
        edges.reserve(primitive_.indices.size());
        for (size_t t = 0; t < triangles_.size(); ++t) {
            if (triangles_[t].degenerate) continue;
            for (int k = 0; k < 3; ++k) {
                const uint32_t a = welded(t, k), b = welded(t, (k + 1) % 3);
                edges.push_back({std::min(a, b), std::max(a, b),
                                 static_cast<uint32_t>(3 * t) + static_cast<uint32_t>(k)});
            }
        }
        std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
            return std::array{a.low, a.high, a.corner} < std::array{b.low, b.high, b.corner};
        });
        for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
            while (end < edges.size() && edges[end].low == edges[begin].low &&
                   edges[end].high == edges[begin].high)
                ++end;
            // Those that go up and those that go down, paired in the order of the file.
            size_t up = begin, down = begin;
            const auto goesUp = [&](size_t e) {
                return welded(edges[e].corner / 3, static_cast<int>(edges[e].corner % 3)) == edges[e].low;
            };
            while (true) {
                while (up < end && !goesUp(up)) ++up;
                while (down < end && goesUp(down)) ++down;
                if (up == end || down == end) break;
                const uint32_t a = edges[up++].corner, b = edges[down++].corner;
                triangles_[a / 3].neighbour[a % 3] = b / 3;
                triangles_[b / 3].neighbour[b % 3] = a / 3;
            }
        }
    }

    int cornerAt(size_t triangle, uint32_t weldedVertex) const {
        for (int k = 0; k < 3; ++k)
            if (welded(triangle, k) == weldedVertex) return k;
        return -1;
    }

    void makeGroups() {
        std::vector<uint32_t> waiting;
        for (size_t t = 0; t < triangles_.size(); ++t) {
            if (triangles_[t].degenerate || triangles_[t].anyWay) continue;
            for (int k = 0; k < 3; ++k) {
                if (triangles_[t].group[static_cast<size_t>(k)] != kNone) continue;
                const auto group = static_cast<uint32_t>(groups_.size());
                groups_.push_back({glm::vec3(0), triangles_[t].rightWay});
                waiting.assign(1, static_cast<uint32_t>(t));
                while (!waiting.empty()) {
                    const uint32_t next = waiting.back();
                    waiting.pop_back();
                    join(next, welded(t, k), group, waiting);
                }
            }
        }
    }

    void join(uint32_t t, uint32_t weldedVertex, uint32_t group, std::vector<uint32_t>& waiting) {
        Triangle& triangle = triangles_[t];
        const int corner = cornerAt(t, weldedVertex);
        if (corner < 0 || triangle.group[static_cast<size_t>(corner)] != kNone) return;
        const bool free = triangle.group == std::array<uint32_t, 3>{kNone, kNone, kNone};
        if (triangle.anyWay && free) triangle.rightWay = groups_[group].rightWay;
        if (triangle.rightWay != groups_[group].rightWay) return;
        triangle.group[static_cast<size_t>(corner)] = group;
        for (const int edge : {corner, (corner + 2) % 3}) // the two edges that meet there
            if (const uint32_t other = triangle.neighbour[static_cast<size_t>(edge)]; other != kNone)
                waiting.push_back(other);
    }

    // Each triangle's direction laid into the plane of the corner's normal, weighted by the corner's angle
    // there.
    void addUp() {
        for (size_t t = 0; t < triangles_.size(); ++t) {
            const Triangle& triangle = triangles_[t];
            if (triangle.degenerate || triangle.anyWay) continue;
            for (int k = 0; k < 3; ++k) {
                const glm::dvec3 n(primitive_.normals[vertex(t, k)]);
                const auto inPlane = [&](const glm::dvec3& v) {
                    return safeNormalize(v - n * glm::dot(n, v), glm::vec3(0));
                };
                const glm::dvec3 here = position(t, k);
                const glm::vec3 next = inPlane(position(t, (k + 1) % 3) - here);
                const glm::vec3 last = inPlane(position(t, (k + 2) % 3) - here);
                const float angle = std::acos(std::clamp(glm::dot(next, last), -1.0f, 1.0f));
                groups_[triangle.group[static_cast<size_t>(k)]].sum +=
                    angle * inPlane(glm::dvec3(triangle.alongU));
            }
        }
    }

    // The tangent of a corner; corners without a group borrow from one at the same place.
    glm::vec4 tangent(size_t t, int k, const std::vector<uint32_t>& lent) const {
        const glm::vec3& n = primitive_.normals[vertex(t, k)];
        uint32_t group = triangles_[t].group[static_cast<size_t>(k)];
        if (group == kNone) group = lent[welded(t, k)];
        const glm::vec3 any = perpendicular(n);
        if (group == kNone) return {any, 1};
        // v grows downwards in glTF's textures: where u, v turn with the corners, cross(normal, u) points
        // down.
        return {safeNormalize(glm::dvec3(groups_[group].sum), any), groups_[group].rightWay ? -1.0f : 1.0f};
    }

    TangentSplit split() const {
        std::vector<uint32_t> lent(welded_.size(), kNone);
        for (size_t t = 0; t < triangles_.size(); ++t)
            for (int k = 0; k < 3; ++k)
                if (const uint32_t group = triangles_[t].group[static_cast<size_t>(k)]; group != kNone) {
                    uint32_t& lender = lent[welded(t, k)];
                    lender = std::min(lender, group);
                }

        // Sorted rather than searched vertex by vertex: thousands of triangles may meet in one.
        struct Corner {
            uint32_t vertex, corner;
            glm::vec4 tangent;
        };
        std::vector<Corner> corners;
        corners.reserve(primitive_.indices.size());
        for (size_t t = 0; t < triangles_.size(); ++t)
            for (int k = 0; k < 3; ++k)
                corners.push_back({vertex(t, k), static_cast<uint32_t>(3 * t) + static_cast<uint32_t>(k),
                                   tangent(t, k, lent)});
        std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
            const auto key = [](const Corner& c) {
                return std::tuple(c.vertex, c.tangent.x, c.tangent.y, c.tangent.z, c.tangent.w, c.corner);
            };
            return key(a) < key(b);
        });

        TangentSplit result;
        result.indices.resize(primitive_.indices.size());
        for (const Corner& corner : corners) {
            if (result.source.empty() || result.source.back() != corner.vertex ||
                result.tangents.back() != corner.tangent) {
                result.source.push_back(corner.vertex);
                result.tangents.push_back(corner.tangent);
            }
            result.indices[corner.corner] = static_cast<uint32_t>(result.source.size() - 1);
        }
        return result;
    }

    const Primitive& primitive_;
    const std::vector<glm::vec2>& uv_;
    std::vector<uint32_t> welded_;
    std::vector<Triangle> triangles_;
    std::vector<Group> groups_;
};

} // namespace

TangentSplit makeTangents(const Primitive& primitive, int texCoord) {
    return Builder(primitive, texCoord).build();
}

} // namespace shoal::scene
