#include "tests/baselines/light/Baselines.h"

namespace shoal::light::baselines {

std::vector<DiffuseMethod> diffuseMethods() {
    std::vector<DiffuseMethod> methods = {shoalDiffuse(false), shoalDiffuse(true)};
    for (const int width : {128, 64, 32, 16}) methods.push_back(bruteForce(width));
    for (const bool windowed : {false, true})
        for (const int bands : {2, 3, 4, 6, 8}) methods.push_back(harmonicDiffuse(bands, windowed));
    methods.push_back(zonalHarmonicsDiffuse());
    for (const int lobes : {12, 24, 48}) methods.push_back(sphericalGaussians(lobes));
    return methods;
}

std::vector<GlossyMethod> glossyMethods() {
    std::vector<GlossyMethod> methods = {shoalGlossy(false), shoalGlossy(true), thesisRings()};
    for (const int samples : {8, 16, 32, 64}) methods.push_back(filteredImportanceSampling(samples));
    for (const int narrowest : {8, 32}) {
        methods.push_back(importancePrefilter(64, narrowest));
        methods.push_back(fittedPrefilter(narrowest));
    }
    methods.push_back(harmonicGlossy(8));
    return methods;
}

std::vector<PyramidMethod> pyramidMethods() {
    return {pyramidFrom(PyramidSource::Whole, true), pyramidFrom(PyramidSource::Whole, false),
            pyramidFrom(PyramidSource::HalfDropped, true), pyramidFrom(PyramidSource::HalfDropped, false),
            pyramidFrom(PyramidSource::HalfMean, true)};
}

std::vector<InverseToneMapMethod> inverseToneMapMethods() {
    return {thesisInverse(false),
            thesisInverse(true),
            plainLinear(),
            clippedLight(),
            akyuz(1),
            akyuz(2.2f),
            landis(),
            masia2009(),
            masia2017(),
            rempel(),
            kovaleski(),
            banterle()};
}

} // namespace shoal::light::baselines
