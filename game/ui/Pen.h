// Draws text, pictures and panels over a picture, measured in lines of text, with the fonts for it.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/gl/Objects.h"
#include "game/texts/Texts.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

struct ImDrawList;
struct ImFont;

namespace shoal::app {

enum class TextSize { Small, Body, Heading, Display };

// Text heights, in multiples of Body.
inline constexpr std::array kTextScale = {0.82f, 1.0f, 1.5f, 2.6f};

// Each text size is rasterised at exactly the pixels it is shown with.
class Fonts {
  public:
    // Rasterises the fonts for a line height, if it has changed in whole pixels. Needs the owning ImGui
    // context with its OpenGL backend.
    void fit(float line_px);

    bool ready() const { return fonts_[0] != nullptr; }
    ImFont* at(TextSize size) const { return fonts_[static_cast<size_t>(size)]; }
    float pixels(TextSize size) const { return pixels_[static_cast<size_t>(size)]; }

  private:
    std::array<std::vector<uint8_t>, 2> files_; // of text and of headings, as read
    std::array<ImFont*, kTextScale.size()> fonts_{};
    std::array<float, kTextScale.size()> pixels_{};
    gl::Texture texture_; // of all letters
};

// Reads one of the program's own PNG (alpha not premultiplied) or JPEG files by stb_image. media::readPhoto()
// would load OpenCV's codecs (engine/media/Codecs.h), and it drops alpha.
Result<ImageRgba8> readSmallPicture(const Path& file);

// Pictures of menu pages as textures: animals of the field guide, dives.
class Pictures {
  public:
    struct Picture {
        gl::Texture texture; // empty: there is no such picture
        glm::vec2 size{0};   // pixels

        void show(const ImageRgba8& image); // replaces the texture's image
    };
    // Returns a picture, read when it is first asked for. file: below content/. Needs the OpenGL context.
    const Picture& get(const std::string& file);

  private:
    std::map<std::string, Picture> read_;
};

// Person who reads the text.
enum class Audience {
    WindowPlayer,  // uses mouse and keys
    GamepadPlayer, // the same, but used the gamepad last
    HeadsetPlayer, // uses hands only
    Onlooker       // watches the window of a headset's player, and may use its keys
};

// Display colours, 0xAABBGGRR: deep water, with lines of sea glass as on a dive computer. Gold, for what is
// won, and orange, for errors, are from the palette of Okabe and Ito, safe for colour-blind people. Text of
// each colour on a panel over a white sky has a contrast of at least 4.5 to 1 (MenuTest).
namespace colour {
inline constexpr uint32_t kWhite = 0xFFFFFFFF, kGrey = 0xFFD2CCBC, kGold = 0xFF42E4F0, kOrange = 0xFF009FE6,
                          kAccent = 0xFFC8D674, kHair = 0x40C8D674, kPanel = 0xDC221804, kSolid = 0xFF000000,
                          kFocus = 0xFF584812, kTrack = 0xFF4C4022, kCasing = 0xB8140A00;
}

// The side of a panel that has a line in the accent's colour.
enum class Edge { None, Left, Top, Right };

struct Rectangle { // pixels from the upper left
    glm::vec2 low{0}, high{0};
    bool contains(glm::vec2 at) const {
        return at.x >= low.x && at.y >= low.y && at.x < high.x && at.y < high.y;
    }
};

// Valid while Hud::draw() runs.
struct Pen {
    ImDrawList* list;
    const Fonts* fonts;
    glm::vec2 size; // picture's size, pixels
    float line;     // height of a line of text of size Body, pixels
    Audience audience = Audience::WindowPlayer;
    game::Language language = game::Language::English;
    bool highContrast = false; // panels are opaque black
    Pictures* pictures = nullptr;
    const Pictures::Picture* camera = nullptr; // image of a hand tracker's camera; null: none

    template <class... Values> auto in(game::Text text, const Values&... values) const {
        return text.in(language, values...);
    }

    // Returns the size of a text, pixels. width: where lines are broken; 0: nowhere.
    glm::vec2 extent(std::string_view text, TextSize size, float width = 0) const; // pixels
    // Draws one line. anchor: the part of the text at x: 0 left, 0.5 centre, 1 right. Text without a panel
    // has a shadow, which alone does not make it readable.
    void text(float x, float y, float anchor, TextSize size, uint32_t colour, std::string_view text) const;
    // Draws lines broken at width; returns their height, pixels.
    float paragraph(float x, float y, float width, TextSize size, uint32_t colour,
                    std::string_view text) const;
    // Draws text on a small panel, in several lines if the picture is too narrow for one; x: the text's
    // middle, y: its upper edge. Returns the panel.
    Rectangle label(float x, float y, TextSize size, uint32_t colour, std::string_view text) const;
    void panel(const Rectangle& area, Edge edge = Edge::None) const;
    // Draws a line of the accent's colour from a place to the right; waves: for the game's name.
    void rule(glm::vec2 from, float width, bool waves = false) const;
    float stroke() const { return std::max(1.0f, std::round(line * 0.08f)); } // width of lines
    void fill(const Rectangle& area, uint32_t colour) const;
    // Draws the picture as large as fits, in the middle of the area.
    void picture(const Rectangle& area, const Pictures::Picture& shown) const;
};

} // namespace shoal::app
