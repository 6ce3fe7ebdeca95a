// Fonts of the user interface: each text size is rasterised at exactly the pixels it is shown with.
#pragma once

#include <array>
#include <cstddef>

struct ImFont;

namespace shoal::app {

enum class TextSize { Small, Body, Heading, Display };

// Text heights, in multiples of Body.
inline constexpr std::array kTextScale = {0.82f, 1.0f, 1.5f, 2.6f};

class Fonts {
  public:
    // Rasterises the fonts for a line height, if it has changed in whole pixels. Needs the owning ImGui
    // context with its OpenGL backend.
    void fit(float line_px);

    bool ready() const { return fonts_[0] != nullptr; }
    ImFont* at(TextSize size) const { return fonts_[static_cast<size_t>(size)]; }
    float pixels(TextSize size) const { return pixels_[static_cast<size_t>(size)]; }

  private:
    std::array<ImFont*, kTextScale.size()> fonts_{};
    std::array<float, kTextScale.size()> pixels_{};
};

} // namespace shoal::app
