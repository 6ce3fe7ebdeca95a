// The camera: turns radiance into 8-bit values for an encoder by lens, exposure, white balance, noise, and
// the tone curve with its clip, in this order.
#pragma once

#include "content/make/video/Scene.h"

#include "engine/core/Image.h"

namespace shoal::reef {

// Returns the exposure meter's reading: the mean of log2 of luminance, weighted by solid angle.
float meterReading(const ImageRgbF& radianceLin);
// Exposure factors over the film, from meter readings at equal intervals; smooth, also from end to start.
class Exposure {
  public:
    Exposure(const CameraData& camera, std::vector<float> readings);
    float at(float turn) const;

  private:
    CameraData camera_;
    std::vector<float> readings_;
    float mean_ = 0;
};
// frame seeds the noise.
ImageRgb8 develop(const CameraData& camera, const ImageRgbF& radianceLin, float exposure, int frame);

} // namespace shoal::reef
