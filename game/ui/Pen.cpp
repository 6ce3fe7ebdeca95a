#include "game/ui/Pen.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace shoal::app {

namespace {

ImVec2 imVec(glm::vec2 v) { return {v.x, v.y}; }

} // namespace

glm::vec2 Pen::extent(std::string_view text, TextSize textSize, float width) const {
    const ImVec2 extent = fonts->at(textSize)->CalcTextSizeA(fonts->pixels(textSize), FLT_MAX, width,
                                                             text.data(), text.data() + text.size());
    return {std::ceil(extent.x), extent.y};
}

void Pen::text(float x, float y, float anchor, TextSize textSize, uint32_t colour,
               std::string_view text) const {
    x -= extent(text, textSize).x * anchor;
    // Text starts at whole pixels, so that glyphs are shown as rasterised, without filtering.
    list->AddText(fonts->at(textSize), fonts->pixels(textSize), ImVec2(std::round(x), std::round(y)), colour,
                  text.data(), text.data() + text.size());
}

float Pen::paragraph(float x, float y, float width, TextSize textSize, uint32_t colour,
                     std::string_view text) const {
    list->AddText(fonts->at(textSize), fonts->pixels(textSize), ImVec2(std::round(x), std::round(y)), colour,
                  text.data(), text.data() + text.size(), width);
    return extent(text, textSize, width).y;
}

Rectangle Pen::label(float x, float y, float anchor, TextSize textSize, uint32_t colour,
                     std::string_view content) const {
    const glm::vec2 margin(line * 0.5f, line * 0.18f);
    // The label stays within the picture.
    const float widest = size.x - 2 * margin.x;
    glm::vec2 extents = extent(content, textSize);
    const bool isWide = extents.x > widest;
    if (isWide) extents = extent(content, textSize, widest);
    const float left =
        std::clamp(x - extents.x * anchor, margin.x, std::max(margin.x, size.x - margin.x - extents.x));
    const Rectangle area{glm::vec2(left, y) - margin, glm::vec2(left, y) + extents + margin};
    panel(area);
    if (isWide)
        paragraph(left, y, widest, textSize, colour, content);
    else
        text(left, y, 0, textSize, colour, content);
    return area;
}

void Pen::fill(const Rectangle& area, uint32_t colour, float rounding_px) const {
    list->AddRectFilled(imVec(area.low), imVec(area.high), colour, rounding_px);
}

void Pen::panel(const Rectangle& area) const {
    const float rounding = std::min(line * 0.5f, 0.5f * (area.high.y - area.low.y));
    fill(area, highContrast ? colour::kSolid : colour::kPanel, rounding);
}

void Pen::picture(const Rectangle& area, const Pictures::Picture& shown) const {
    if (!shown.texture) return;
    const glm::vec2 room = area.high - area.low, middle = (area.low + area.high) / 2.0f;
    const glm::vec2 half = shown.size * std::min(room.x / shown.size.x, room.y / shown.size.y) / 2.0f;
    list->AddImage(reinterpret_cast<ImTextureID>(static_cast<uintptr_t>(shown.texture.name())),
                   imVec(middle - half), imVec(middle + half));
}

} // namespace shoal::app
