// Owner of an object whose type is declared in a header and defined in its .cpp alone, so that users of the
// header need none of its parts. Moves and destruction need no declaration.
#pragma once

#include <memory>
#include <utility>

namespace shoal {

template <class T> using Hidden = std::unique_ptr<T, void (*)(T*)>;

template <class T, class... Arguments> Hidden<T> makeHidden(Arguments&&... arguments) {
    return {new T(std::forward<Arguments>(arguments)...), [](T* object) { delete object; }};
}

} // namespace shoal
