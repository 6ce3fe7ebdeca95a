// A simulated tracker, which sees a moving hand late and with noise, and the simulation of the hand in the
// game, in simulated time.
#pragma once

#include "input/hands/HandSourceSelector.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <functional>
#include <vector>

namespace shoal::hands::test {

using Motion = std::function<glm::dvec3(double t_s)>; // of the palm, metres

struct TrackerModel {
    double rate_Hz = 30;
    double late_s = 0.014; // as the landmarks of two hands take (tests/bench/README.md)
    double noise_m = 0;    // standard deviation of each coordinate
    int phase = 0;         // of the first picture, in eighths of its interval
};

struct Moment {
    double t_s = 0;         // of the tick
    glm::dvec3 palm{0};     // palm in the simulation
    glm::dvec3 filtered{0}; // palm as it was seen last
};

// Simulates 120 ticks and a display of 60 frames a second. hand: any pose, whose palm is moved.
inline std::vector<Moment> played(const Motion& motion, double length_s, const HandPose& hand,
                                  const TrackerModel& tracker) {
    constexpr double kFrame_s = 1 / 60.0, kTick_s = 1 / 120.0;
    const auto clockAt = [](double t_s) {
        return Clock::time_point(
            std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(t_s)));
    };
    uint32_t state = static_cast<uint32_t>(tracker.phase) + 1;
    const auto unit = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<double>(state >> 8) * 0x1p-24;
    };
    const auto gauss = [&] { // the sum of twelve has a variance of one
        double sum = -6;
        for (int i = 0; i < 12; ++i) sum += unit();
        return sum;
    };
    HandStream stream;
    DeviceHands device(DeviceTime::Live);
    HandSourceSelector selector;
    std::vector<Moment> moments;
    double picture_s = tracker.phase / 8.0 / tracker.rate_Hz;
    bool seen = false;
    for (double now_s = 0; now_s < length_s; now_s += kFrame_s) {
        for (; picture_s + tracker.late_s <= now_s; picture_s += 1 / tracker.rate_Hz) {
            HandFrame frame{.time_us = static_cast<int64_t>(picture_s * 1e6),
                            .seenAt = clockAt(picture_s),
                            .hands = {HandPose{}, hand},
                            .identity = {0, 1}};
            const glm::vec3 by =
                glm::vec3(motion(picture_s) + tracker.noise_m * glm::dvec3(gauss(), gauss(), gauss())) -
                hand.joints[kPalmJoint].position;
            for (Joint& joint : frame.hands[1].joints) joint.position += by;
            stream.push(frame);
            seen = true;
        }
        device.advance(stream, kFrame_s, clockAt(now_s));
        for (const double ago_s : {kTick_s, 0.0}) {
            std::array<HandPose, 2> hands;
            selector.tick(device, hands, static_cast<float>(ago_s), static_cast<float>(kTick_s));
            if (!seen) continue;
            moments.push_back({now_s - ago_s, hands[1].joints[kPalmJoint].position,
                               device.hand(1).pose().joints[kPalmJoint].position});
        }
    }
    return moments;
}

// Returns the delay of the motion that fits the simulation's hand best, seconds; the first half second, in
// which the hand appears, is left out.
inline double delayOf(const Motion& motion, const std::vector<Moment>& moments) {
    double least = 1e30, found = 0;
    for (double delay_s = -0.04; delay_s < 0.12; delay_s += 0.0005) {
        double off = 0;
        for (const Moment& m : moments) {
            if (m.t_s < 0.5) continue;
            const glm::dvec3 d = motion(m.t_s - delay_s) - m.palm;
            off += glm::dot(d, d);
        }
        if (off < least) least = off, found = delay_s;
    }
    return found;
}

} // namespace shoal::hands::test
