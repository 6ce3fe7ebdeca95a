// How much of what a surface receives an ellipsoid takes away, and where from: closed forms. Twins of
// shaders/occlusion/Bodies.glsl; templates, so that tests can ask in double precision.
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace shoal::occlusion {

template <class T> struct Ellipsoid {
    glm::vec<3, T> centre{0};
    glm::mat<3, 3, T> worldFromAxes{1}; // columns: its axes, unit length
    glm::vec<3, T> semiAxes{1};         // metres
};

// A cone of directions, as a round cap that sends as much to a surface that faces it.
template <class T> struct Cap {
    glm::vec<3, T> towards{0, 0, 1}; // unit
    T share = 0; // sin^2 of the half angle: of the cosine-weighted hemisphere, if faced; 0 to 1
};

// The directions in which a ray from p meets the ellipsoid: an elliptic cone. Its axis is the normal of the
// confocal ellipsoid through p, and with that one's coordinate d, the largest root of sum m_i^2 / (a_i^2 + d)
// = 1 (m: from the centre, in axes), the cone's tangents are those of the eigenvalues of m m^T - diag(a^2),
// whose characteristic polynomial gives the share without the other two: tan1 tan2 / sqrt((1 + tan1^2) (1 +
// tan2^2)), the vector form factor of an elliptic cone (e.g. Heitz 2017, "Analytical Calculation of the Solid
// Angle Subtended by an Arbitrarily Positioned Ellipsoid to a Point Source", for its silhouette). Within the
// ellipsoid: the half space.
template <class T> Cap<T> capOf(const Ellipsoid<T>& ellipsoid, const glm::vec<3, T>& p) {
    using Vec = glm::vec<3, T>;
    const Vec b = ellipsoid.semiAxes * ellipsoid.semiAxes;
    const Vec m = (p - ellipsoid.centre) * ellipsoid.worldFromAxes; // the transpose's product
    const Vec m2 = glm::max(m * m, T(1e-6) * b);
    const T outside = glm::dot(m2, T(1) / b) - T(1);
    // Newton's method on 1 / sum, nearly straight; from below, by Jensen's inequality.
    const T square = m2.x + m2.y + m2.z;
    T d = glm::max(square - glm::dot(m2, b) / square, T(0));
    for (int step = 0; step < 3; ++step) {
        const Vec r = T(1) / (b + d);
        const T sum = glm::dot(m2, r);
        d = glm::max(d + sum * (sum - T(1)) / glm::dot(m2, r * r), T(0));
    }
    const Vec c = b + d;
    const Vec normal = m / c;
    const T length2 = glm::dot(m2, T(1) / (c * c));
    const T share2 = outside * (b.x / c.x) * (b.y / c.y) * (b.z / c.z) / glm::max(d * length2, T(1e-30));
    Cap<T> cap;
    cap.share = outside > T(1e-4) ? glm::min(std::sqrt(share2), T(0.9999)) : T(0.9999);
    cap.towards = -(ellipsoid.worldFromAxes * normal) / std::sqrt(glm::dot(normal, normal));
    return cap;
}

// Of a surface's cosine-weighted hemisphere, what a cap takes that may dip below the horizon. cosine: of
// normal and cap. Within 0.003 of the cap's share up to half angles of 45 degrees, 0.014 up to 90.
template <class T> T clippedShare(T share, T cosine) {
    const T s = std::sqrt(share), k = std::sqrt(T(1) - share);
    const T t = glm::clamp(cosine / glm::max(s, T(1e-6)), T(-1), T(1));
    // A half sunk cap's (angle - s k) / (pi s^3), in powers of k.
    const T half = T(0.5) + k * (T(-0.60262) + k * (T(0.49891) + k * T(-0.18620)));
    const T dipping = s * share * (t * T(0.5) + half + (T(0.5) - half) * t * t);
    return cosine >= s ? share * cosine : dipping;
}

// The first moment of what clippedShare() weighs, for each unit of it: its mean direction, shorter than 1 the
// wider the cap. Exact above the horizon (second moments of a cap); below, the cosine is held at the sine.
template <class T> glm::vec<3, T> meanDirection(const Cap<T>& cap, const glm::vec<3, T>& normal, T cosine) {
    const T s = std::sqrt(cap.share), k = std::sqrt(T(1) - cap.share);
    const T lift = (T(1) - k) * (T(2) + k) / (T(3) * (T(1) + k));
    return k * cap.towards + lift / glm::max(glm::max(cosine, s), T(1e-6)) * normal;
}

// How much of a small round lamp the ellipsoid hides from p, 0 to 1. capShare: of capOf(). The edge is where
// the ray to the lamp's centre grazes: where it passes nearest, in the space in which the ellipsoid is a
// ball. A ray that leaves has passed it so much the further: a body's skin lies now outside, now within its
// own ellipsoids, and looks out of them all the same.
template <class T>
T coverage(const Ellipsoid<T>& ellipsoid, const glm::vec<3, T>& p, const glm::vec<3, T>& lampTowards,
           T lampSine, T capShare) {
    using Vec = glm::vec<3, T>;
    const Vec m = ((p - ellipsoid.centre) * ellipsoid.worldFromAxes) / ellipsoid.semiAxes;
    const Vec d = (lampTowards * ellipsoid.worldFromAxes) / ellipsoid.semiAxes;
    const T along = -glm::dot(m, d) / glm::dot(d, d); // metres to the nearest place
    const T ahead = glm::max(along, T(0));
    const Vec nearest = m + ahead * d;
    const T far = glm::length(nearest);
    const T aside = // metres outside
        glm::length(nearest * ellipsoid.semiAxes) * (T(1) - T(1) / glm::max(far, T(1e-3))) + (ahead - along);
    const T sine = aside / std::sqrt(aside * aside + ahead * ahead + T(1e-12));
    const T x = glm::clamp(T(0.5) - T(0.5) * sine / lampSine, T(0), T(1));
    return x * x * (T(3) - T(2) * x) * glm::min(T(1), capShare / (lampSine * lampSine));
}

// Of a round lamp that stands for the GGX lobe of this perceptual roughness: reflection doubles the angle at
// which half of the microfacets' normals lie, whose tangent is alpha (Walter et al. 2007, eq. 35).
template <class T> T lobeSine(T roughness) {
    const T alpha = glm::max(roughness * roughness, T(0.02));
    return T(2) * alpha / (T(1) + alpha * alpha);
}

} // namespace shoal::occlusion
