#include "engine/occlusion/gpu/LayersGpu.h"

#include "engine/occlusion/gpu/Storage.h"

namespace shoal::occlusion {

namespace {

// A ray that leaves the surface begins so many pixels away from it, so that it does not meet the surface
// itself: the distances with the smallest error in tests/bench/occlusion.
constexpr float kStartOllfb_px = 0.32f, kStartThesis_px = 3;

} // namespace

Result<LayersGpu> LayersGpu::make(const BodyMesh& mesh, LayerMethod method) {
    if (Status status = canKeepLayers(); !status) return status.error();
    const auto nearest = [&](float start_px, int resolution) {
        return start_px * 2 * boundingSphere(mesh).radius / static_cast<float>(resolution);
    };
    if (method == LayerMethod::Thesis) {
        const ThesisOptions options;
        auto seen = ThesisGpu::see(mesh, options);
        if (!seen) return seen.error();
        return LayersGpu(std::move(*seen), nearest(kStartThesis_px, options.resolution));
    }
    const Ollfb::Options options;
    const auto made = Ollfb::make(mesh, options);
    if (!made) return made.error();
    auto uploaded = OllfbGpu::upload(*made);
    if (!uploaded) return uploaded.error();
    return LayersGpu(std::move(*uploaded), nearest(kStartOllfb_px, options.resolution));
}

void LayersGpu::bind(const gl::Program& program) const {
    std::visit([&](const auto& layers) { layers.bind(program); }, layers_);
    program.set("layersNearest", nearest_m_);
}

} // namespace shoal::occlusion
