#include "engine/occlusion/gpu/OllfbGpu.h"

#include "engine/occlusion/gpu/Storage.h"
#include "shaders/occlusion/Bindings.glsl"

#include <algorithm>
#include <utility>

namespace shoal::occlusion {

namespace {

// OllfbView in shaders/occlusion/Ollfb.glsl, std430.
struct GpuView {
    glm::vec4 rows[3]; // of viewFromBody; w: low
    float pixelsPerMetre, depthRange_px;
    glm::ivec2 size;
    uint32_t firstRow, pad[3];
};
static_assert(sizeof(GpuView) == 80);
static_assert(sizeof(OllfbRow) == 12, "three words, begin in the low half of the third");

// Values of 16 bits, two a word; odd ones out filled up.
template <class T> Result<gl::Buffer> packed(const std::vector<T>& values) {
    std::vector<uint32_t> words((values.size() * sizeof(T) + 3) / 4, 0);
    const auto* const bytes = reinterpret_cast<const unsigned char*>(values.data());
    std::copy_n(bytes, values.size() * sizeof(T), reinterpret_cast<unsigned char*>(words.data()));
    return storageBuffer<uint32_t>(words);
}

} // namespace

Result<OllfbGpu> OllfbGpu::upload(const Ollfb& ollfb) {
    if (Status status = canKeepLayers(); !status) return status.error();
    OllfbGpu result;
    result.closed_ = ollfb.closed();
    result.onlyOuter_ = ollfb.onlyOuter();
    std::vector<GpuView> views;
    for (const OllfbView& view : ollfb.views()) {
        GpuView& gpu = views.emplace_back();
        const glm::mat3 rows = glm::transpose(view.viewFromBody);
        for (int k = 0; k < 3; ++k) gpu.rows[k] = glm::vec4(rows[k], view.low[k]);
        gpu.pixelsPerMetre = view.pixelsPerMetre;
        gpu.depthRange_px = view.depthRange_px;
        gpu.size = view.size;
        gpu.firstRow = view.firstRow;
    }
    const auto keep = [](gl::Buffer& where, Result<gl::Buffer> made) -> Status {
        if (!made) return made.error();
        where = std::move(*made);
        return Done{};
    };
    for (const Status& status :
         {keep(result.views_, packed(views)), keep(result.rows_, packed(ollfb.rows())),
          keep(result.starts_, packed(ollfb.starts())), keep(result.layers_, packed(ollfb.layers())),
          keep(result.axes_, packed(ollfb.axes().table()))})
        if (!status) return status.error();
    return result;
}

void OllfbGpu::bind(const gl::Program& program) const {
    program.set("closed", closed_);
    program.set("onlyOuter", onlyOuter_);
    for (const auto& [binding, buffer] : {std::pair{OCCLUSION_VIEWS, &views_},
                                          {OCCLUSION_ROWS, &rows_},
                                          {OCCLUSION_STARTS, &starts_},
                                          {OCCLUSION_LAYERS, &layers_},
                                          {OCCLUSION_AXES, &axes_}})
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(binding), buffer->name());
}

} // namespace shoal::occlusion
