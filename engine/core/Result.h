// A value, or the reason why there is none: for files, devices and video, which can fail although the program
// has no mistake. Broken contracts assert instead.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace shoal {

struct Error {
    std::string path;   // the file or device; may be empty
    std::string reason; // what is wrong and, where it helps, what to do; no full stop, no line break

    // "path: reason", as shown to a person.
    std::string message() const { return path.empty() ? reason : path + ": " + reason; }
};

// Success without a value.
struct Done {};

template <class T> class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    bool ok() const { return state_.index() == 0; }
    explicit operator bool() const { return ok(); }

    T& value() & { return assert(ok()), *std::get_if<0>(&state_); }
    const T& value() const& { return assert(ok()), *std::get_if<0>(&state_); }
    T&& value() && { return assert(ok()), std::move(*std::get_if<0>(&state_)); }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    const Error& error() const { return assert(!ok()), *std::get_if<1>(&state_); }

    // Moves the value, if there is one, to a variable or an optional.
    template <class Place> Result<Done> moveTo(Place& place) && {
        if (!ok()) return error();
        place = std::move(**this);
        return Done{};
    }

  private:
    std::variant<T, Error> state_;
};

using Status = Result<Done>;

} // namespace shoal
