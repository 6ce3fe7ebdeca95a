// What one loadModel carries from step to step: limits, what has been spent of them, warnings. Private to
// this room.
#pragma once

#include "engine/core/Files.h"
#include "engine/scene/LoadModel.h"

#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

namespace shoal::scene {

// A fault in the file. It travels as an exception to loadModel, which turns it into an Error: the loader is
// some hundred checks deep, and each would otherwise be written twice. It never leaves this room.
class Fault : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

template <class... Parts> std::string text(const Parts&... parts) {
    std::ostringstream stream;
    (stream << ... << parts);
    return stream.str();
}

template <class... Parts> [[noreturn]] void fault(const Parts&... parts) { throw Fault(text(parts...)); }

// A name out of the file, fit to be shown: cut short, control characters replaced.
std::string quoted(const std::string& untrusted, size_t maxLength = 60);

// "accessors[3]"
inline std::string element(const char* array, int64_t index) { return text(array, "[", index, "]"); }

struct Loading {
    Path file;
    LoadLimits limits;
    std::set<std::string> warnings;

    // Spent so far.
    uint64_t bytes = 0, vertices = 0, indices = 0, pixels = 0, keyValues = 0;

    template <class... Parts> void warn(const Parts&... parts) {
        if (warnings.size() < 100) warnings.insert(text(parts...));
    }

    // Takes amount from a limit, before the memory is taken; a fault where it does not suffice.
    static void spend(uint64_t& spent, uint64_t amount, uint64_t limit, const std::string& who,
                      const char* what) {
        if (amount > limit || spent > limit - amount)
            fault(who, " brings the model to more than the limit of ", limit, " ", what);
        spent += amount;
    }
};

} // namespace shoal::scene
