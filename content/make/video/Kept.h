// A traced frame on disk: radiance and distance of every pixel, lossless but for their steps, in FFV1 (RFC
// 9043) within NUT, so that ffmpeg reads it too. Planes of 12 bits: red, green, blue and, as alpha, distance.
#pragma once

#include "content/make/video/Drawn.h"

#include "engine/core/Files.h"
#include "engine/core/Result.h"

namespace shoal::reef {

// Radiance is stepped by logarithm above this, evenly below: 0.26 % a step, up to kKeptBrightest.
constexpr float kKeptDark = 0.002f, kKeptBrightest = 64;
// Distance by logarithm: 0.15 % a step.
constexpr float kKeptNearest = 0.1f, kKeptFurthest = 51.2f; // metres

uint16_t codeOfRadiance(float radiance);
float radianceOfCode(uint16_t code);
uint16_t codeOfDistance(float metres);
float distanceOfCode(uint16_t code);

// Writes the frame under another name and renames it, so that a run that is killed leaves no half of a frame.
Status keep(const Drawn& drawn, const Path& file);
// Reads a frame that keep() wrote; the camera's place is not in the file and stays 0.
Result<Drawn> recall(const Path& file, int width);

} // namespace shoal::reef
