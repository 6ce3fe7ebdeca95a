#include "engine/render/BackgroundPass.h"

#include "engine/gl/Renderer.h"
#include "engine/render/software/SoftwareBackground.h"
#include "shaders/render/Attributes.glsl"

#include <algorithm>
#include <array>
#include <utility>

namespace shoal::render {

namespace {

constexpr unsigned kPolar = 1u << kToneFeatures, kAsIs = kPolar << 1, kFrameIsCoded = kAsIs << 1,
                   kShaded = kFrameIsCoded << 1;
constexpr std::array kBackgroundDefines = {SHOAL_TONE_DEFINES, "POLAR", "AS_IS", "FRAME_IS_CODED", "SHADED"};

unsigned featuresOf(const EyePicture& picture) {
    if (picture.showsFrameAsCoded()) return kAsIs;
    return toneFeatures(picture.exposure) | (picture.environment.frameIsCoded() ? kFrameIsCoded : 0u);
}

} // namespace

Result<std::unique_ptr<BackgroundPass>> BackgroundPass::make(Backend backend, bool withLayers) {
    if (backend == Backend::Auto)
        backend = gl::rendersInSoftware() && canSampleFrames() ? Backend::Software : Backend::OpenGL;
    std::unique_ptr<BackgroundPass> pass(backend == Backend::Software ? new SoftwareBackground
                                                                      : new BackgroundPass);
    pass->programs_ = gl::Variants("render/Background", kBackgroundDefines);
    // These programs are compiled now, so that a broken shader is reported at the start.
    for (const unsigned features : {0u, kPolar})
        if (auto program = pass->programs_.get(kAsIs | features); !program) return program.error();
    if (withLayers)
        if (Status s = EquirectComposite::make().moveTo(pass->composite_); !s) return s.error();
    pass->shadowTexture_ = makeLatLongTexture();
    pass->rectangles_ =
        TriangleBatch::make({{ATTRIBUTE_POSITION, 2}, {ATTRIBUTE_UV0, 2}, {ATTRIBUTE_NORMAL, 3}});
    return pass;
}

void BackgroundPass::markTiles(const CellRange& tiles) {
    for (int y = tiles.first.y; y <= tiles.last.y; ++y)
        for (int x = tiles.first.x; x <= tiles.last.x; ++x) tilesToPaint_[FrameTiles::indexOf(x, y)] = true;
}

Status BackgroundPass::draw(const EyePicture& picture, const ObjectLayer* layer) {
    const FrameTiles* tiles = layer ? layer->tiles : nullptr;
    cells_.make(picture.view, picture.envFromEye(), picture.size(), picture.filmParallax());
    cellsToDraw_.clear();
    for (const BackgroundCell& cell : cells_.all())
        cellsToDraw_.push_back({&cell, tiles && tiles->isChosen(cell.tiles(tiles->frameSize()))});
    if (Status s = drawCells(picture, layer); !s) return s;
    const PartTimes::Scope part(picture.partTimes(), "compositing");
    if (layer && !tiles) layer->layer.layOver();
    return Done{};
}

Status BackgroundPass::drawCells(const EyePicture& picture, const ObjectLayer* layer) {
    if (cellsToDraw_.empty()) return Done{};
    tilesToPaint_.assign(FrameTiles::kAll, false);
    for (const auto& [cell, isPainted] : cellsToDraw_)
        if (isPainted) markTiles(cell->tiles(layer->tiles->frameSize()));
    const FilmShadows* seen = picture.seenShadows();
    if (seen && std::exchange(uploadedShadows_, seen->version()) != seen->version())
        uploadTexels(shadowTexture_, frameOf(seen->remaining()), shadowSize_);
    const GLuint shadows = seen ? shadowTexture_.name() : 0;
    if (std::ranges::find(tilesToPaint_, true) != tilesToPaint_.end()) {
        const FilmedFrame* filmed = layer->filmed ? &picture.filmed : nullptr;
        composite_.paint(picture.environment, *layer->tiles, tilesToPaint_, layer->layer.layer().texture(),
                         layer->view, picture.envFromWorld, filmed, shadows);
        picture.canvas.bindColour();
    }
    glDisable(GL_BLEND);
    for (const auto& [shownPainted, polar] :
         {std::pair(false, false), std::pair(false, true), std::pair(true, false), std::pair(true, true)}) {
        corners_.clear();
        for (const auto& [cell, isPainted] : cellsToDraw_) {
            if (isPainted != shownPainted || cell->polar != polar) continue;
            for (const int i : {0, 1, 2, 2, 1, 3}) {
                const glm::ivec2 at(i & 1 ? cell->high.x : cell->low.x, i >> 1 ? cell->high.y : cell->low.y);
                corners_.push_back({2.0f * glm::vec2(at) / glm::vec2(picture.size()) - 1.0f,
                                    cell->first + static_cast<float>(i & 1) * cell->right +
                                        static_cast<float>(i >> 1) * cell->up,
                                    cell->directions[static_cast<size_t>(i)]});
            }
        }
        if (corners_.empty()) continue;
        auto found = programs_.get(featuresOf(picture) | (polar ? kPolar : 0u) |
                                   (shadows && !shownPainted ? kShaded : 0u));
        if (!found) return found.error();
        const gl::Program& program = **found;
        const GLuint frame = shownPainted ? composite_.texture() : picture.environment.frameTexture();
        program.use(); // frameTexture() may have used the program of PlanesPass
        program.setTexture("frame", UNIT_FRAME, frame);
        if (shadows && !shownPainted) program.setTexture("shadowsLeft", UNIT_SHADOWS, shadows);
        program.set("exposureScale", picture.exposure.scale());
        rectangles_.draw(corners_);
    }
    return Done{};
}

} // namespace shoal::render
