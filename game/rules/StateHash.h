// Hash of simulation state over all fields in the order of their declarations. A struct with a base class
// has a member fields() that ties the base and its own fields; if it omits a field, it does not compile.
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

// fieldCount() returns the number of an aggregate's elements: the most initialisers that it accepts.
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

inline auto fieldsOf(const glm::vec3& v) { return std::tie(v.x, v.y, v.z); }
inline auto fieldsOf(const glm::quat& q) { return std::tie(q.w, q.x, q.y, q.z); }
template <class T>
requires requires(const T& state) { state.fields(); }
auto fieldsOf(const T& state) { return state.fields(); }

// Ties the fields of an aggregate, for the numbers of fields that occur in the state.
template <class T> auto fieldsOf(const T& state) {
#define SHOAL_TIE(number, ...)                                                                               \
    if constexpr (fieldCount<T>() == number) {                                                               \
        const auto& [__VA_ARGS__] = state;                                                                   \
        return std::tie(__VA_ARGS__);                                                                        \
    }
    SHOAL_TIE(2, a, b);
    SHOAL_TIE(3, a, b, c);
    SHOAL_TIE(4, a, b, c, d);
    SHOAL_TIE(5, a, b, c, d, e);
    SHOAL_TIE(6, a, b, c, d, e, f);
    SHOAL_TIE(7, a, b, c, d, e, f, g);
    SHOAL_TIE(8, a, b, c, d, e, f, g, h);
    SHOAL_TIE(9, a, b, c, d, e, f, g, h, i);
    SHOAL_TIE(11, a, b, c, d, e, f, g, h, i, j, k);
    SHOAL_TIE(12, a, b, c, d, e, f, g, h, i, j, k, l);
    SHOAL_TIE(15, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
    SHOAL_TIE(23, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w);
#undef SHOAL_TIE
}

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
