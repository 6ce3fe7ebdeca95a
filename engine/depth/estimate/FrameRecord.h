// What is kept of each frame of a track while it is made, in a file beside the output: an interrupted run
// goes on from there.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/WriteFile.h"
#include "engine/depth/estimate/StereoDepth.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <fstream>
#include <optional>

namespace shoal::depth {

constexpr int kEstimateWidth = 256, kEstimateHeight = kEstimateWidth / 2;
constexpr size_t kEstimateTexels = size_t{kEstimateWidth} * kEstimateHeight;

glm::vec3 estimateDirection(size_t texel);

// Of a pair of frames: the one that it is kept with, and a later one.
struct PairMotion {
    glm::dvec3 towards{0, 0, -1};
    glm::dmat3 secondFromFirst{1};
    double parallax_rad = 0; // 0: no movement was found
    double height = 0;       // of the camera over what lies below it, in baselines of the pair; 0: not known
    double logRatio = 0;     // of this pair's baseline to that of the pair which ends here
    double ratioWeight = 0;  // 0: not known
};

// Plain bytes of this machine: a file of another is begun anew.
struct FrameRecord {
    PairMotion motion;
    uint16_t inverse[kEstimateTexels] = {}; // in 16384ths; of the pair's baseline, or 1/m where eyes tell
    uint8_t confidence[kEstimateTexels] = {};
    uint64_t check = 0; // FNV-1a of all before

    void set(const DepthEstimate& depth);
    void get(double inverseFactor, DepthEstimate& depth) const;
};

class RecordFile {
  public:
    // Counts what is there of the same identity, `count` at most.
    RecordFile(Path file, uint64_t identity, int count);
    int done() const { return done_; }
    Status begin();
    Status add(FrameRecord& record);
    bool read(int number, FrameRecord& record); // false: damaged
    void remove();

  private:
    static constexpr uint64_t kMagic = 0x3272747064687331; // changes with the layout of FrameRecord
    Path file_;
    uint64_t head_[2];
    int done_ = 0;
    std::optional<GrowingFile> out_;
    std::ifstream in_;
};

} // namespace shoal::depth
