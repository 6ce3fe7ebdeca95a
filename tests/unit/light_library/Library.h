// Makers and lights of the C interface, owned by scope; failures are thrown.
#pragma once

#include "engine/light/library/ShoalLight.h"

#include <array>
#include <memory>
#include <stdexcept>
#include <vector>

namespace shoallight {

using Colour = std::array<float, 3>;
using Direction = std::array<float, 3>;

inline void check(ShoalLightStatus status) {
    if (status != SHOAL_LIGHT_OK) throw std::runtime_error(shoalLightError());
}

template <class T, auto kDestroy> struct Owned {
    T* object = nullptr;
    Owned() = default;
    Owned(const Owned&) = delete;
    ~Owned() { kDestroy(object); }
};

struct Light : Owned<ShoalLight, shoalLightDestroy> {
    Light() { check(shoalLightCreate(&object)); }
    ShoalLightMaps maps() const {
        ShoalLightMaps maps;
        shoalLightMaps(object, &maps);
        return maps;
    }
    Colour diffuse(const Direction& normal) const {
        Colour radiance;
        shoalLightDiffuse(object, normal.data(), radiance.data());
        return radiance;
    }
    Colour glossy(const Direction& mirrored, float roughness) const {
        Colour radiance;
        shoalLightGlossy(object, mirrored.data(), roughness, radiance.data());
        return radiance;
    }
    std::vector<ShoalLightSource> sources() const {
        std::vector<ShoalLightSource> found(3);
        found.resize(static_cast<size_t>(shoalLightSources(object, found.data(), 3)));
        return found;
    }
};

struct Maker : Owned<ShoalLightMaker, shoalLightMakerDestroy> {
    explicit Maker(const ShoalLightOptions& options = shoalLightDefaults()) {
        check(shoalLightMakerCreate(&options, &object));
    }
    void set(int32_t setting, int32_t value) { check(shoalLightMakerSet(object, setting, value)); }
    void make(const ShoalLightFrame& frame, Light& light) {
        check(shoalLightMake(object, &frame, light.object));
    }
};

} // namespace shoallight
