// Errors of light against the truth.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace shoal::bench {

// Errors over the directions of one environment, relative to the truth.
struct EnvironmentError {
    double rms = 0;   // root of sum |got - want|^2 over sum |want|^2
    double worst = 0; // largest |got - want| / |want|; where it is darker than a tenth of the root mean
                      // square, relative to that
};

inline EnvironmentError errorOf(const std::vector<glm::dvec3>& got, const std::vector<glm::dvec3>& want) {
    double off = 0, whole = 0;
    for (size_t i = 0; i < got.size(); ++i) {
        off += glm::dot(got[i] - want[i], got[i] - want[i]);
        whole += glm::dot(want[i], want[i]);
    }
    const double minimum = 0.1 * std::sqrt(whole / static_cast<double>(want.size()));
    EnvironmentError error{std::sqrt(off / whole), 0};
    for (size_t i = 0; i < got.size(); ++i)
        error.worst =
            std::max(error.worst, glm::length(got[i] - want[i]) / std::max(glm::length(want[i]), minimum));
    return error;
}

// Errors over several environments or lobes, each with the same weight however bright it is.
class Pool {
  public:
    void add(const EnvironmentError& error) {
        squares_ += error.rms * error.rms;
        worst_ = std::max(worst_, error.worst);
        ++count_;
    }
    // NaN if nothing was measured.
    double rms() const { return std::sqrt(squares_ / count_); }
    double worst() const { return count_ ? worst_ : std::nan(""); }

  private:
    double squares_ = 0, worst_ = 0;
    int count_ = 0;
};

} // namespace shoal::bench
