// An environment as methods get it.
#pragma once

#include "tests/baselines/light/Method.h"
#include "tests/bench/light/Environments.h"

namespace shoal::bench {

inline light::baselines::Input inputOf(const Environment& environment,
                                       const light::RadiancePyramid& pyramid) {
    light::baselines::Input input{&pyramid, {}, nullptr};
    if (environment.coded())
        input.coded = environment.view();
    else
        input.radianceLin = &environment.radianceLin;
    return input;
}

} // namespace shoal::bench
