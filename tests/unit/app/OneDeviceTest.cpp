// Every page of the menus is reached, used and left with one device alone, as the window reports it.
#include "engine/gl/Target.h"
#include "engine/platform/Window.h"
#include "game/ui/Hud.h"
#include "game/ui/MenuControls.h"
#include "tests/unit/app/ScreensFixture.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace shoal::app {
namespace {

enum class Device { Keys, Gamepad, Mouse };

class OneDevice : public WithScreens, public testing::WithParamInterface<Device> {
  protected:
    static constexpr glm::ivec2 kSize{640, 360};

    MenuControls controls_;
    std::optional<platform::Headless> context_;
    std::optional<Hud> hud_;
    std::optional<gl::Target> target_;
    TextSettings text_;

    void SetUp() override {
        WithScreens::SetUp();
        screens_.facts.headset = true;
        ASSERT_TRUE(platform::Headless::open().moveTo(context_));
        ASSERT_TRUE(Hud::make().moveTo(hud_));
        target_.emplace(kSize.x, kSize.y, 1);
        open(Screen::Title);
    }

    void open(Screen screen) {
        screens_.open(screen);
        frame({});
    }
    // Passes on the device's input since the last frame, and draws.
    void frame(const platform::WindowInput& input) {
        screens_.input(controls_.step(input, nullptr, {}, {kSize}, 1.0f / 60));
        target_->bind();
        hud_->draw({.part = HudPart::Panel,
                    .inDive = false,
                    .overlay = [this](const Pen& pen) { screens_.draw(pen); },
                    .text = text_,
                    .notice = {}},
                   kSize);
    }

