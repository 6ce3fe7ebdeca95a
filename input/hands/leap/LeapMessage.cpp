#include "input/hands/leap/LeapMessage.h"

#include "engine/core/Number.h"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <span>

namespace shoal::hands {

using nlohmann::json;

constexpr size_t kMaxHands = 8, kMaxPointables = 64;
constexpr double kMetresFromMillimetres = 1e-3;
constexpr double kFarthest_m = 5; // far beyond the device's range, which is below a metre

// Returns JSON's null if there is no such member, or if `object` is not an object.
static const json& member(const json& object, const char* key) {
    static const json none;
    const auto found = object.find(key);
    return found == object.end() ? none : *found;
}

// Returns the first entries of an array; none if the member is not an array.
static std::span<const json> entries(const json& object, const char* key, size_t most) {
    const auto* array = member(object, key).get_ptr<const json::array_t*>();
    return array ? std::span(*array).first(std::min(array->size(), most)) : std::span<const json>();
}

static std::optional<double> number(const json& object, const char* key) {
    const json& value = member(object, key);
    return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

static std::optional<int64_t> whole(const json& object, const char* key) {
    const auto v = number(object, key);
    if (!v || !isWithin(*v, -9e15, 9e15)) return std::nullopt; // beyond 2^53 doubles skip numbers
    return static_cast<int64_t>(*v);
}

static std::optional<float> share(const json& object, const char* key) {
    const auto v = number(object, key);
    return v ? std::optional(static_cast<float>(std::clamp(*v, 0.0, 1.0))) : std::nullopt;
}

static bool yes(const json& object, const char* key) { return member(object, key) == true; }

static std::string words(const json& object, const char* key) {
    const json& value = member(object, key);
    return value.is_string() ? value.get<std::string>().substr(0, 64) : "";
}

static std::optional<glm::vec3> triple(const json& object, const char* key, double scale, double maximum) {
    const std::span<const json> array = entries(object, key, 4); // one more than it may have
    if (array.size() != 3) return std::nullopt;
    glm::vec3 v(0);
    for (int i = 0; i < 3; ++i) {
        if (!array[i].is_number()) return std::nullopt;
        const double given = array[i].get<double>() * scale;
        if (!isWithin(given, -maximum, maximum)) return std::nullopt;
        v[i] = static_cast<float>(given);
    }
    return v;
}

static std::optional<glm::vec3> point(const json& object, const char* key) {
    return triple(object, key, kMetresFromMillimetres, kFarthest_m);
}

static std::optional<PartialHand> readHand(const json& from) {
    const auto identity = whole(from, "id");
    const auto palm = point(from, "palmPosition");
    const auto normal = triple(from, "palmNormal", 1, 10), direction = triple(from, "direction", 1, 10);
    if (!identity || !palm || !normal || !direction) return std::nullopt;
    const float sine = glm::length(glm::cross(glm::normalize(*normal), glm::normalize(*direction)));
    if (!(sine > 4e-3f)) return std::nullopt; // NaN too
    PartialHand hand{.identity = *identity, .palm = *palm, .normal = *normal, .direction = *direction};
    const std::string type = words(from, "type");
    if (type == "left") hand.side = Side::Left;
    if (type == "right") hand.side = Side::Right;
    hand.joints[kWristJoint] = point(from, "wrist");
    hand.elbow = point(from, "elbow");
    hand.grip = share(from, "grabStrength");
    hand.pinch = share(from, "pinchStrength");
    hand.confidence = share(from, "confidence");
    return hand;
}

// Adds a pointable's joints to its hand; ignores tools. The thumb's metacarpal has no length in the service's
// model: what it calls carp and mcp is one point, our metacarpal.
static void readPointable(const json& from, std::vector<PartialHand>& hands) {
    if (yes(from, "tool")) return;
    const auto hand = std::ranges::find(hands, whole(from, "handId"), &PartialHand::identity);
    if (hand == hands.end()) return;
    const auto bone = point(from, "btipPosition"), tip = bone ? bone : point(from, "tipPosition");
    const auto mcp = point(from, "mcpPosition"), pip = point(from, "pipPosition"),
               dip = point(from, "dipPosition");
    auto type = whole(from, "type");
    // Older services number the fingers of a hand: the last digit tells the finger.
    if (!type)
        if (const auto id = whole(from, "id")) type = *id - 10 * hand->identity;
    if (!type || *type < 0 || *type >= kFingerCount) return;
    const FingerJoints& finger = kFingerJoints[*type];
    JointPositions& joints = hand->joints;
    if (*type != 0) joints[finger.metacarpal] = point(from, "carpPosition");
    joints[finger.tip - 3] = mcp;
    joints[finger.tip - 2] = pip;
    joints[finger.tip - 1] = dip;
    joints[finger.tip] = tip;
}

static bool lacksJoint(const PartialHand& hand) {
    for (const FingerJoints& finger : kFingerJoints)
        for (int i = finger.tip - 3; i <= finger.tip; ++i)
            if (!hand.joints[i]) return true;
    return false;
}

static LeapFrame readFrame(const json& from) {
    LeapFrame frame;
    frame.time_us = whole(from, "timestamp");
    for (const json& entry : entries(from, "hands", kMaxHands))
        if (auto hand = readHand(entry)) frame.hands.push_back(*hand);
    for (const json& entry : entries(from, "pointables", kMaxPointables)) readPointable(entry, frame.hands);
    std::erase_if(frame.hands, lacksJoint);
    return frame;
}

// Returns the unit vector from wrist to elbow, device's frame; 0 without an elbow at an arm's distance.
static glm::vec3 towardsElbow(const PartialHand& hand, glm::vec3 wrist) {
    constexpr float kShortest_m = 0.1f, kLongest_m = 0.5f;
    if (!hand.elbow) return glm::vec3(0);
    const glm::vec3 forearm = *hand.elbow - wrist;
    const float length = glm::length(forearm);
    return length > kShortest_m && length < kLongest_m ? forearm / length : glm::vec3(0);
}

Result<LeapMessage> readLeapMessage(std::string_view text) {
    const Error tooLarge{"", "is larger or deeper than any frame of hands"};
    if (text.size() > kLeapMessageBytes || !exceededBound(text, kLeapMessageBounds).empty()) return tooLarge;
    const json message = json::parse(text, nullptr, false);
    if (!message.is_object()) return Error{"", "is no JSON object"};
    if (message.contains("hands") || message.contains("pointables") || message.contains("timestamp"))
        return LeapMessage(readFrame(message));
    const json &event = member(message, "event"), &state = member(event, "state");
    if (words(event, "type") == "deviceEvent" && state.is_object())
        return LeapMessage(LeapDevice{yes(state, "attached"), yes(state, "streaming"), words(state, "type")});
    return LeapMessage();
}

// Old services do not tell the side: then the hand's last side or its place decides.
Side LeapTracks::sideOf(const PartialHand& hand, const LeapFrame& seen) const {
    if (hand.side) return *hand.side;
    if (hand.identity == identity_[0]) return Side::Left;
    if (hand.identity == identity_[1]) return Side::Right;
    for (const PartialHand& other : seen.hands)
        if (other.identity != hand.identity) return hand.palm.x < other.palm.x ? Side::Left : Side::Right;
    const float viewerX = (placement_.mount().viewerFromDevice * hand.palm).x;
    return viewerX < 0 ? Side::Left : Side::Right;
}

HandFrame LeapTracks::frame(const LeapFrame& seen, int64_t time_us) {
    HandFrame frame;
    frame.time_us = time_us;
    std::array<int64_t, 2> found{-1, -1};
    for (PartialHand hand : seen.hands) {
        hand.side = sideOf(hand, seen);
        if (!agreesWithJoints(hand)) continue;
        const Side side = *hand.side;
        const size_t i = side == Side::Left ? 0 : 1;
        // Among two hands of the same side, the one that was there before wins, then the surer one.
        const bool known = hand.identity == identity_[i];
        if (frame.hands[i].tracked && (found[i] == identity_[i] ||
                                       (!known && hand.confidence.value_or(1) <= frame.hands[i].confidence)))
            continue;
        frame.hands[i] = completer_.complete(hand, side);
        frame.hands[i].time_us = time_us;
        frame.towardsElbow[i] = placement_.mount().viewerFromDevice *
                                towardsElbow(hand, frame.hands[i].joints[kWristJoint].position);
        found[i] = hand.identity;
        frame.identity[i] = (connection_ << 40) + hand.identity;
    }
    identity_ = found;
    placement_.apply(frame.hands, time_us);
    return frame;
}

} // namespace shoal::hands
