// Owner of an object whose type only the .cpp defines (pimpl), so that users of the header do not depend on
// its members. The deleter is stored, so the owning class needs no destructor or move defined in the .cpp.
#pragma once

#include <memory>
#include <utility>

namespace shoal {

template <class T> using Hidden = std::unique_ptr<T, void (*)(T*)>;

template <class T, class... Arguments> Hidden<T> makeHidden(Arguments&&... arguments) {
    return {new T(std::forward<Arguments>(arguments)...), [](T* object) { delete object; }};
}

} // namespace shoal
