// The program in a window, played with a gamepad alone: GLFW and our rumble find it where Linux has one.
#include "engine/media/Pictures.h"
#include "game/app/Application.h"
#include "game/rules/Dive.h"
#include "game/settings/KeptFiles.h"
#include "tests/Recorded.h"
#include "tests/Test.h"
#include "tests/gl/gamepad/fake/FakeGamepad.h"
#include "tests/gl/xr/VirtualDisplay.h"

#include <atomic>
#include <semaphore>
#include <thread>

namespace shoal::app {
namespace {

using test::fakeGamepad;

// A player with the pad, on a thread of its own. It runs only while the program waits for it in a frame, so
// that neither sees a state that the other has half changed.
class Player {
  public:
    Player(Application& application, std::function<void(Player&)> plays) : application_(application) {
        fakeGamepad().onPoll = [this] {
            if (over_) return;
            toPlayer_.release();
            toProgram_.acquire();
        };
        thread_ = std::thread([this, plays = std::move(plays)] {
            toPlayer_.acquire();
            plays(*this);
            over_ = true;
            toProgram_.release();
        });
    }
    ~Player() {
        fakeGamepad().onPoll = {};
        ended_ = true; // no frame comes any more
        toPlayer_.release();
        thread_.join();
    }

    void wait(int frames) {
        for (int poll = 0; poll < 2 * frames && !ended_; ++poll) { // GLFW reads the pad twice a frame
            toProgram_.release();
            toPlayer_.acquire();
        }
    }
    void tap(int button) {
        fakeGamepad().press(button);
        wait(2);
        fakeGamepad().release(button);
        wait(2);
    }
    void tapHat(int axis, int value) {
        fakeGamepad().move(axis, value);
        wait(2);
        fakeGamepad().move(axis, 0);
        wait(2);
    }
    void choose(std::string_view label) {
        const Menu& menu = application_.screens().menu();
        const auto item = std::ranges::find(menu.page().items, label, &MenuItem::label);
        ASSERT_NE(item, menu.page().items.end()) << label << " is not on the page " << menu.page().title;
        const auto wanted = static_cast<size_t>(item - menu.page().items.begin());
        for (int steps = 0; menu.focus() != wanted && steps < 30; ++steps)
            tapHat(ABS_HAT0Y, menu.focus() < wanted ? 1 : -1);
        tap(BTN_SOUTH);
    }
    std::optional<Screen> page() const { return application_.screens().top(); }
    std::string focused() const {
        const Menu& menu = application_.screens().menu();
        return menu.page().items[menu.focus()].label;
    }
    const std::string& error() const { return application_.screens().menu().page().error; }

  private:
    Application& application_;
    std::binary_semaphore toPlayer_{0}, toProgram_{0};
    std::atomic<bool> over_ = false, ended_ = false;
    std::thread thread_;
};

class GamepadProgram : public testing::Test {
  protected:
    tests::ScratchFolder folder_;

