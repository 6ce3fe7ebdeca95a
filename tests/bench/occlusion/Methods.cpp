#include "tests/bench/occlusion/Method.h"

namespace shoal::bench {

std::vector<OcclusionMethod> occlusionMethods() {
    std::vector<OcclusionMethod> all;
    all.push_back(ignored()); // first
    all.push_back(bakedOcclusion(true));
    all.push_back(bakedOcclusion(false));
    all.push_back(transfer(3, true));
    all.push_back(transfer(4, true));
    all.push_back(transfer(4, false));
    all.push_back(coherentShadowMaps(256, 64));
    all.push_back(coherentShadowMaps(512, 128));
    all.push_back(layeredDepth(64, 128));
    all.push_back(layeredDepth(256, 128));
    for (const int directions : {64, 256}) {
        all.push_back(thesisLayers(directions));
        all.push_back(curedLayers(directions));
    }
    for (const Casting casting : {Casting::Others, Casting::OthersAndFolds, Casting::All})
        all.push_back(ellipsoids(casting));
    for (const int directions : {16, 64, 256}) all.push_back(exactRays(directions));
    return all;
}

} // namespace shoal::bench
