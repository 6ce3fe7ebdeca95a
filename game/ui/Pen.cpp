#include "game/ui/Pen.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <cfloat>

namespace shoal::app {

glm::vec2 Pen::extent(const char* text, float scale) const {
    const ImVec2 extent = font->CalcTextSizeA(line * scale, FLT_MAX, 0, text);
    return {extent.x, extent.y};
}

void Pen::text(float x, float y, float anchor, float scale, uint32_t colour, const char* text) const {
    const float pixels = line * scale;
    const ImVec2 at(x - extent(text, scale).x * anchor, y);
    const float shadow = std::max(1.0f, pixels * 0.06f);
    list->AddText(font, pixels, ImVec2(at.x + shadow, at.y + shadow), IM_COL32(0, 10, 20, 190), text);
    list->AddText(font, pixels, at, colour, text);
}

void Pen::lines(float y, std::span<const char* const> texts) const {
    for (const char* each : texts) {
        text(size.x / 2, y, 0.5f, 0.85f, colour::kWhite, each);
        y += line * 1.35f;
    }
}

void Pen::panel(float widthLines, float heightLines) const {
    const glm::vec2 half = glm::vec2(widthLines, heightLines) * line / 2.0f, low = size / 2.0f - half,
                    high = size / 2.0f + half;
    list->AddRectFilled(ImVec2(low.x, low.y), ImVec2(high.x, high.y), colour::kPanel, line * 0.6f);
}

void Pen::shade() const { list->AddRectFilled(ImVec2(0, 0), ImVec2(size.x, size.y), colour::kShade); }

} // namespace shoal::app
