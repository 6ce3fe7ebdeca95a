// Hands water to a program in use. Pairs with shaders/render/Water.glsl.
#pragma once

#include "engine/gl/Program.h"
#include "engine/water/Water.h"

namespace shoal::render {

inline void setWater(const gl::Program& program, const water::Water& water) {
    program.setArray("waterVeil[0]", water.veil);
    program.set("attenuation_perM", water.attenuation_perM);
}

} // namespace shoal::render
