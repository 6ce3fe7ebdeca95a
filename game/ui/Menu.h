// A page of the menus: a title, some text and a column of items, of which one has the focus. Mouse, keys,
// gamepad and a poking finger all come as the same MenuInput. Knows nothing of what the items are for.
#pragma once

#include "game/ui/Pen.h"

#include <optional>
#include <string>
#include <vector>

namespace shoal::app {

struct MenuItem {
    std::string label;
    std::string value;             // of a setting, as it is shown; empty: a button
    std::optional<float> fraction; // where the value stands between its ends, 0 to 1: a slider
    bool enabled = true;
    bool isButton = false; // although it shows a value
    std::string picture{}; // shown while the item has the focus, as the page's

    bool adjustable() const { return !value.empty() && !isButton; }
};

enum class PageLayout { Side, Centre }; // Side: the left part of the picture, the rest stays free

struct MenuPage {
    std::string title;
    std::string picture{};         // above the text (as Pictures has it); empty: none
    std::vector<std::string> text; // paragraphs above the items
    std::vector<MenuItem> items;
    std::string note;                // a line below the items
    std::string error;               // what went wrong; empty: nothing
    std::optional<float> progress{}; // of something that takes its time, 0 to 1
    PageLayout layout = PageLayout::Centre;
    bool wordmark = false; // the title is the game's name
    bool camera = false;   // where the picture would be, what a hand tracker's camera sees
};

// What the player did since the last frame.
struct MenuInput {
    int down = 0, right = 0; // steps of the focus, and of the focused value
    bool accept = false, back = false;
    std::optional<glm::vec2>
        pointer; // pixels of the picture that the menu is drawn on; empty: it has not moved
    bool pressed = false, held = false; // the pointer's button
    float wheel = 0;                    // notches, away from the player positive
};

struct MenuEvent {
    enum class Kind { Activate, Adjust, Slide, Back };
    Kind kind;
    size_t item = 0;
    int steps = 0;      // Adjust: to the right positive
    float fraction = 0; // Slide: 0 to 1
};

class Menu {
  public:
    // focus: of the item that is chosen at first; out of range: the first that is enabled.
    void show(MenuPage page, size_t focus = 0);
    // The same page with other words and values; the focus stays.
    void update(MenuPage page);

    std::optional<MenuEvent> input(const MenuInput& input);

    // Places everything for this pen's picture and draws it.
    void draw(const Pen& pen);

    const MenuPage& page() const { return page_; }
    size_t focus() const { return focus_; }
    // Where an item was drawn last; empty while it is scrolled away.
    std::optional<Rectangle> areaOf(size_t item) const;
    float textBelow() const; // that is scrolled away, pixels

  private:
    void moveFocus(int steps);
    void scrollBy(float pixels); // down positive
    float maxScroll() const;
    void scrollText(float pixels); // down positive
    std::optional<MenuEvent> point(const MenuInput& input);
    void place(const Pen& pen);
    void drawItem(const Pen& pen, size_t index) const;
    const Pictures::Picture* pictureOn(const Pen& pen) const; // null: none
    Rectangle trackOf(size_t item) const;                     // of a slider

    MenuPage page_;
    size_t focus_ = 0;
    std::optional<size_t> sliding_; // the slider that the pointer's button holds
    // As placed last, pixels.
    Rectangle panel_, text_, list_;
    std::vector<Rectangle> areas_;
    float scroll_ = 0, line_ = 0;           // scroll: how far the list is moved up
    float textHeight_ = 0, textScroll_ = 0; // of the whole text, and how far it is moved up in text_
    float pictureHeight_ = 0;
    std::string picture_; // the page's, or of the item that had one and the focus last
    TextSize titleSize() const { return page_.wordmark ? TextSize::Display : TextSize::Heading; }
    glm::vec2 pointer_{-1};
};

} // namespace shoal::app
