// Bodies that bend, in layered fragment buffers of their own: asked at rest through their skin, or as they
// were when they were last seen.
#include "tests/baselines/occlusion/PlacedBodies.h"
#include "tests/baselines/occlusion/RebuiltOllfb.h"
#include "tests/baselines/occlusion/ThroughSkin.h"
#include "tests/bench/occlusion/RayMethod.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <map>

namespace shoal::bench {

namespace {

using occlusion::TracedOllfb;

constexpr TracedOllfb::Options kOptions{.views = 150, .resolution = 64};
constexpr float kMaxBend_px = 4;    // of a view, before a body is seen anew
constexpr float kPixel = 1 / 64.0f; // of the body's extent

// The frame of its rest pose, carried by the bone that moves most of it, so that what is left is its bending.
glm::mat4 worldFromBody(const Body& body) {
    std::vector<int> moved(body.worldFromRest.size());
    for (const int bone : body.boneOf) ++moved[static_cast<size_t>(bone)];
    return body.worldFromRest[static_cast<size_t>(std::ranges::max_element(moved) - moved.begin())];
}

std::vector<glm::vec3> carried(const glm::mat4& by, std::span<const glm::vec3> places) {
    std::vector<glm::vec3> out;
    for (const glm::vec3& p : places) out.emplace_back(by * glm::vec4(p, 1));
    return out;
}

template <class T> T orAbort(Result<T> made, const Body& body) {
    if (!made) {
        std::fprintf(stderr, "occlusion: %s: %s\n", body.name.c_str(), made.error().message().c_str());
        std::abort();
    }
    return std::move(*made);
}

// What both have in common: bodies in frames of their own. Method: what is asked there.
template <class Method> struct Bending {
    struct One {
        Method method;
        glm::mat4 bodyFromWorld{1};
        Sphere sphereWorld;
    };
    std::deque<One> bodies;

    // ownOrigin: in the frame of the receiver's body, which rays meet from so many of its sphere's radii on:
    // what gives the least error.
    bool occluded(const Receiver& at, const glm::vec3& direction, const glm::vec3& ownOrigin,
                  float start) const {
        for (size_t b = 0; b < bodies.size(); ++b) {
            const One& body = bodies[b];
            if (!occlusion::meets(body.sphereWorld, at.position, direction, 0, INFINITY)) continue;
            const glm::vec3 turned = glm::mat3(body.bodyFromWorld) * direction;
            const bool own = b == at.body;
            if (body.method.trace(own ? ownOrigin : glm::vec3(body.bodyFromWorld * glm::vec4(at.position, 1)),
                                  turned, own ? start * body.sphereWorld.radius : 0))
                return true;
        }
        return false;
    }
};

struct Skins : Bending<occlusion::ThroughSkin> {
    std::map<std::string, TracedOllfb> rest;   // by kind, shared
    std::vector<std::vector<glm::vec3>> posed; // [body], its frame

    explicit Skins(const Scene& scene) {
        for (const Body& body : scene.bodies) {
            if (!rest.contains(body.name))
                rest.emplace(body.name, orAbort(TracedOllfb::make(body.rest.view(), kOptions), body));
            const glm::mat4 bodyFromWorld = glm::inverse(worldFromBody(body));
            bodies.push_back({{rest.at(body.name), body.rest.positions},
                              bodyFromWorld,
                              occlusion::boundingSphere(body.posed.view())});
            posed.push_back(carried(bodyFromWorld, body.posed.positions));
        }
    }
    void bend() {
        for (size_t b = 0; b < bodies.size(); ++b) bodies[b].method.bend(posed[b]);
    }
    bool occluded(const Receiver& at, const glm::vec3& direction) const {
        return Bending::occluded(at, direction,
                                 glm::vec3(bodies[at.body].bodyFromWorld * glm::vec4(at.position, 1)), 0.02f);
    }
    size_t bytes() const {
        size_t sum = 0;
        for (const auto& [name, buffers] : rest) sum += buffers.bytes();
        for (const One& body : bodies) sum += body.method.bytes();
        return sum;
    }
};

// As they are just before they are seen anew: last seen on the way here from their rest pose.
struct Seen : Bending<occlusion::RebuiltOllfb> {
    const Scene* scene;
    std::vector<Mesh> before, now; // [body], its frame

