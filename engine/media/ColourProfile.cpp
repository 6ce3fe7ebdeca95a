#include "engine/media/ColourProfile.h"

#include <lcms2.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <type_traits>

namespace shoal::media {

namespace {

using Profile = std::unique_ptr<void, decltype([](cmsHPROFILE each) { cmsCloseProfile(each); })>;
using Curve = std::unique_ptr<cmsToneCurve, decltype([](cmsToneCurve* each) { cmsFreeToneCurve(each); })>;
using Transform = std::unique_ptr<void, decltype([](cmsHTRANSFORM each) { cmsDeleteTransform(each); })>;

bool isGrey(const ImageRgb8& picture) {
    const auto& p = picture.pixels;
    for (size_t i = 0; i < p.size(); i += 3)
        if (p[i] != p[i + 1] || p[i] != p[i + 2]) return false;
    return true;
}

// Returns whether the transform leaves all of 6 x 6 x 6 colours as they are, within a level of 8 bits.
bool isIdentity(cmsHTRANSFORM transform) {
    for (int i = 0; i < 216; ++i) {
        const std::array from = {static_cast<uint8_t>(i % 6 * 51), static_cast<uint8_t>(i / 6 % 6 * 51),
                                 static_cast<uint8_t>(i / 36 * 51)};
        std::array<uint8_t, 3> to{};
        cmsDoTransform(transform, from.data(), to.data(), 1);
        if (!std::ranges::equal(from, to, [](int a, int b) { return std::abs(a - b) <= 1; })) return false;
    }
    return true;
}

} // namespace

std::string convertToSrgb(std::span<const uint8_t> bytes, ImageRgb8& picture) {
    constexpr const char* kIgnored = "; its colour profile is damaged or not for its colours, and is ignored";
    if (bytes.empty() || picture.empty()) return "";
    const Profile from(cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
    const Profile srgb(cmsCreate_sRGBProfile());
    if (!from || !srgb) return kIgnored;
    const bool grey = cmsGetColorSpace(from.get()) == cmsSigGrayData;
    if (!(grey ? isGrey(picture) : cmsGetColorSpace(from.get()) == cmsSigRgbData)) return kIgnored;
    // A grey transform reads the first of each pixel's three equal components.
    constexpr cmsUInt32Number kFirstOfThree =
        COLORSPACE_SH(PT_GRAY) | CHANNELS_SH(1) | EXTRA_SH(2) | BYTES_SH(1);
    const Transform transform(cmsCreateTransform(from.get(), grey ? kFirstOfThree : TYPE_RGB_8, srgb.get(),
                                                 TYPE_RGB_8, INTENT_RELATIVE_COLORIMETRIC,
                                                 cmsFLAGS_BLACKPOINTCOMPENSATION));
    if (!transform) return kIgnored;
    if (!grey && isIdentity(transform.get())) return "";
    cmsDoTransform(transform.get(), picture.pixels.data(), picture.pixels.data(),
                   static_cast<cmsUInt32Number>(picture.pixels.size() / 3));
    return "; converted to sRGB from the colours that it states";
}

std::vector<uint8_t> rgbProfile(double gamma, const std::array<double, 8>& xy) {
    if (xy[1] <= 0 || xy[3] <= 0 || xy[5] <= 0 || xy[7] <= 0) return {};       // lcms divides by them
    const double srgb[] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045}; // IEC 61966-2-1
    const Curve curve(gamma > 0 ? cmsBuildGamma(nullptr, gamma)
                                : cmsBuildParametricToneCurve(nullptr, 4, srgb));
    cmsToneCurve* const curves[] = {curve.get(), curve.get(), curve.get()};
    const cmsCIExyY white = {xy[0], xy[1], 1};
    const cmsCIExyYTRIPLE primaries = {{xy[2], xy[3], 1}, {xy[4], xy[5], 1}, {xy[6], xy[7], 1}};
    const Profile profile(curve ? cmsCreateRGBProfile(&white, &primaries, curves) : nullptr);
    cmsUInt32Number size = 0;
    if (!profile || !cmsSaveProfileToMem(profile.get(), nullptr, &size)) return {};
    std::vector<uint8_t> bytes(size);
    if (!cmsSaveProfileToMem(profile.get(), bytes.data(), &size)) bytes.clear();
    return bytes;
}

} // namespace shoal::media
