// Owns an object of a type that a header declares and its .cpp alone defines, so that who includes the header
// needs none of its parts. Moves and destruction need no declaration.
#pragma once

#include <memory>
#include <utility>

namespace shoal {

template <class T> using Hidden = std::unique_ptr<T, void (*)(T*)>;

template <class T, class... Arguments> Hidden<T> makeHidden(Arguments&&... arguments) {
    return {new T(std::forward<Arguments>(arguments)...), [](T* object) { delete object; }};
}

} // namespace shoal
