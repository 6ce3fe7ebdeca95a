#include "content/make/models/occlusion/FitToHidden.h"

#include "content/make/models/occlusion/Bvh.h"
#include "content/make/models/occlusion/Silhouettes.h"
#include "engine/core/Random.h"
#include "engine/occlusion/Directions.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <thread>

namespace shoal::make {

namespace {

using occlusion::Ellipsoid;
using occlusion::kAxisCount;

constexpr size_t kEnds = 2 * kAxisCount;
constexpr int kRays = 6;          // towards an axis' end, spread over that end's share of the sphere
constexpr float kEnclosed = 0.8f; // hidden share of the sphere above which a place is never seen
constexpr int kSweeps = 4, kSweepsAlike = 2;  // more sweeps fit these poses alone, and points pop more often
constexpr float kStep = 0.06f, kFiner = 0.7f; // share of a semi-axis; radians
constexpr float kAlong = 0.5f;                // share of a semi-axis by which a step of one moves a centre

Ellipsoid moved(const Ellipsoid& rest, const glm::mat4& rigid) {
    return {glm::vec3(rigid * glm::vec4(rest.centre, 1)), glm::mat3(rigid) * rest.worldFromAxes,
            rest.semiAxes};
}

// Moves a shape along one of its three axes, scales it along the axis, or turns it around the axis.
Ellipsoid stepped(Ellipsoid shape, int way, float step) {
    const int axis = way % 3;
    if (way < 3)
        shape.centre += kAlong * step * shape.semiAxes[axis] * shape.worldFromAxes[axis];
    else if (way < 6)
        shape.semiAxes[axis] *= std::exp(step);
    else {
        glm::vec3 around(0);
        around[axis] = 1;
        shape.worldFromAxes = shape.worldFromAxes * glm::mat3(glm::rotate(glm::mat4(1), step, around));
    }
    return shape;
}

// Hidden share by place and end: ends above a plane, then those below.
using Hides = std::vector<float>;

void hides(const Ellipsoid& shape, const Around& pose, Hides& out) {
    const occlusion::Occluder alone{shape, 1, {}};
    out.resize(pose.places.size() * kEnds);
    for (size_t i = 0; i < pose.places.size(); ++i)
        for (size_t half = 0; half < 2; ++half)
            std::ranges::copy(
                occlusion::axisOcclusion(pose.places[i], {0, half == 0 ? 1 : -1, 0}, {&alone, 1}),
                out.begin() + static_cast<std::ptrdiff_t>(i * kEnds + half * kAxisCount));
}

glm::vec3 endOf(size_t end) {
    const glm::vec3& axis = occlusion::kAxes[end % kAxisCount];
    return (axis.y < 0) == (end < kAxisCount) ? -axis : axis;
}

// Searches over several poses at once.
class Search {
  public:
    Search(std::vector<occlusion::BodyPart>& parts, const std::vector<Around>& poses)
        : parts_(parts), poses_(poses), hides_(poses.size(), std::vector<Hides>(parts.size())),
          open_(poses.size()), tried_(poses.size()), off_(poses.size()) {
        for (size_t pose = 0; pose < poses.size(); ++pose) {
            for (size_t k = 0; k < parts.size(); ++k)
                hides(moved(parts[k].atRest, poses[pose].posedFromRest[parts[k].joint]), poses[pose],
                      hides_[pose][k]);
            places_ += poses[pose].places.size();
        }
    }

    double missed() {
        leaveOut(parts_.size());
        each([&](size_t pose) { off_[pose] = off(pose, nullptr); });
        return mean();
    }

    void sweep(float step) {
        for (size_t k = 0; k < parts_.size(); ++k) {
            leaveOut(k);
            each([&](size_t pose) { off_[pose] = off(pose, &hides_[pose][k]); });
            double minimum = mean();
            for (int way = 0; way < 9; ++way)
                for (const float side : {1.0f, -1.0f}) {
                    const Ellipsoid shape = stepped(parts_[k].atRest, way, side * step);
                    each([&](size_t pose) {
                        hides(moved(shape, poses_[pose].posedFromRest[parts_[k].joint]), poses_[pose],
                              tried_[pose]);
                        off_[pose] = off(pose, &tried_[pose]);
                    });
                    if (mean() >= minimum) continue;
                    minimum = mean();
                    parts_[k].atRest = shape;
                    for (size_t pose = 0; pose < poses_.size(); ++pose)
                        std::swap(hides_[pose][k], tried_[pose]);
                    break;
                }
        }
    }

  private:
    void each(const std::function<void(size_t)>& work) const {
        std::vector<std::jthread> helpers;
        for (size_t pose = 1; pose < poses_.size(); ++pose) helpers.emplace_back([&, pose] { work(pose); });
        if (!poses_.empty()) work(0);
    }

