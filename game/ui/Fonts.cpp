#include "game/ui/Fonts.h"

#include "engine/core/Log.h"

#include <fontconfig/fontconfig.h>
#include <imgui/imgui.h>
// After imgui.h, which they need.
#include <imgui/backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace shoal::app {

namespace {

// Western European letters, punctuation, and the arrows of captions and menus.
constexpr ImWchar kRanges[] = {0x20,   0x17F,  0x2010, 0x203A, 0x20AC, 0x20AC, 0x2190, 0x2193,
                               0x25A0, 0x25CF, 0x2605, 0x2606, 0x2713, 0x2713, 0};
constexpr float kMinPixels = 11; // letters smaller than this run into one another

// Returns the file of DejaVu Sans, or of fontconfig's substitute; empty: none.
std::string findFont() {
    std::string file;
    FcPattern* wanted = FcNameParse(reinterpret_cast<const FcChar8*>("DejaVu Sans:style=Book:scalable=true"));
    FcConfigSubstitute(nullptr, wanted, FcMatchPattern);
    FcDefaultSubstitute(wanted);
    FcResult result = FcResultNoMatch;
    if (FcPattern* found = FcFontMatch(nullptr, wanted, &result)) {
        FcChar8* name = nullptr;
        if (FcPatternGetString(found, FC_FILE, 0, &name) == FcResultMatch)
            file = reinterpret_cast<const char*>(name);
        FcPatternDestroy(found);
    }
    FcPatternDestroy(wanted);
    return file;
}

} // namespace

void Fonts::fit(float line_px) {
    std::array<float, kTextScale.size()> pixels;
    for (size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = std::max(std::round(line_px * kTextScale[i]), kMinPixels);
    if (pixels == pixels_ && fonts_[0]) return;
    pixels_ = pixels;
    static const std::string kFile = findFont(); // the machine's; does not change
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    for (size_t i = 0; i < pixels.size(); ++i) {
        ImFontConfig config;
        config.SizePixels = pixels[i];
        config.OversampleH = config.OversampleV = 1; // texels lie on pixels
        config.PixelSnapH = true;
        fonts_[i] =
            kFile.empty() ? nullptr : atlas.AddFontFromFileTTF(kFile.c_str(), pixels[i], &config, kRanges);
        if (!fonts_[i]) fonts_[i] = atlas.AddFontDefault(&config);
    }
    if (kFile.empty()) log::warn("no font is installed; text is drawn with a small built-in one");
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
    atlas.ClearTexData(); // the GPU has a copy
}

} // namespace shoal::app