    explicit Seen(const Scene& of) : scene(&of) {
        for (const Body& body : of.bodies) {
            const glm::mat4 bodyFromWorld = glm::inverse(worldFromBody(body));
            Mesh posed = body.posed;
            posed.positions = carried(bodyFromWorld, body.posed.positions);
            for (glm::vec3& normal : posed.normals) normal = glm::mat3(bodyFromWorld) * normal;
            const Sphere sphere = occlusion::boundingSphere(body.posed.view());
            const float maximum = kMaxBend_px * kPixel * 2 * sphere.radius;
            const float bend = occlusion::bend_m(posed.positions, body.rest.positions);
            const float back = bend > 0 ? std::min(1.0f, 0.999f * maximum / bend) : 0;
            Mesh was = posed;
            for (size_t v = 0; v < was.positions.size(); ++v) {
                was.positions[v] = glm::mix(posed.positions[v], body.rest.positions[v], back);
                was.normals[v] = glm::normalize(glm::mix(posed.normals[v], body.rest.normals[v], back));
            }
            bodies.push_back({occlusion::RebuiltOllfb(kOptions, maximum), bodyFromWorld, sphere});
            before.push_back(std::move(was));
            now.push_back(std::move(posed));
        }
    }
    void bend() {
        for (size_t b = 0; b < bodies.size(); ++b)
            for (const Mesh* mesh : {&before[b], &now[b]})
                orAbort(bodies[b].method.follow(mesh->view()), scene->bodies[b]);
    }
    // A point of the surface knows where it was.
    bool occluded(const Receiver& at, const glm::vec3& direction) const {
        const Mesh &was = before[at.body], &is = now[at.body];
        const glm::uvec3 corner = was.triangles[at.triangle];
        glm::vec3 origin = bodies[at.body].bodyFromWorld * glm::vec4(at.position, 1);
        for (int k = 0; k < 3; ++k)
            origin += at.weights[k] * (was.positions[corner[k]] - is.positions[corner[k]]);
        return Bending::occluded(at, direction, origin, 0.01f);
    }
    size_t bytes() const {
        size_t sum = 0;
        for (const One& body : bodies) sum += body.method.bytes();
        return sum;
    }
};

template <class Bodies> OcclusionMethod bending(OcclusionLabel label, int directions) {
    label.name += ", " + std::to_string(directions) + " directions";
    label.brief += " " + std::to_string(directions);
    const auto kept = std::make_shared<std::optional<Bodies>>();
    auto method = rayMethod<Bodies*>(
        std::move(label), occlusion::baselines::evenDirections(directions), OcclusionMethod::Moves::Bending,
        [=](const Scene&, const Rays&) {
            (*kept)->bend();
            return &**kept;
        },
        [](const Bodies* bodies, const Receiver& at, const glm::vec3& direction, size_t) {
            return bodies->occluded(at, direction) ? 0.0f : 1.0f;
        },
        [](const Bodies* bodies) { return bodies->bytes(); });
    method.load = [=](const Scene& scene) { kept->emplace(scene); };
    return method;
}

} // namespace

OcclusionMethod skinnedLayers(int directions) {
    return bending<Skins>({"layered fragment buffers cured, at rest through the skin", "cured, skin",
                           "layered fragments, cured", "engine/occlusion"},
                          directions);
}

OcclusionMethod rebuiltLayers(int directions) {
    return bending<Seen>({"layered fragment buffers cured, seen anew once bent by 4 pixels",
                          "cured, seen anew", "layered fragments, cured", "engine/occlusion"},
                         directions);
}

} // namespace shoal::bench
