// Draws text and panels over a picture, measured in lines of text. Valid while Hud::draw() runs.
#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <string_view>

struct ImDrawList;
struct ImFont;

namespace shoal::app {

// Who reads what is drawn.
enum class Audience {
    WindowPlayer,  // has mouse and keys
    HeadsetPlayer, // has hands only
    Onlooker       // looks at the window while somebody plays in a headset, and may use its keys
};

// Display colours, 0xAABBGGRR. Gold and orange are of Okabe and Ito's palette, which the colour-blind tell
// apart.
namespace colour {
inline constexpr uint32_t kWhite = 0xF0FFFFFF, kDim = 0xAAFFFFFF, kGold = 0xFF42E4F0, kOrange = 0xFF009FE6,
                          kPanel = 0x961C1204, kShade = 0x78140C02;
}

struct Pen {
    ImDrawList* list;
    ImFont* font;
    glm::vec2 size; // of the picture, pixels
    float line;     // height of a line of text at scale 1, pixels
    Audience audience = Audience::WindowPlayer;

    glm::vec2 extent(std::string_view text, float scale) const; // pixels
    // anchor: which part of the text is at x: 0 left, 0.5 centre, 1 right.
    void text(float x, float y, float anchor, float scale, uint32_t colour, std::string_view text) const;
    // Centred lines below each other from y on, 1.35 lines apart.
    void lines(float y, std::span<const char* const> texts) const;
    void panel(float widthLines, float heightLines) const; // in the picture's middle
    void shade() const;                                    // darkens the whole picture
};

} // namespace shoal::app
