#include "engine/light/rivals/Rivals.h"

namespace shoal::light::rivals {

std::vector<DiffuseMethod> diffuseMethods() {
    std::vector<DiffuseMethod> methods = {shoalDiffuse()};
    for (const int width : {128, 64, 32, 16}) methods.push_back(bruteForce(width));
    for (const bool windowed : {false, true})
        for (const int bands : {2, 3, 4, 6, 8}) methods.push_back(harmonicDiffuse(bands, windowed));
    return methods;
}

std::vector<GlossyMethod> glossyMethods() {
    std::vector<GlossyMethod> methods = {shoalGlossy(), thesisRings()};
    for (const int samples : {8, 16, 32, 64}) methods.push_back(filteredImportanceSampling(samples));
    methods.push_back(harmonicGlossy(8));
    return methods;
}

} // namespace shoal::light::rivals
