// Three closed bodies made in code, about 20 cm across: like the teapot and the bunny of the literature, and
// a torus.
#pragma once

#include "tests/bench/occlusion/Mesh.h"

namespace shoal::bench {

Mesh teapot(); // belly, lid, spout and handle in one
Mesh bunny();  // sitting, ears up
Mesh torus();  // lying: axis +Y

} // namespace shoal::bench
