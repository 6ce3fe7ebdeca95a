// Hands as the service sends them: real recordings where the reference data is, and made-up ones.
#pragma once

#include "engine/core/Files.h"
#include "tests/TestPaths.h"
#include "tests/TestRig.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace shoal::hands::test {

using nlohmann::json;

// Returns data/hands/leap/NAME.json below $SHOAL_SHARED or ../shared beside the sources; it may not exist.
inline Path sharedRecording(const std::string& name) {
    return tests::sharedDataFolder() / "hands" / "leap" / (name + ".json");
}

// A packed row after its schema: a key, or {key: [schema of each element]}.
inline json unpacked(const json& schema, const json& row) {
    json out = json::object();
    for (size_t i = 0; i < schema.size() && i < row.size(); ++i) {
        if (schema[i].is_string()) {
            out[schema[i].get<std::string>()] = row[i];
            continue;
        }
        const std::string& key = schema[i].begin().key();
        const json& inner = schema[i].begin().value();
        const bool list = inner.size() == 1 && inner[0].is_array();
        if (!list) {
            out[key] = unpacked(inner, row[i]);
            continue;
        }
        out[key] = json::array();
        for (const json& element : row[i]) out[key].push_back(unpacked(inner[0], element));
    }
    return out;
}

// Returns the messages of a recording as they went over the socket; rows packed by a schema are unpacked.
inline std::vector<std::string> readRecordingMessages(const Path& file) {
    const auto text = readText(file, 64u << 20);
    if (!text) return {};
    const json recording = json::parse(*text);
    const json& frames = recording["frames"];
    std::vector<std::string> messages;
    for (size_t i = 0; i < frames.size(); ++i) {
        if (frames[i].is_object())
            messages.push_back(frames[i].dump());
        else if (i > 0)
            messages.push_back(unpacked(frames[0], frames[i]).dump());
    }
    return messages;
}

inline json millimetres(const glm::vec3& v) { return {v.x * 1e3f, v.y * 1e3f, v.z * 1e3f}; }
inline json unit(const glm::vec3& v) { return {v.x, v.y, v.z}; }

// One frame of a hand posed by the rig, in the Leap's desk frame and millimetres, as a service of that
// protocol version would send it: joints from 5 on, everything at 6, mere fingertips before 5.
struct MadeHand {
    Side side = Side::Right;
    int64_t id = 1;
    HandPose pose;                    // device's frame, metres
    std::optional<glm::vec3> elbow{}; // device's frame, metres; sent at 6
};
inline std::string madeFrame(int version, int64_t id, int64_t time_us, const std::vector<MadeHand>& hands) {
    json frame = {
        {"id", id}, {"timestamp", time_us}, {"hands", json::array()}, {"pointables", json::array()}};
    if (version >= 4) frame["currentFrameRate"] = 100.0;
    for (const MadeHand& made : hands) {
        const auto& joints = made.pose.joints;
        const glm::quat turn = joints[0].orientation;
        json hand = {{"id", made.id},
                     {"palmPosition", millimetres(joints[0].position)},
                     {"palmNormal", unit(turn * glm::vec3(0, -1, 0))},
                     {"direction", unit(turn * glm::vec3(0, 0, -1))},
                     {"palmVelocity", {0, 0, 0}}};
        if (version >= 5) {
            hand["type"] = made.side == Side::Left ? "left" : "right";
            hand["grabStrength"] = made.pose.grip;
            hand["pinchStrength"] = made.pose.pinch;
            hand["confidence"] = 1.0;
        }
        if (version >= 6) {
            hand["wrist"] = millimetres(joints[1].position);
            hand["palmWidth"] = 85.0;
            if (made.elbow) hand["elbow"] = millimetres(*made.elbow);
            hand["armBasis"] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        }
        frame["hands"].push_back(hand);
        for (int f = 0; f < kFingerCount; ++f) {
            const int foot = f == 0 ? 2 : 1 + 5 * f, tip = f == 0 ? 5 : foot + 4;
            const auto at = [&](int joint) {
                return millimetres(joints[static_cast<size_t>(joint)].position);
            };
            json finger = {{"id", made.id * 10 + f},
                           {"handId", made.id},
                           {"tool", false},
                           {"length", 60},
                           {"tipPosition", at(tip)}};
            if (version >= 5) {
                finger["type"] = f;
                finger["mcpPosition"] = at(f == 0 ? foot : foot + 1);
                finger["pipPosition"] = at(f == 0 ? foot + 1 : foot + 2);
                finger["dipPosition"] = at(tip - 1);
            }
            if (version >= 6) {
                finger["carpPosition"] = at(foot);
                finger["btipPosition"] = at(tip);
            }
            frame["pointables"].push_back(finger);
        }
    }
    return frame.dump();
}

// Returns a right hand over the device that closes, stays closed and opens again, 100 frames a second.
inline std::vector<MadeHand> closingHand(const HandRig& rig, int frames) {
    std::vector<MadeHand> hands;
    for (int i = 0; i < frames; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(std::max(frames - 1, 1));
        const float closed = std::clamp(std::min((t - 0.1f) / 0.1f, (0.95f - t) / 0.05f), 0.0f, 1.0f);
        hands.push_back({.pose = rig.pose(Side::Right, tests::shape(0.05f + 0.9f * closed),
                                          {{0.06f, 0.19f, 0.09f}, {1, 0, 0, 0}})});
    }
    return hands;
}
inline std::vector<std::string> closingRecording(const HandRig& rig, int version, int frames) {
    std::vector<std::string> messages;
    for (const MadeHand& made : closingHand(rig, frames)) {
        const auto i = static_cast<int64_t>(messages.size());
        messages.push_back(madeFrame(version, i, i * 10000, {made}));
    }
    return messages;
}

} // namespace shoal::hands::test
