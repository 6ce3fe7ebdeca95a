// Owner of an object of an incomplete type (pimpl), which only the .cpp defines, so that users of the header
// do not depend on its members. The owning class needs no declared destructor or move.
#pragma once

#include <memory>
#include <utility>

namespace shoal {

template <class T> using Hidden = std::unique_ptr<T, void (*)(T*)>;

template <class T, class... Arguments> Hidden<T> makeHidden(Arguments&&... arguments) {
    return {new T(std::forward<Arguments>(arguments)...), [](T* object) { delete object; }};
}

} // namespace shoal