    void step(int key, int button) {
        platform::WindowInput input;
        if (GetParam() == Device::Keys)
            input.keysPressed = {key};
        else
            input.gamepad.pressed = {button};
        frame(input);
        frame({});
    }
    // share: of the item's width, where the pointer presses.
    void click(size_t item, float share = 0.5f) {
        platform::WindowInput input;
        for (int notches = 0; !screens_.menu().areaOf(item) && notches < 100; ++notches) {
            input.wheel = notches < 50 ? -1 : 1;
            frame(input);
        }
        const auto area = screens_.menu().areaOf(item);
        ASSERT_TRUE(area) << page().items[item].label;
        input = {.cursor = glm::dvec2(glm::mix(area->low.x, area->high.x, share),
                                      (area->low.y + area->high.y) / 2) /
                           glm::dvec2(kSize),
                 .cursorMoved = {1, 1}};
        frame(input);
        input.leftPressed = input.leftButton = true;
        frame(input);
        frame({.cursor = input.cursor});
    }
    void focus(size_t item) {
        for (size_t steps = 0; screens_.menu().focus() != item && steps < 100; ++steps)
            step(GLFW_KEY_DOWN, GLFW_GAMEPAD_BUTTON_DPAD_DOWN);
    }
    void choose(std::string_view label) {
        const size_t item = find(label);
        ASSERT_LT(item, page().items.size()) << label << " is not on the page " << page().title;
        if (GetParam() == Device::Mouse) return click(item);
        focus(item);
        step(GLFW_KEY_ENTER, GLFW_GAMEPAD_BUTTON_A);
    }
    void back() {
        if (GetParam() == Device::Mouse) return choose("Back");
        step(GLFW_KEY_ESCAPE, GLFW_GAMEPAD_BUTTON_B);
    }
    Request::Kind asked() { return screens_.takeRequest().value_or(Request{Request::Kind::Title}).kind; }
};

TEST_P(OneDevice, ReachesEveryPageFromTheTitleAndComesBack) {
    std::set<Screen> seen;
    screens_.facts.met = {"snapper"};
    for (const char* label :
         {"Dive", "Free swim", "My film or photo", "Settings", "How to play", "Field guide"}) {
        choose(label);
        seen.insert(*screens_.top());
        if (*screens_.top() == Screen::Guide) {
            choose("snapper");
            seen.insert(*screens_.top());
            back();
            ASSERT_EQ(screens_.top(), Screen::Guide);
        }
        if (*screens_.top() == Screen::Settings)
            for (const char* group :
                 {"Hands", "Comfort", "Picture", "Sound", "Text and captions", "Keys and buttons"}) {
                choose(group);
                seen.insert(*screens_.top());
                back();
                ASSERT_EQ(screens_.top(), Screen::Settings) << group;
            }
        back();
        ASSERT_EQ(screens_.top(), Screen::Title) << label;
        if (GetParam() == Device::Keys) {
            EXPECT_EQ(page().items[screens_.menu().focus()].label, label) << "where one came from";
        }
    }
    EXPECT_EQ(seen,
              (std::set{Screen::Dives, Screen::Swims, Screen::Films, Screen::Settings, Screen::SettingsGroup,
                        Screen::Bindings, Screen::HowToPlay, Screen::Guide, Screen::Animal}));
    choose("Free swim");
    choose("The reef by night");
    EXPECT_EQ(screens_.takeRequest()->name, "night");
    back();
    choose("Headset");
    EXPECT_EQ(asked(), Request::Kind::Headset);
    choose("Quit");
    EXPECT_EQ(asked(), Request::Kind::Quit);
}

TEST_P(OneDevice, UsesThePagesOfADive) {
    open(Screen::Paused);
    choose("Settings");
    EXPECT_EQ(screens_.top(), Screen::Settings);
    back();
    choose("How to play");
    EXPECT_EQ(screens_.top(), Screen::HowToPlay);
    back();
    choose("Photo mode");
    EXPECT_EQ(asked(), Request::Kind::Photo);
    choose("Resume");
    EXPECT_EQ(asked(), Request::Kind::Resume);
    open(Screen::Results);
    choose("Dive again");
    EXPECT_EQ(asked(), Request::Kind::Restart);
}

TEST_P(OneDevice, ReadsAPageThatIsLongerThanThePicture) {
    text_.scale = 1.6f;
    options_.text.language = LanguageChoice::German;
    open(Screen::HowToPlay);
    EXPECT_TRUE(screens_.menu().areaOf(0)) << "no way back";
    EXPECT_GT(screens_.menu().textBelow(), 0);
    for (int i = 0; i < 10; ++i)
        GetParam() == Device::Mouse ? frame({.wheel = -1})
                                    : step(GLFW_KEY_DOWN, GLFW_GAMEPAD_BUTTON_DPAD_DOWN);
    EXPECT_EQ(screens_.menu().textBelow(), 0);
    EXPECT_TRUE(screens_.menu().areaOf(0));
}

TEST_P(OneDevice, ChangesEverySetting) {
    for (const char* group : {"Hands", "Comfort", "Picture", "Sound", "Text and captions"}) {
        open(Screen::Title);
        choose("Settings");
        choose(group);
        for (size_t item = 0; item + 1 < page().items.size(); ++item) {
            const std::string label = page().items[item].label, before = page().items[item].value;
            // To the right, or to the left from the upper end.
            for (const bool right : {true, false}) {
                if (page().items[item].value != before) break;
                if (GetParam() == Device::Mouse) {
                    click(item, right ? 0.97f : 0.6f);
                    continue;
                }
                focus(item);
                step(right ? GLFW_KEY_RIGHT : GLFW_KEY_LEFT,
                     right ? GLFW_GAMEPAD_BUTTON_DPAD_RIGHT : GLFW_GAMEPAD_BUTTON_DPAD_LEFT);
            }
            EXPECT_NE(page().items[item].value, before) << label;
            options_ = PlayOptions(); // the text would grow, and change its language
            screens_.refresh();
            frame({});
        }
    }
}

std::string deviceName(const testing::TestParamInfo<Device>& device) {
    return device.param == Device::Keys ? "Keys" : device.param == Device::Gamepad ? "Gamepad" : "Mouse";
}
INSTANTIATE_TEST_SUITE_P(Alone, OneDevice, testing::Values(Device::Keys, Device::Gamepad, Device::Mouse),
                         deviceName);

} // namespace
} // namespace shoal::app
