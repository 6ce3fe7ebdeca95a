// Hash of simulation state, generated from the same list of fields as the state itself. A state struct has a
// member fields() that ties all its fields; one that forgets a field does not compile.
#pragma once

#include "engine/core/Hash.h"
#include "engine/core/Random.h"
#include "engine/physics/ContactWorld.h"
#include "engine/physics/Grip.h"
#include "engine/scene/HandPose.h"

#include <array>
#include <tuple>
#include <utility>
#include <vector>

namespace shoal::game {

// Returns the number of elements of an aggregate: as many initialisers as it accepts.
struct AnyField {
    template <class T> operator T() const;
};
template <class T, size_t... I> consteval bool acceptsFields(std::index_sequence<I...>) {
    return requires { T{(static_cast<void>(I), AnyField{})...}; };
}
template <class T, size_t N = 1> consteval size_t fieldCount() {
    if constexpr (acceptsFields<T>(std::make_index_sequence<N>{}))
        return fieldCount<T, N + 1>();
    else
        return N - 1;
}

// The fields of the engine's types that are part of the state.
inline auto fieldsOf(const glm::vec3& v) { return std::tie(v.x, v.y, v.z); }
inline auto fieldsOf(const glm::quat& q) { return std::tie(q.w, q.x, q.y, q.z); }
inline auto fieldsOf(const hands::Joint& joint) {
    return std::tie(joint.position, joint.orientation, joint.radius);
}
inline auto fieldsOf(const hands::HandPose& hand) {
    return std::tie(hand.tracked, hand.confidence, hand.grip, hand.pinch, hand.solid, hand.time_us,
                    hand.joints);
}
inline auto fieldsOf(const physics::Press& press) { return std::tie(press.normal, press.force_N); }
inline auto fieldsOf(const physics::Contact& c) {
    return std::tie(c.body, c.group, c.tag, c.fresh, c.lasting, c.point, c.normal, c.depth, c.closingSpeed,
                    c.moverVelocity, c.time);
}
template <class T>
requires requires(const T& state) { state.fields(); }
auto fieldsOf(const T& state) { return state.fields(); }

template <class T> void addState(Hash& hash, const T& value);
inline void addState(Hash& hash, const Random& random) { hash.add(random.state()); }
template <class T> void addState(Hash& hash, const std::vector<T>& values) {
    hash.add(values.size());
    for (const T& value : values) addState(hash, value);
}
template <class T, size_t N> void addState(Hash& hash, const std::array<T, N>& values) {
    for (const T& value : values) addState(hash, value);
}
template <class T> void addState(Hash& hash, const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
        hash.add(value);
    } else {
        const auto fields = fieldsOf(value);
        if constexpr (std::is_aggregate_v<T>)
            static_assert(std::tuple_size_v<decltype(fields)> == fieldCount<T>(), "a field is missing");
        std::apply([&](const auto&... field) { (addState(hash, field), ...); }, fields);
    }
}

} // namespace shoal::game
