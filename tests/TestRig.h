// The skeleton of the hands of every dive, for tests.
#pragma once

#include "engine/core/Files.h"
#include "input/hands/HandRig.h"

namespace shoal::tests {

inline const hands::HandRig& rig() {
    static const hands::HandRig loaded = hands::HandRig::load(dataRoot() / "content/models/hand_skeleton.json").value();
    return loaded;
}

} // namespace shoal::tests
