// Views of a film's frame from an eye beside its camera, drawn in several ways.
#pragma once

#include "engine/core/Image.h"
#include "engine/depth/DepthMap.h"
#include "engine/render/View.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace shoal::bench {

// A lat-long frame in display values, 0 to 1.
struct Frame {
    ImageRgbF display;
    depth::DepthMap depth, widened;
};

struct Picture {
    int size = 0;                  // square
    std::vector<glm::vec3> pixels; // rows from the bottom, display values
};

// Returns a square view of 90 degrees from the camera.
Picture seenFlat(const ImageRgbF& display, const glm::mat3& envFromEye, int size);

// Returns the view by render::BackgroundCells: searches at cells' corners, interpolates between them.
Picture seenByCells(const Frame& frame, const glm::vec3& eyeInFilm, const glm::mat3& envFromEye, int size);

// Returns the view by the same search for every pixel.
Picture seenBySearch(const Frame& frame, const glm::vec3& eyeInFilm, const glm::mat3& envFromEye, int size);

// Returns the view of a mesh over the sphere, drawn with a depth buffer: a vertex for each `step` texels of
// the map, at its distance. Stretched triangles cover what lies behind an edge.
Picture seenByGrid(const Frame& frame, const glm::vec3& eyeInFilm, const glm::mat3& envFromEye, int size,
                   int step);

} // namespace shoal::bench