    void SetUp() override {
        static const test::VirtualDisplay display; // of all cases
        if (!display) GTEST_SKIP() << "needs Xvfb";
        for (const char* name : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "HOME", "XDG_PICTURES_DIR"})
            ::setenv(name, folder_.path().c_str(), 1);
        ::setenv("LC_ALL", "C", 1);
    }
    static PlayOptions options() {
        PlayOptions o;
        o.seed = 1;
        o.mute = true;
        o.vsync = false;
        o.quality = QualityControl::Fixed;
        o.shadows = ShadowChoice::Off; // half of a frame's time on the processor
        o.look.size = {160, 90};
        o.fps = 60;
        return o;
    }
    static void play(const PlayOptions& options, const std::function<void(Player&)>& plays) {
        Application application(options);
        ASSERT_TRUE(tests::succeeded(application.open()));
        ASSERT_TRUE(fakeGamepad().opened()) << "the window's library reads no pad";
        Player player(application, plays);
        EXPECT_TRUE(tests::succeeded(application.run(true)));
    }
};

TEST_F(GamepadProgram, EveryScreenAndASettingThatStays) {
    play(options(), [](Player& p) {
        p.wait(3);
        EXPECT_EQ(p.page(), Screen::Title);
        for (const char* label : {"My film or photo", "How to play", "Field guide"}) {
            p.choose(label);
            EXPECT_NE(p.page(), Screen::Title) << label;
            p.tap(BTN_EAST);
            EXPECT_EQ(p.page(), Screen::Title) << label;
        }
        p.choose("Settings");
        p.choose("Comfort");
        EXPECT_EQ(p.page(), Screen::SettingsGroup);
        p.choose("Turning"); // in steps; smooth again, and in steps
        p.tapHat(ABS_HAT0X, -1);
        p.tapHat(ABS_HAT0X, -1);
        p.tap(BTN_EAST);
        p.tap(BTN_EAST);
        p.choose("Free swim");
        p.choose("The reef");
        p.wait(3);
        EXPECT_EQ(p.page(), std::nullopt);
        p.tap(BTN_START);
        EXPECT_EQ(p.page(), Screen::Paused);
        p.tap(BTN_EAST);
        EXPECT_EQ(p.page(), std::nullopt);
        p.tap(BTN_START);
        p.choose("Photo mode");
        EXPECT_EQ(p.page(), std::nullopt);
        p.tap(BTN_EAST);
        EXPECT_EQ(p.page(), Screen::Paused);
        EXPECT_EQ(p.focused(), "Photo mode");
        p.choose("Title screen");
        p.wait(3);
        EXPECT_EQ(p.page(), Screen::Title);
        p.choose("Quit");
    });
    PlayOptions kept;
    loadSettings(settingsOf(kept));
    EXPECT_EQ(kept.controls.turning, Turning::Snap);
}

// With or without a camera: it is looked for until it is there.
TEST_F(GamepadProgram, AWebcamThatIsChosenInTheSettingsIsThereAtOnce) {
    play(options(), [](Player& p) {
        p.wait(3);
        p.choose("Settings");
        p.choose("Hands");
        for (int steps = 0; steps < 3; ++steps) p.tapHat(ABS_HAT0X, 1); // auto, mouse, leap, webcam
        p.wait(3);
        p.choose("Measure my hand");
        EXPECT_EQ(p.page(), Screen::HandSize);
        p.tap(BTN_EAST);
        EXPECT_EQ(p.page(), Screen::SettingsGroup);
        p.tap(BTN_EAST);
        p.tap(BTN_EAST);
        p.choose("Quit");
    });
}

// If a setting has to reload a film that is gone, the title appears over the dive's own film and says so.
TEST_F(GamepadProgram, ASettingThatCannotTakeEffectIsSaidOnTheTitle) {
    const Path film = folder_.path() / "film.png";
    ASSERT_TRUE(media::writePng(film, ImageRgb8(64, 32)));
    PlayOptions o = options();
    o.environment.photo = film;
    o.environment.layout = media::Layout::Mono; // or it would be grown
    o.start = Start::Title;
    play(o, [&](Player& p) {
        p.wait(3);
        std::filesystem::remove(film);
        p.choose("Settings");
        p.choose("Picture");
        p.choose("Animals in the film");
        p.wait(3);
        EXPECT_EQ(p.page(), Screen::Title);
        EXPECT_NE(p.error().find("film.png"), std::string::npos) << p.error();
        p.choose("Quit");
    });
}

// A dive of five seconds, the shortest that there is, to its end.
TEST_F(GamepadProgram, TheResultsLeadToAnotherDiveAndToTheTitle) {
    std::filesystem::copy_file(dataRoot() / "content/species.toml", folder_ / "species.toml");
    const Path dive = folder_ / "short.toml";
    std::ofstream(dive) << "title = \"Short\"\nvideo = \"video/night.mp4\"\nduration = 5\n\n[[school]]\n"
                           "species = \"idol\"\ncount = 1\nradius = [1, 2]\nheight = [0, 0.5]\n";
    PlayOptions o = options();
    o.start = Start::Dive;
    o.dive = dive;
    play(o, [](Player& p) {
        constexpr int kMaxFrames = 100000; // more than any machine draws in the time
        for (int i = 0; i < kMaxFrames && p.page() != Screen::Results; i += 10) p.wait(10);
        ASSERT_EQ(p.page(), Screen::Results);
        for (int i = 0; i < kMaxFrames && p.page() == Screen::Results; ++i) p.tap(BTN_SOUTH); // rests first
        p.wait(3);
        EXPECT_EQ(p.page(), std::nullopt) << "the focus is on: dive again";
        p.tap(BTN_START);
        p.choose("Title screen");
        p.wait(3);
        EXPECT_EQ(p.page(), Screen::Title);
        p.choose("Quit");
    });
}

// The recording has what the hands did.
TEST_F(GamepadProgram, TheRightStickReachesAndTheTriggerClosesByDegrees) {
    PlayOptions o = options();
    o.start = Start::Dive;
    o.timedemo = true; // a frame is a 60th of a second
    o.record = folder_.path() / "a.replay";
    play(o, [](Player& p) {
        p.wait(60);
        fakeGamepad().move(ABS_RX, -32768);
        p.wait(60);
        fakeGamepad().move(ABS_RX, 0);
        fakeGamepad().move(ABS_RZ, 128);
        p.wait(60);
        fakeGamepad().move(ABS_RZ, 255);
        p.wait(60);
        p.tap(BTN_START);
        p.choose("Quit");
    });
    const auto recording = tests::valueOf(tests::readRecorded(o.record));
    float leftmost = 1, rightmost = -1;
    std::vector<float> grips;
    for (size_t tick = 0; tick < recording.ticks(); ++tick) {
        const auto input = tests::inputAt(recording, tick);
        const hands::HandPose& hand = input.hands[1];
        leftmost = std::min(leftmost, hand.joints[hands::kPalmJoint].position.x);
        rightmost = std::max(rightmost, hand.joints[hands::kPalmJoint].position.x);
        grips.push_back(hand.grip);
    }
    EXPECT_GT(rightmost - leftmost, 0.1f); // metres
    const float open = grips[30], closed = *std::ranges::max_element(grips);
    EXPECT_LT(open, 0.05f);
    EXPECT_GT(closed, 0.95f);
    // It rested between: a second is 120 ticks, of which closing takes some 15.
    size_t rested = 0;
    for (size_t tick = 1; tick < grips.size(); ++tick)
        rested += grips[tick] > 0.2f && grips[tick] < 0.8f && std::abs(grips[tick] - grips[tick - 1]) < 1e-3f;
    EXPECT_GT(rested, 90u);
}

TEST_F(GamepadProgram, ACatchIsFeltInThePadAndStops) {
    PlayOptions o = options();
    o.hands.source = "script:" + (dataRoot() / "tests/playthrough/first_catch.toml").string();
    const size_t before = fakeGamepad().felt().size();
    play(o, [](Player&) {});
    const std::vector<test::Rumble> felt = fakeGamepad().felt();
    ASSERT_GT(felt.size(), before + 5);
    const auto strongest =
        std::ranges::max_element(felt, {}, [](const test::Rumble& r) { return std::max(r.strong, r.weak); });
    EXPECT_GT(std::max(strongest->strong, strongest->weak), 40000); // a catch is a blow: 0.8 of 65535
    EXPECT_EQ(felt.back().strong, 0);
    EXPECT_EQ(felt.back().weak, 0);
}

} // namespace
} // namespace shoal::app
