// Measures the errors of a method against the truth.
#pragma once

#include "Bodies.h"

#include <cstdio>

namespace shoal::occlusion {

struct Errors {
    double missed = 0, invented = 0; // shares of all rays
    double distance = 0;             // median of the error, in the sphere's radius
    double normal = 0;               // RMS angle, radians, where both hit within a tenth of the radius
    double gaps() const { return missed + invented; }
};

// Least distance of a hit, share of the sphere's radius, so that a ray does not hit where it starts.
inline constexpr float kNearest = 0.01f;

struct Question {
    Ray ray;
    std::optional<TrueHit> answer;
};

// Returns whether a place is inside the body, where one part overlaps another: it is never seen.
inline bool buried(const Body& body, const glm::vec3& place, float nearest) {
    for (const glm::vec3 out : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
        const auto first = truth(body, place, out, static_cast<double>(nearest));
        const auto back = truth(body, place, -out, static_cast<double>(nearest));
        if (first && back && first->fromBehind && back->fromBehind) return true;
    }
    return false;
}

inline std::vector<Question> ask(const Body& body, int count, bool reflected) {
    Random random(reflected ? 5 : 6);
    const Sphere sphere = boundingSphere(body.mesh());
    std::vector<Question> questions;
    while (std::ssize(questions) < count) {
        const Ray ray = reflected ? reflection(random, body) : chord(random, sphere);
        const auto answer =
            truth(body, ray.origin, ray.direction, static_cast<double>(kNearest * sphere.radius));
        if (answer && answer->fromBehind) continue;
        // Tests a place above the surface, by three rays.
        if (reflected && buried(body, ray.origin + 0.01f * sphere.radius * ray.direction, 0)) continue;
        questions.push_back({ray, answer});
    }
    return questions;
}

template <TracesRays Method>
Errors measure(const Method& method, const std::vector<Question>& questions, float radius) {
    Errors errors;
    std::vector<double> distances;
    double angles = 0;
    int compared = 0;
    for (const auto& [ray, answer] : questions) {
        const std::optional<Hit> hit = method.trace(ray.origin, ray.direction, kNearest * radius);
        if (answer && !hit) errors.missed += 1;
        if (!answer && hit) errors.invented += 1;
        if (!answer || !hit) continue;
        const double off =
            std::abs(static_cast<double>(hit->distance) - answer->distance) / static_cast<double>(radius);
        distances.push_back(off);
        if (off > 0.1) continue;
        const double angle =
            std::acos(std::min(1.0, static_cast<double>(glm::dot(hit->normal, answer->normal))));
        angles += angle * angle;
        ++compared;
    }
    const auto all = static_cast<double>(questions.size());
    errors.missed /= all, errors.invented /= all;
    if (!distances.empty()) {
        std::nth_element(distances.begin(), distances.begin() + std::ssize(distances) / 2, distances.end());
        errors.distance = distances[distances.size() / 2];
    }
    errors.normal = compared ? std::sqrt(angles / compared) : 0;
    return errors;
}

// Radiance of an environment with detail down to a tenth of a radian.
inline glm::vec3 environment(const glm::vec3& d) {
    return glm::vec3(0.5f) +
           0.25f *
               glm::vec3(std::sin(7 * d.x + 2 * d.y), std::sin(9 * d.y - d.z), std::sin(8 * d.z + 3 * d.x)) +
           0.25f * d.y;
}

// Returns the rays for a picture of the body as a mirror: the reflected eye ray of each pixel.
inline std::vector<Question> picture(const Body& body, int size) {
    const Sphere sphere = boundingSphere(body.mesh());
    const glm::vec3 back = glm::normalize(glm::vec3(0.5f, 0.7f, 0.8f));
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), back)),
                    up = glm::cross(back, right);
    const glm::vec3 eye = sphere.centre + 4 * sphere.radius * back;
    std::vector<Question> questions;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const auto across = [&](int i) {
                return (static_cast<float>(2 * i + 1) / static_cast<float>(size) - 1) * 0.26f;
            };
            const glm::vec3 look = glm::normalize(across(x) * right + across(y) * up - back);
            const auto seen = truth(body, eye, look, 0);
            if (!seen) continue;
            const glm::vec3 at = eye + static_cast<float>(seen->distance) * look;
            const glm::vec3 out = glm::normalize(glm::reflect(look, seen->normal));
            const auto answer = truth(body, at, out, static_cast<double>(kNearest * sphere.radius));
            if (!answer || !answer->fromBehind) questions.push_back({{at, out}, answer});
        }
    return questions;
}

// Returns the RMS error of that picture with one bounce off the body itself.
template <TracesRays Method>
double pictureError(const Method& method, const std::vector<Question>& questions, float radius) {
    double sum = 0;
    for (const auto& [ray, answer] : questions) {
        const auto colour = [&](bool hits, const glm::vec3& normal) {
            return environment(hits ? glm::reflect(ray.direction, normal) : ray.direction);
        };
        const auto hit = method.trace(ray.origin, ray.direction, kNearest * radius);
        const glm::vec3 off = colour(hit.has_value(), hit ? hit->normal : glm::vec3(0)) -
                              colour(answer.has_value(), answer ? answer->normal : glm::vec3(0));
        sum += static_cast<double>(glm::dot(off, off)) / 3;
    }
    return std::sqrt(sum / static_cast<double>(questions.size()));
}

} // namespace shoal::occlusion
