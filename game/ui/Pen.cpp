#include "game/ui/Pen.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <cfloat>

namespace shoal::app {

glm::vec2 Pen::extent(std::string_view text, float scale) const {
    const ImVec2 extent =
        font->CalcTextSizeA(line * scale, FLT_MAX, 0, text.data(), text.data() + text.size());
    return {extent.x, extent.y};
}

void Pen::text(float x, float y, float anchor, float scale, uint32_t colour, std::string_view text) const {
    const float pixels = line * scale, shadow = std::max(1.0f, pixels * 0.06f);
    const char *const begin = text.data(), *const end = begin + text.size();
    x -= extent(text, scale).x * anchor;
    list->AddText(font, pixels, ImVec2(x + shadow, y + shadow), IM_COL32(0, 10, 20, 190), begin, end);
    list->AddText(font, pixels, ImVec2(x, y), colour, begin, end);
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
