// A surround as methods get it.
#pragma once

#include "engine/light/rivals/Method.h"
#include "tests/bench/light/Surrounds.h"

namespace shoal::bench {

inline light::rivals::Input inputOf(const Surround& surround, const light::RadiancePyramid& pyramid) {
    light::rivals::Input input{&pyramid, {}, nullptr};
    if (surround.coded())
        input.coded = surround.view();
    else
        input.radianceLin = &surround.radianceLin;
    return input;
}

} // namespace shoal::bench
