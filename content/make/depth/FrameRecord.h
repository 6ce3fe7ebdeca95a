// Intermediate results for each frame of a track, kept in a file beside the output while the track is made,
// so that an interrupted run goes on from there.
#pragma once

#include "content/make/depth/StereoDepth.h"
#include "engine/core/Files.h"
#include "engine/core/WriteFile.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <fstream>
#include <optional>

namespace shoal::depth {

constexpr int kEstimateWidth = 256, kEstimateHeight = kEstimateWidth / 2;
constexpr size_t kEstimateTexels = size_t{kEstimateWidth} * kEstimateHeight;

glm::vec3 estimateDirection(size_t texel);

// Movement of the camera between the frame of this record and a later one; the two form a pair.
struct PairMotion {
    glm::dvec3 towards{0, 0, -1};
    glm::dmat3 secondFromFirst{1};
    double parallax_rad = 0; // 0: no movement was found
    double height = 0;      // camera's height over what lies below it, in baselines of the pair; 0: not known
    double logRatio = 0;    // logarithm of this pair's baseline over that of the pair which ends here
    double ratioWeight = 0; // weight of logRatio; 0: not known
};

// The file holds records as plain bytes; a file from a machine with another byte order is begun anew.
struct FrameRecord {
    PairMotion motion;
    uint16_t inverse[kEstimateTexels] =
        {}; // 16384ths of one over the pair's baseline, or of 1/m in a stereo film
    uint8_t confidence[kEstimateTexels] = {};
    uint64_t check = 0; // FNV-1a of all members before

    void set(const DepthEstimate& depth);
    void get(double inverseFactor, DepthEstimate& depth) const;
};

class RecordFile {
  public:
    // Counts the whole records that the file holds, `count` at most; none if it has another identity.
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
