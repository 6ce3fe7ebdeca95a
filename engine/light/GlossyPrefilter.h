// Radiance filtered by GGX lobes: the rough levels of EnvironmentLight::glossy from the radiance pyramid.
#pragma once

#include "engine/light/EnvironmentLight.h"
#include "engine/light/GlossyLevels.h"

#include <cstdint>
#include <vector>

namespace shoal::light {

// Every texel of a level is a weighted sum of pyramid texels (LobeCells.h). Turned by an eighth of a circle
// the surround needs the same sum, so eight columns share one rule and are summed side by side.
class GlossyPrefilter {
  public:
    // baseWidth: of pyramid level 0. Keep: rules are made now (0.1 to 0.5 s, some 10 MB) and used by every
    // make(); for video. MakeEachTime: rules are too many to keep; make() finds each again; for stills.
    enum class Rules { Keep, MakeEachTime };
    GlossyPrefilter(std::vector<GlossyPlan> plans, Rules rules);

    // Fills all levels of out; out[0] is the mirror and stays empty, see EnvironmentLight. One thread at a
    // time.
    void make(const RadiancePyramid& pyramid, std::vector<GlossyLevel>& out);

    const std::vector<GlossyPlan>& plans() const { return plans_; }

  private:
    struct Entry {
        uint32_t at = 0; // where its first float lies in woven_
        float weight = 0;
    };
    struct LevelRules {
        std::vector<uint32_t> begins; // of each rule in entries, row by row, phase by phase; and the end
        std::vector<Entry> entries;
    };

    void weave(const RadiancePyramid& pyramid);
    size_t wovenAt(int width, int row, int column) const;
    void appendRule(const std::vector<struct LobeCell>& cells, std::vector<Entry>& out) const;

    std::vector<GlossyPlan> plans_;
    std::vector<LevelRules> rules_; // one for each plan; empty for the mirror, and for stills
    int wovenWidth_ = 0;            // widest level in woven_
    // The pyramid with each row's texels reordered: those an eighth of a circle apart side by side, twice
    // over, so that eight columns' worth starts at any of them.
    std::vector<float> woven_;
};

} // namespace shoal::light
