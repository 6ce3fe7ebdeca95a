#include "game/ui/Menu.h"

#include <GLFW/glfw3.h>
#include <imgui/imgui.h>

#include <cmath>

namespace shoal::app {

// Sizes in lines of text.
constexpr float kMargin = 1.3f, kRow = 1.75f, kParagraphGap = 0.45f, kTitleGap = 1.1f, kRule = 0.4f;
constexpr float kWidth = 28, kSideWidth = 16, kPicture = 11;
constexpr float kCell = 7, kLeastCell = 5.5f, kCellPicture = 3.2f; // of the gallery
constexpr float kGallery = kCellPicture + 2 * kTextScale[0] + kParagraphGap;
constexpr float kTextStep = 2;
constexpr float kTrackWidth = 6, kValueWidth = 10;
constexpr int kMinRows = 3; // rows in sight beside a long text

// Draws a scroll bar at the right edge of `room`, which shows a part of content `height` high.
static void drawScrollBar(const Pen& pen, const Rectangle& room, float height, float scroll) {
    const float shown = room.high.y - room.low.y;
    if (height <= shown + 1) return;
    const float from = room.low.y + scroll * shown / height, right = room.high.x - 0.15f * pen.line;
    pen.fill({{right - 0.15f * pen.line, from}, {right, from + shown * shown / height}}, colour::kAccent);
}

void Menu::show(MenuPage page, size_t focus) {
    page_ = std::move(page);
    picture_ = page_.picture;
    sliding_.reset();
    scroll_ = textScroll_ = 0;
    areas_.clear();
    const auto enabled = std::ranges::find(page_.items, true, &MenuItem::enabled);
    const bool given = focus < page_.items.size() && page_.items[focus].enabled;
    focus_ = given ? focus : static_cast<size_t>(enabled - page_.items.begin());
}

void Menu::update(MenuPage page) {
    page_ = std::move(page);
    focus_ = std::min(focus_, page_.items.empty() ? 0 : page_.items.size() - 1);
}

// Stops at the ends: the item above the first is not the last, which quits the game on some pages.
void Menu::moveFocus(int steps) {
    const int way = steps < 0 ? -1 : 1, count = static_cast<int>(page_.items.size());
    for (int at = static_cast<int>(focus_) + way; steps != 0 && at >= 0 && at < count; at += way) {
        if (!page_.items[static_cast<size_t>(at)].enabled) continue;
        focus_ = static_cast<size_t>(at);
        steps -= way;
    }
}

// Scrolls the list, and moves the focus to an item that is still in sight.
void Menu::scrollBy(float pixels) {
    scroll_ = std::clamp(scroll_ + pixels, 0.0f, maxScroll());
    for (size_t tries = 0; tries < areas_.size() && !areaOf(focus_); ++tries) moveFocus(pixels > 0 ? 1 : -1);
}

float Menu::maxScroll() const {
    const float rows = kRow * line_ * static_cast<float>(areas_.size());
    return std::max(0.0f, rows - (list_.high.y - list_.low.y));
}

void Menu::scrollText(float pixels) {
    textScroll_ = std::max(textScroll_ + std::min(pixels, textBelow()), 0.0f);
}

std::optional<MenuEvent> Menu::point(const MenuInput& input) {
    if (input.pointer) pointer_ = *input.pointer;
    if (sliding_) {
        if (!input.held) {
            sliding_.reset();
            return std::nullopt;
        }
        const Rectangle track = trackOf(*sliding_);
        const float along = (pointer_.x - track.low.x) / std::max(track.high.x - track.low.x, 1.0f);
        return MenuEvent{MenuEvent::Kind::Slide, *sliding_, 0, std::clamp(along, 0.0f, 1.0f)};
    }
    if (input.wheel != 0) {
        const bool overList = maxScroll() > 0 && pointer_.y >= list_.low.y;
        overList ? scrollBy(-input.wheel * line_ * kRow) : scrollText(-input.wheel * line_ * kTextStep);
    }
    for (size_t i = 0; i < page_.items.size() && (input.pointer || input.pressed); ++i) {
        const MenuItem& item = page_.items[i];
        const auto area = areaOf(i);
        if (!item.enabled || !area || !area->contains(pointer_)) continue;
        focus_ = i;
        if (!input.pressed) return std::nullopt;
        if (!item.adjustable()) return MenuEvent{MenuEvent::Kind::Adjust, i, 1};
        const Rectangle track = trackOf(i);
        if (item.fraction && pointer_.x >= track.low.x - line_ && pointer_.x <= track.high.x + line_) {
            sliding_ = i;
            return point({.pointer = pointer_, .held = true});
        }
        // A click on a choice takes the next value, or the one before if it hits the arrow to the left.
        const bool before = pointer_.x >= track.low.x - line_ && pointer_.x < track.low.x + 2 * line_;
        return MenuEvent{MenuEvent::Kind::Adjust, i, before ? -1 : 1};
    }
    return std::nullopt;
}

std::optional<MenuEvent> Menu::input(const MenuInput& input) {
    if (input.back) return MenuEvent{MenuEvent::Kind::Back};
    if (page_.items.empty()) return std::nullopt;
    const size_t before = focus_;
    moveFocus(input.down);
    if (focus_ == before) scrollText(static_cast<float>(input.down) * line_ * kTextStep);
    const MenuItem& item = page_.items[focus_];
    if (input.right != 0 && item.adjustable()) return MenuEvent{MenuEvent::Kind::Adjust, focus_, input.right};
    if (input.right != 0 && page_.turns)
        return MenuEvent{.kind = MenuEvent::Kind::Turn, .steps = input.right};
    if (input.accept && item.enabled) return MenuEvent{MenuEvent::Kind::Adjust, focus_, 1};
    if (input.down != 0) return std::nullopt;
    return point(input);
}

std::optional<Rectangle> Menu::areaOf(size_t item) const {
    if (item >= areas_.size()) return std::nullopt;
    Rectangle area = areas_[item];
    area.low.y -= scroll_;
    area.high.y -= scroll_;
    if (area.low.y < list_.low.y - 1 || area.high.y > list_.high.y + 1) return std::nullopt;
    return area;
}

Rectangle Menu::trackOf(size_t item) const {
    Rectangle area = areas_[item];
    const bool slider = page_.items[item].fraction.has_value();
    area.high.x -= (slider ? 4.4f : 0.6f) * line_;
    area.low.x = area.high.x - (slider ? kTrackWidth : kValueWidth) * line_;
    return area;
}

const Pictures::Picture* Menu::pictureOn(const Pen& pen) const {
    if (page_.camera) return pen.camera;
    return picture_.empty() ? nullptr : &pen.pictures->get(picture_);
}

void Menu::place(const Pen& pen) {
    line_ = pen.line;
    if (focus_ < page_.items.size() && !page_.items[focus_].picture.empty())
        picture_ = page_.items[focus_].picture;
    const float margin = kMargin * line_;
    // A headset's panel is narrow and free-standing, so its pages are centred.
    const bool side = page_.layout == PageLayout::Side && pen.audience != Audience::HeadsetPlayer;
    const size_t pictures = page_.gallery.size();
    const float wanted =
        side ? kSideWidth : std::max(kWidth, kCell * static_cast<float>(pictures) + 2 * kMargin);
    const float width = std::min(wanted * line_, pen.size.x - margin);
    const float inner = width - 2 * margin;
    inGallery_ = std::min(pictures, static_cast<size_t>(inner / (kLeastCell * line_)));
    cell_ = std::min(kCell * line_, inner / static_cast<float>(std::max<size_t>(inGallery_, 1)));
    float above = page_.title.empty() ? 0 : pen.extent(page_.title, titleSize(), inner).y + kTitleGap * line_;
    if (inGallery_ > 0) above += kGallery * line_;
    textHeight_ = 0;
    for (const std::string& paragraph : page_.text)
        textHeight_ += pen.extent(paragraph, TextSize::Body, inner).y + kParagraphGap * line_;
    if (!page_.text.empty()) textHeight_ += kParagraphGap * line_;
    float below = 0;
    for (const std::string* line : {&page_.note, &page_.error})
        if (!line->empty()) below += pen.extent(*line, TextSize::Small, inner).y + kParagraphGap * line_;
    if (page_.progress) below += line_;
    const float rows = kRow * line_ * static_cast<float>(page_.items.size());
    const float room = pen.size.y - 2.5f * margin, leastRows = std::min(rows, kRow * line_ * kMinRows);
    // The picture leaves room for some lines of the text, or goes.
    const float gap = kParagraphGap * line_, leastText = std::min(textHeight_, 2 * kTextStep * line_);
    const float spare = room - above - leastRows - below - gap - leastText;
    pictureHeight_ = std::min({kPicture * line_, 0.4f * pen.size.y, inner * 9 / 16, spare});
    if (!pictureOn(pen) || pictureHeight_ < 2 * line_) pictureHeight_ = 0;
    above += pictureHeight_ > 0 ? pictureHeight_ + gap : 0;
    const float textRoom =
        std::min(textHeight_, std::max(room - above - leastRows - below, kTextStep * line_));
    const float textTop = above;
    above += textRoom;
    const float height = std::min(above + rows + below, room) + 2 * margin;
    const float left = side ? std::min(margin, (pen.size.x - width) / 2) : (pen.size.x - width) / 2;
    const float top = top_ = (pen.size.y - height) / 2;
    panel_ = side ? Rectangle{{-line_, -line_}, {left + width, pen.size.y + line_}}
                  : Rectangle{{left, top}, {left + width, top + height}};
    text_ = {{left, top + margin + textTop}, {left + width, top + margin + above}};
    textScroll_ = std::min(textScroll_, textHeight_ - textRoom);
    list_ = {{left, top + margin + above},
             {left + width, std::max(top + height - margin - below, top + margin + above + kRow * line_)}};
    areas_.resize(page_.items.size());
    for (size_t i = 0; i < areas_.size(); ++i) {
        const float y = list_.low.y + kRow * line_ * static_cast<float>(i);
        areas_[i] = {{left + 0.4f * margin, y}, {left + width - 0.4f * margin, y + kRow * line_}};
    }
    // Keeps the focused item in sight.
    if (!areas_.empty() && rows > list_.high.y - list_.low.y) {
        const Rectangle& focused = areas_[focus_];
        scroll_ = std::max(scroll_, focused.high.y - list_.high.y);
        scroll_ = std::min(scroll_, focused.low.y - list_.low.y);
    }
    scroll_ = std::clamp(scroll_, 0.0f, maxScroll());
}

void Menu::drawItem(const Pen& pen, size_t index) const {
    const auto area = areaOf(index);
    if (!area) return;
    const MenuItem& item = page_.items[index];
    const bool focused = index == focus_ && item.enabled;
    const float y = area->low.y + (kRow - 1) / 2 * line_, x = area->low.x + 0.6f * kMargin * line_;
    if (focused) {
        pen.fill(*area, colour::kFocus);
        pen.fill({area->low, {area->low.x + 2 * pen.stroke(), area->high.y}}, colour::kAccent);
    } else if (!item.value.empty()) {
        pen.fill({{x, area->high.y - 1}, {area->high.x - 0.5f * line_, area->high.y}}, colour::kHair);
    }
    const uint32_t ink = item.enabled ? colour::kWhite : colour::kGrey;
    pen.text(x, y, 0, TextSize::Body, ink, item.label);
    if (item.value.empty()) return;
    Rectangle track = trackOf(index);
    track.low.y = area->low.y;
    track.high.y = area->high.y;
    if (item.fraction) {
        const float middle = (track.low.y + track.high.y) / 2, half = 0.08f * line_;
        const float at = track.low.x + *item.fraction * (track.high.x - track.low.x);
        pen.fill({{track.low.x, middle - half}, {track.high.x, middle + half}}, colour::kTrack);
        pen.fill({{track.low.x, middle - half}, {at, middle + half}}, colour::kAccent);
        pen.list->AddCircleFilled(ImVec2(at, middle), 0.3f * line_,
                                  focused ? colour::kAccent : colour::kWhite);
        return pen.text(area->high.x - 0.5f * line_, y, 1, TextSize::Body, ink, item.value);
    }
    if (focused && item.adjustable()) {
        pen.text(track.low.x, y, 0, TextSize::Body, colour::kAccent, "\u2039");
        pen.text(track.high.x, y, 1, TextSize::Body, colour::kAccent, "\u203a");
    }
    // The value is centred in its field; one that is too long extends to the left.
    const float half = pen.extent(item.value, TextSize::Body).x / 2;
    pen.text(std::min((track.low.x + track.high.x) / 2, area->high.x - 0.5f * line_ - half), y, 0.5f,
             TextSize::Body, ink, item.value);
}

void Menu::drawGallery(const Pen& pen, float x, float y) const {
    for (size_t i = 0; i < inGallery_; ++i) {
        const MenuPicture& shown = page_.gallery[i];
        const float left = x + static_cast<float>(i) * cell_, middle = left + cell_ / 2;
        const float below = y + kCellPicture * line_;
        pen.picture({{left, y}, {left + cell_, below}}, pen.pictures->get(shown.file));
        pen.text(left + cell_, below - line_, 1, TextSize::Body, colour::kWhite, shown.count);
        pen.text(middle, below, 0.5f, TextSize::Small, colour::kWhite, shown.caption);
        pen.text(middle, below + kTextScale[0] * line_, 0.5f, TextSize::Small,
                 shown.marked ? colour::kGold : colour::kGrey, shown.note);
    }
}

void Menu::draw(const Pen& pen) {
    place(pen);
    const float margin = kMargin * line_, x = text_.low.x + margin;
    const float inner = text_.high.x - text_.low.x - 2 * margin;
    pen.panel(panel_, panel_.low.x > 0 ? Edge::Top : Edge::Right);
    float y = top_ + margin;
    if (!page_.title.empty()) {
        y += pen.paragraph(x, y, inner, titleSize(), colour::kWhite, page_.title) + kRule * line_;
        pen.rule({x, y}, page_.wordmark ? inner : 2 * line_, page_.wordmark);
        y += (kTitleGap - kRule) * line_;
    }
    if (pictureHeight_ > 0) pen.picture({{x, y}, {x + inner, y + pictureHeight_}}, *pictureOn(pen));
    drawGallery(pen, x, y);
    y = text_.low.y - textScroll_;
    pen.list->PushClipRect(ImVec2(text_.low.x, text_.low.y), ImVec2(text_.high.x, text_.high.y), true);
    for (const std::string& paragraph : page_.text)
        y += pen.paragraph(x, y, inner, TextSize::Body, colour::kWhite, paragraph) + kParagraphGap * line_;
    pen.list->PopClipRect();
    drawScrollBar(pen, text_, textHeight_, textScroll_);
    for (size_t i = 0; i < page_.items.size(); ++i) drawItem(pen, i);
    drawScrollBar(pen, list_, kRow * line_ * static_cast<float>(areas_.size()), scroll_);
    y = list_.high.y + kParagraphGap * line_;
    if (page_.progress) {
        const float half = 0.08f * line_, middle = y + 0.3f * line_;
        const Rectangle track{{x, middle - half}, {x + inner, middle + half}};
        pen.fill(track, colour::kTrack);
        pen.fill({track.low, {x + inner * std::clamp(*page_.progress, 0.0f, 1.0f), track.high.y}},
                 colour::kAccent);
        y += line_;
    }
    if (!page_.error.empty())
        y +=
            pen.paragraph(x, y, inner, TextSize::Small, colour::kOrange, page_.error) + kParagraphGap * line_;
    if (!page_.note.empty()) pen.paragraph(x, y, inner, TextSize::Small, colour::kGrey, page_.note);
}

constexpr float kRepeatFirst_s = 0.4f, kRepeat_s = 0.09f;
constexpr float kStick = 0.6f; // share of the stick's range that counts as a step

static int stepOf(float stick) { return stick > kStick ? 1 : stick < -kStick ? -1 : 0; }

static bool has(const std::vector<int>& list, int value) {
    return std::ranges::find(list, value) != list.end();
}

Pointing pointingInView(const hands::HandPose& hand, glm::vec2 tanHalf) {
    const glm::vec3 tip = hand.joints[hands::kFingerJoints[1].tip].position;
    const float depth_m = -tip.z;
    if (!hand.tracked || depth_m < 0.05f) return {};
    return {true,
            {0.5f + 0.5f * tip.x / (depth_m * tanHalf.x), 0.5f - 0.5f * tip.y / (depth_m * tanHalf.y)},
            depth_m};
}

void FingerPoke::step(const Pointing& finger, float dt_s) {
    pressed = false;
    if (!finger.points) {
        pointing = held = false;
        return;
    }
    if (!pointing) mean_m_ = finger.forward_m;
    pointing = true;
    const float forward_m = finger.forward_m - mean_m_;
    // A press counts where the finger pointed before it moved, as a poking finger does not move straight.
    if (forward_m < kRelease_m || finger.pulls) steady_ = finger.at;
    if (!held) at = finger.at;
    if (!held && (forward_m > kPress_m || (finger.pulls && !pulled_))) {
        pressed = held = true;
        at = steady_;
    }
    if (held && forward_m < kRelease_m && !finger.pulls) held = false;
    pulled_ = finger.pulls;
    mean_m_ += forward_m * std::min(1.0f, dt_s / kMean_s);
}

MenuInput MenuControls::step(const platform::WindowInput& input, const platform::Window* window,
                             const std::array<Pointing, 2>& fingers, const MenuSurface& surface, float dt_s) {
    struct DirectionKey {
        int key, button;
        glm::ivec2 direction;
    };
    static constexpr std::array kDirectionKeys = std::to_array<DirectionKey>({
        {GLFW_KEY_UP, GLFW_GAMEPAD_BUTTON_DPAD_UP, {0, -1}},
        {GLFW_KEY_DOWN, GLFW_GAMEPAD_BUTTON_DPAD_DOWN, {0, 1}},
        {GLFW_KEY_LEFT, GLFW_GAMEPAD_BUTTON_DPAD_LEFT, {-1, 0}},
        {GLFW_KEY_RIGHT, GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, {1, 0}},
        {GLFW_KEY_PAGE_UP, GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, {-1, 0}},
        {GLFW_KEY_PAGE_DOWN, GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER, {1, 0}},
    });
    MenuInput menu;
    const platform::Gamepad& pad = input.gamepad;
    glm::ivec2 held(stepOf(pad.leftStick.x), -stepOf(pad.leftStick.y)), steps(0);
    for (const DirectionKey& key : kDirectionKeys) {
        steps += key.direction * static_cast<int>(std::ranges::count(input.keysPressed, key.key));
        if (has(pad.pressed, key.button)) steps += key.direction;
        if ((window && window->down(key.key)) || pad.down[key.button]) held += key.direction;
    }
    held = glm::clamp(held, -1, 1);
    if (held != held_) {
        repeat_s_ = kRepeatFirst_s;
        if (steps == glm::ivec2(0) && held_ == glm::ivec2(0)) steps = held; // the stick's first step
    } else if (held != glm::ivec2(0) && (repeat_s_ -= dt_s) <= 0) {
        repeat_s_ = kRepeat_s;
        steps += held;
    }
    held_ = held;
    menu.down = steps.y;
    menu.right = steps.x;
    menu.accept = has(input.keysPressed, GLFW_KEY_ENTER) || has(input.keysPressed, GLFW_KEY_KP_ENTER) ||
                  has(input.keysPressed, GLFW_KEY_SPACE) || has(pad.pressed, GLFW_GAMEPAD_BUTTON_A);
    menu.back = has(input.keysPressed, GLFW_KEY_ESCAPE) || input.middlePressed ||
                has(pad.pressed, GLFW_GAMEPAD_BUTTON_B);
    if (surface.mouse) {
        if (input.cursorMoved != glm::dvec2(0) || input.leftPressed || input.leftButton) {
            const float across = static_cast<float>(input.cursor.x) * static_cast<float>(surface.eyes);
            menu.pointer = glm::vec2(std::fmod(across, 1.0f), input.cursor.y) * surface.size;
        }
        menu.pressed = input.leftPressed;
        menu.held = input.leftButton;
    }
    menu.wheel = static_cast<float>(input.wheel);
    const bool other = menu.down != 0 || menu.right != 0 || menu.accept || menu.back || menu.pointer;
    fingersRest_s_ = other ? kFingersRest_s : std::max(fingersRest_s_ - dt_s, 0.0f);
    finger_.reset();
    for (size_t i = 0; i < fingers.size(); ++i) {
        pokes_[i].step(fingers[i], dt_s);
        if (!pokes_[i].pointing || fingersRest_s_ > 0) continue;
        finger_ = menu.pointer = pokes_[i].at * surface.size;
        menu.pressed |= pokes_[i].pressed;
        menu.held |= pokes_[i].held;
    }
    return menu;
}

} // namespace shoal::app
