// The skeleton of the hands of every dive, for tests.
#pragma once

#include "engine/core/Files.h"
#include "input/hands/HandRig.h"

namespace shoal::tests {

inline const hands::HandRig& rig() {
    static const hands::HandRig loaded =
        hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json").value();
    return loaded;
}

// Returns the shape of a hand whose fingers all bend as far.
inline hands::HandShape shape(float curl, float spread = 0) {
    hands::HandShape shape{.spread = spread};
    shape.curl.fill(curl);
    return shape;
}

} // namespace shoal::tests
