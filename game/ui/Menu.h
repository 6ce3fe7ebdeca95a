// A menu page: a title, some text and a column of items, one of which has the focus. It does not know the
// meaning of its items. MenuControls makes the same MenuInput of mouse, keys, gamepad and a poking finger.
// Main thread.
#pragma once

#include "engine/platform/Window.h"
#include "engine/scene/HandPose.h"
#include "game/ui/Pen.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace shoal::app {

struct MenuEvent {
    enum class Kind { Adjust, Slide, Turn, Back }; // Adjust: a button is pressed too
    Kind kind;
    size_t item = 0;
    int steps = 0;      // Adjust, Turn: positive to the right
    float fraction = 0; // Slide: 0 to 1
};

struct MenuItem {
    std::string label;
    std::string value{};             // a setting's value, as shown; empty: a button
    std::optional<float> fraction{}; // a slider's place between its ends, 0 to 1; empty: no slider
    bool enabled = true;
    bool isButton = false;                       // a button although it has a value
    std::string picture{};                       // the page's picture while the item has the focus
    std::function<void(const MenuEvent&)> act{}; // for the page's owner

    bool adjustable() const { return !value.empty() && !isButton; }
};

struct MenuPicture {
    std::string file;                 // for Pictures
    std::string count, caption, note; // beside the picture, and two lines below it
    bool marked = false;              // the note is drawn in gold
};

enum class PageLayout { Side, Centre }; // Side: on the left part of the picture, the rest stays free

struct MenuPage {
    std::string title;
    std::string picture{};              // file for Pictures, shown above the text; empty: none
    std::vector<MenuPicture> gallery{}; // side by side above the text, the first that there is room for
    std::vector<std::string> text;      // paragraphs above the items
    std::vector<MenuItem> items;
    std::string note;                // a line below the items
    std::string error;               // an error; empty: none
    std::optional<float> progress{}; // progress bar, 0 to 1
    PageLayout layout = PageLayout::Centre;
    bool wordmark = false; // the title is the game's name
    bool camera = false;   // shows a hand tracker's camera in place of the picture
    bool turns = false;    // left and right turn to another page
};

// Input since the last frame.
struct MenuInput {
    int down = 0, right = 0; // steps of the focus downwards, and of its item's value
    bool accept = false, back = false;
    std::optional<glm::vec2> pointer;   // pixels of the menu's picture; empty: it has not moved
    bool pressed = false, held = false; // the pointer's button
    float wheel = 0;                    // notches, away from the player positive
};

class Menu {
  public:
    // Shows a page. focus: index of the first item with the focus; out of range: the first that is enabled.
    void show(MenuPage page, size_t focus = 0);
    // Shows the same page with other words and values; the focus stays.
    void update(MenuPage page);

    std::optional<MenuEvent> input(const MenuInput& input);

    // Lays out the page for this pen's picture and draws it.
    void draw(const Pen& pen);

    const MenuPage& page() const { return page_; }
    size_t focus() const { return focus_; }
    // Returns the area where an item was drawn last; empty while it is scrolled away.
    std::optional<Rectangle> areaOf(size_t item) const;
    float textBelow() const { // height of the text scrolled away below, pixels
        return std::max(textHeight_ - (text_.high.y - text_.low.y) - textScroll_, 0.0f);
    }

  private:
    void moveFocus(int steps);   // down positive
    void scrollBy(float pixels); // down positive
    float maxScroll() const;
    void scrollText(float pixels); // down positive
    std::optional<MenuEvent> point(const MenuInput& input);
    void place(const Pen& pen);
    void drawItem(const Pen& pen, size_t index) const;
    void drawGallery(const Pen& pen, float x, float y) const;
    const Pictures::Picture* pictureOn(const Pen& pen) const; // null: none
    Rectangle trackOf(size_t item) const;                     // track of a slider

    MenuPage page_;
    size_t focus_ = 0;
    std::optional<size_t> sliding_; // the slider that the pointer's button holds
    // Layout of the last draw(), pixels.
    Rectangle panel_, text_, list_;
    float top_ = 0; // above the title, and its margin
    std::vector<Rectangle> areas_;
    float scroll_ = 0, line_ = 0;           // scroll: how far the list is moved up
    float textHeight_ = 0, textScroll_ = 0; // height of the whole text; how far it is moved up in text_
    float pictureHeight_ = 0;
    float cell_ = 0;       // width of a picture of the gallery
    size_t inGallery_ = 0; // how many it shows
    std::string picture_;  // the page's picture, or that of the last focused item that has one
    TextSize titleSize() const { return page_.wordmark ? TextSize::Display : TextSize::Heading; }
    glm::vec2 pointer_{-1};
};

// The picture that menus are drawn on.
struct MenuSurface {
    glm::vec2 size{1}; // pixels
    int eyes = 1;      // number of such pictures side by side in the window
    bool mouse = true; // the mouse's pointer acts on it
};

// A hand's fingertip in front of that picture.
struct Pointing {
    bool points = false;
    glm::vec2 at{0.5f};  // 0 to 1 from the picture's upper left
    float forward_m = 0; // distance towards the picture from any fixed place
    bool pulls = false;  // a controller's trigger is pulled, which presses too
};
// Returns the pointing for a picture that fills the view. tanHalf: tangents of half its angles.
Pointing pointingInView(const hands::HandPose& hand, glm::vec2 tanHalf);

// Detects presses: a fingertip that moves forward by a few centimetres presses at its place. "Forward" is
// relative to a slow mean of its distance, so that it works wherever the hand is held.
struct FingerPoke {
    void step(const Pointing& finger, float dt_s);

    bool pointing = false, pressed = false, held = false;
    glm::vec2 at{0}; // 0 to 1 from the picture's upper left

    static constexpr float kPress_m = 0.025f, kRelease_m = 0.012f;
    static constexpr float kMean_s = 0.35f;

  private:
    bool pulled_ = false;
    float mean_m_ = 0;
    glm::vec2 steady_{0}; // last position before it moved forward
};

class MenuControls {
  public:
    // Returns a frame's menu input. window: null in tests. fingers: of the left and the right hand.
    MenuInput step(const platform::WindowInput& input, const platform::Window* window,
                   const std::array<Pointing, 2>& fingers, const MenuSurface& surface, float dt_s);

    // Returns the place of the finger's mark; empty: no hand points.
    std::optional<glm::vec2> finger() const { return finger_; }

    // Time for which fingers are ignored after other input: a tracker may see the hand that gives it.
    static constexpr float kFingersRest_s = 2;

  private:
    glm::ivec2 held_{0}; // direction held by keys or stick: +x right, +y down
    float repeat_s_ = 0; // seconds until the held direction counts as another step
    std::array<FingerPoke, 2> pokes_;
    float fingersRest_s_ = 0; // seconds left
    std::optional<glm::vec2> finger_;
};

} // namespace shoal::app
