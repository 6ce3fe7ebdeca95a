// The camera: from radiance to what an encoder takes. Lens, exposure, white balance, tone, clipping, noise,
// in this order.
#pragma once

#include "content/make/video/Scene.h"

#include "engine/core/Image.h"

namespace shoal::reef {

// Mean of log2 of what the camera would expose for, weighted by solid angle.
float meterReading(const ImageRgbF& radianceLin);
// Exposures over the film (factors), from the readings at even times; smooth and closed.
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
