#include "tests/bench/occlusion/Rays.h"

namespace shoal::bench {

Rays::Rays(const std::vector<const Mesh*>& meshes) : meshes_(meshes) {
    const RTCDevice device = rtcNewDevice("threads=1");
    scene_ = {rtcNewScene(device), [](RTCScene scene) { rtcReleaseScene(scene); }};
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    for (const Mesh* mesh : meshes) {
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* positions = static_cast<glm::vec3*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                    mesh->positions.size()));
        std::copy(mesh->positions.begin(), mesh->positions.end(), positions);
        auto* triangles = static_cast<glm::uvec3*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                    mesh->triangles.size()));
        std::copy(mesh->triangles.begin(), mesh->triangles.end(), triangles);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_.get(), geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene_.get());
    rtcReleaseDevice(device); // the scene keeps it
}

bool Rays::occluded(const glm::vec3& o, const glm::vec3& d, float nearest) const {
    RTCRay ray{o.x, o.y, o.z, nearest, d.x, d.y, d.z, 0, 1e30f, ~0u, 0, 0};
    occlude(scene_.get(), ray);
    return ray.tfar < 0;
}

std::optional<Touch> Rays::touch(const glm::vec3& o, const glm::vec3& d, float nearest) const {
    RTCRayHit ray;
    ray.ray = {o.x, o.y, o.z, nearest, d.x, d.y, d.z, 0, 1e30f, ~0u, 0, 0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(scene_.get(), ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const glm::vec3 weights(1 - ray.hit.u - ray.hit.v, ray.hit.u, ray.hit.v);
    return Touch{ray.ray.tfar, ray.hit.geomID, ray.hit.primID, weights};
}

std::optional<occlusion::Hit> Rays::trace(glm::vec3 origin, glm::vec3 direction, float nearest) const {
    const auto at = touch(origin, direction, nearest);
    if (!at) return std::nullopt;
    const Mesh& mesh = *meshes_[at->mesh];
    const glm::uvec3 corner = mesh.triangles[at->triangle];
    const glm::vec3 normal =
        glm::normalize(at->weights.x * mesh.normals[corner.x] + at->weights.y * mesh.normals[corner.y] +
                       at->weights.z * mesh.normals[corner.z]);
    return occlusion::Hit{at->distance, glm::dot(normal, direction) > 0 ? -normal : normal};
}

static_assert(occlusion::TracesRays<Rays>);

} // namespace shoal::bench
