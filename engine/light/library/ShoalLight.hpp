// ShoalLight.h for C++17: ownership by scope, failures as exceptions. Header only, over the C functions, so
// that the library's binary interface is C's.
#pragma once

#include "ShoalLight.h"

#include <array>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace shoallight {

using Colour = std::array<float, 3>;    // linear red, green, blue
using Direction = std::array<float, 3>; // unit length; +Y up, the frame's centre column along -Z

struct Error : std::runtime_error {
    Error(ShoalLightStatus s, const char* why) : std::runtime_error(why), status(s) {}
    ShoalLightStatus status;
};

inline void check(ShoalLightStatus status) {
    if (status != SHOAL_LIGHT_OK) throw Error(status, shoalLightError());
}

// The light of one frame: empty until a Maker fills it.
class Light {
  public:
    Light() {
        ShoalLight* made = nullptr;
        check(shoalLightCreate(&made));
        light_.reset(made);
    }

    ShoalLightMaps maps() const { // for textures; valid until the light is made anew
        ShoalLightMaps maps;
        shoalLightMaps(light_.get(), &maps);
        return maps;
    }
    Colour diffuse(const Direction& normal) const { // irradiance / pi
        Colour radiance;
        shoalLightDiffuse(light_.get(), normal.data(), radiance.data());
        return radiance;
    }
    Colour glossy(const Direction& mirrored, float roughness) const {
        Colour radiance;
        shoalLightGlossy(light_.get(), mirrored.data(), roughness, radiance.data());
        return radiance;
    }

    float scale() const { return shoalLightScale(light_.get()); } // of the maps
    std::vector<ShoalLightSource> sources() const {
        std::vector<ShoalLightSource> found(3);
        found.resize(static_cast<size_t>(shoalLightSources(light_.get(), found.data(), 3)));
        return found;
    }

    ShoalLight* get() const { return light_.get(); }

  private:
    struct Destroy {
        void operator()(ShoalLight* light) const { shoalLightDestroy(light); }
    };
    std::unique_ptr<ShoalLight, Destroy> light_;
};

class Maker {
  public:
    explicit Maker(const ShoalLightOptions& options = shoalLightDefaults()) {
        ShoalLightMaker* made = nullptr;
        check(shoalLightMakerCreate(&options, &made));
        maker_.reset(made);
    }

    void set(ShoalLightSetting setting, int32_t value) {
        check(shoalLightMakerSet(maker_.get(), setting, value));
    }
    void make(const ShoalLightFrame& frame, Light& light) {
        check(shoalLightMake(maker_.get(), &frame, light.get()));
    }

  private:
    struct Destroy {
        void operator()(ShoalLightMaker* maker) const { shoalLightMakerDestroy(maker); }
    };
    std::unique_ptr<ShoalLightMaker, Destroy> maker_;
};

// The dfgTable of shaders/light/Surface.glsl: size x size x 2 floats.
inline std::vector<float> surfaceTable(int size = 64) {
    std::vector<float> table(size > 0 ? 2 * static_cast<size_t>(size) * static_cast<size_t>(size) : 0);
    check(shoalLightSurfaceTable(size, table.data()));
    return table;
}

} // namespace shoallight