    // Computes the shares that all parts but this one leave open.
    void leaveOut(size_t part) {
        each([&](size_t pose) {
            open_[pose].assign(poses_[pose].places.size() * kEnds, 1);
            for (size_t k = 0; k < parts_.size(); ++k)
                for (size_t i = 0; i < open_[pose].size() && k != part; ++i)
                    open_[pose][i] *= 1 - hides_[pose][k][i];
        });
    }

    double off(size_t pose, const Hides* part) const {
        double sum = 0;
        for (size_t i = 0; i < open_[pose].size(); ++i) {
            const float open = open_[pose][i] * (part ? 1 - (*part)[i] : 1);
            const float miss = 1 - open - poses_[pose].hidden[i / kEnds][i % kEnds];
            sum += static_cast<double>(miss * miss);
        }
        return sum;
    }

    double mean() const {
        double sum = 0;
        for (const double each : off_) sum += each;
        return sum / static_cast<double>(std::max<size_t>(1, places_) * kEnds);
    }

    std::vector<occlusion::BodyPart>& parts_;
    const std::vector<Around>& poses_;
    std::vector<std::vector<Hides>> hides_; // [pose][part]
    std::vector<Hides> open_, tried_;       // [pose]
    std::vector<double> off_;               // [pose]
    size_t places_ = 0;
};

} // namespace

Around lookAround(const scene::Surface& posed, std::vector<glm::mat4> posedFromRest, const Shell& shell,
                  int count, uint64_t seed) {
    Around around{std::move(posedFromRest), {}, {}};
    const occlusion::Bvh bvh(posed.positions, posed.indices);
    std::vector<float> areas;
    float all = 0;
    for (size_t i = 0; i + 2 < posed.indices.size(); i += 3) {
        const glm::vec3& a = posed.positions[posed.indices[i]];
        all += glm::length(
            glm::cross(posed.positions[posed.indices[i + 1]] - a, posed.positions[posed.indices[i + 2]] - a));
        areas.push_back(all);
    }
    const float sine = std::sqrt(1 - (1 - 1.0f / kAxisCount) * (1 - 1.0f / kAxisCount));
    Random random(seed);
    for (int k = 0; k < count && all > 0; ++k) {
        const auto triangle = std::ranges::upper_bound(areas, all * random.unit()) - areas.begin();
        const uint32_t* corner =
            &posed.indices[3 * std::min(static_cast<size_t>(triangle), areas.size() - 1)];
        const float u = std::sqrt(random.unit()), v = random.unit();
        const glm::vec3 shares(1 - u, u * (1 - v), u * v);
        glm::vec3 at(0), normal(0);
        for (int i = 0; i < 3; ++i)
            at += shares[i] * posed.positions[corner[i]], normal += shares[i] * posed.normals[corner[i]];
        normal = glm::normalize(normal);
        const float height = random.between(shell.nearest, shell.farthest);
        if (bvh.blocked(at, normal, 0.1f * shell.nearest, height)) continue;
        at += height * normal;
        std::array<float, kEnds> hidden{};
        float sum = 0;
        for (size_t end = 0; end < kEnds; ++end) {
            const glm::mat3 frame = occlusion::frameAround(endOf(end));
            for (int ray = 0; ray < kRays; ++ray) {
                const float r = sine * std::sqrt((static_cast<float>(ray) + 0.5f) / kRays);
                const auto turn = static_cast<float>(
                    std::fmod((ray + k) * occlusion::kGoldenAngle + static_cast<double>(end), 6.283));
                const glm::vec3 d(r * std::cos(turn), r * std::sin(turn), std::sqrt(1 - r * r));
                hidden[end] += bvh.blocked(at, frame * d, 0, INFINITY) ? 1.0f / kRays : 0.0f;
            }
            sum += hidden[end];
        }
        if (sum > kEnclosed * kEnds) continue;
        around.places.push_back(at);
        around.hidden.push_back(hidden);
    }
    return around;
}

double missed(const std::vector<occlusion::BodyPart>& parts, const std::vector<Around>& poses) {
    std::vector<occlusion::BodyPart> same = parts;
    return Search(same, poses).missed();
}

void fitToHidden(std::vector<occlusion::BodyPart>& parts, const std::vector<Around>& poses) {
    Search search(parts, poses);
    float step = kStep;
    for (int sweep = 1; sweep <= kSweeps; ++sweep) {
        search.sweep(step);
        if (sweep % kSweepsAlike == 0) step *= kFiner;
    }
}

} // namespace shoal::make
