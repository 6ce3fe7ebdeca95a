// The menus: settings hold at once; every word has its translations; text can be read over white and black.
#include "game/ui/Menu.h"
#include "engine/gl/Target.h"
#include "engine/math/Colour.h"
#include "engine/platform/Window.h"
#include "game/app/Screens.h"
#include "game/ui/Hud.h"

#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <imgui/imgui.h>

#include <cctype>

namespace shoal::app {
namespace {

// The screens of a program that keeps its files in a scratch folder and speaks English.
class WithScreens : public testing::Test {
  protected:
    tests::ScratchFolder folder_;
    PlayOptions options_;
    Bindings bindings_;
    Screens screens_{options_, bindings_};
    game::SpeciesTable species_{{.name = "snapper",
                                 .one = {"snapper", "Schnapper", "vivaneau"},
                                 .several = {"snappers", "Schnapper", "vivaneaux"}}};
    game::DiveFile dive_;

    void SetUp() override {
        for (const char* variable : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "HOME"})
            ::setenv(variable, folder_.path().c_str(), 1);
        ::setenv("LC_ALL", "C", 1);
        screens_.facts.species = &species_;
        screens_.facts.dive = &dive_;
        screens_.facts.dives = {{.name = "reef", .title = "The reef"},
                                {.name = "night", .title = "The reef by night"}};
        screens_.facts.allScores["night"] = {.top = {90}, .stars = 2, .allStars = 2};
    }

    const MenuPage& page() const { return screens_.menu().page(); }
    size_t find(std::string_view label) const {
        const auto item = std::ranges::find(page().items, label, &MenuItem::label);
        return static_cast<size_t>(item - page().items.begin());
    }
};

class MenuTest : public WithScreens {
  protected:
    void SetUp() override {
        WithScreens::SetUp();
        screens_.open(Screen::Title);
    }

    // With the arrow keys and Enter.
    void choose(std::string_view label) {
        ASSERT_LT(find(label), page().items.size()) << label << " is not on the page " << page().title;
        const auto wanted = static_cast<int>(find(label)),
                   focused = static_cast<int>(screens_.menu().focus());
        screens_.input({.down = wanted - focused});
        screens_.input({.accept = true});
    }
    std::optional<Request> asked() { return screens_.takeRequest(); }
};

// The first item and the last one are ends, as the last one quits the game.
TEST_F(MenuTest, NoStepLeadsFromOneEndToTheOther) {
    for (const Screen screen : {Screen::Title, Screen::Paused, Screen::Results}) {
        screens_.open(screen);
        screens_.input({.down = -1});
        EXPECT_EQ(screens_.menu().focus(), 0u);
        screens_.input({.down = 100});
        EXPECT_EQ(page().items[screens_.menu().focus()].label, "Quit");
        screens_.input({.down = 1});
        EXPECT_EQ(page().items[screens_.menu().focus()].label, "Quit");
    }
}

TEST_F(MenuTest, TheLastDiveHasTheFocus) {
    dive_.name = "night";
    for (const char* label : {"Dive", "Free swim"}) {
        choose(label);
        EXPECT_EQ(screens_.menu().focus(), 1u);
        choose("Back");
    }
    screens_.open(Screen::Results);
    choose("Choose a dive");
    EXPECT_EQ(screens_.menu().focus(), 1u);
}

TEST_F(MenuTest, ThePageOfFilmsNamesItsFoldersAndFiles) {
    choose("My film or photo");
    ASSERT_EQ(page().text.size(), 3u);
    for (const auto folder : {UserFolder::Videos, UserFolder::Pictures, UserFolder::Downloads})
        EXPECT_NE(page().text[1].find(userFolder(folder).string()), std::string::npos);
    EXPECT_NE(page().text[2].find("MP4"), std::string::npos);
}

TEST_F(MenuTest, AChangeHoldsAtOnceAndIsWritten) {
    choose("Settings");
    choose("Sound");
    ASSERT_EQ(page().items[0].label, "Volume");
    screens_.input({.right = -1});
    EXPECT_NEAR(options_.volume, 0.75f, 1e-5f);
    EXPECT_EQ(page().items[0].value, "75 %");
    EXPECT_EQ(asked()->kind, Request::Kind::SettingsChanged);
    PlayOptions again;
    loadSettings(settingsOf(again));
    EXPECT_NEAR(again.volume, 0.75f, 1e-5f);
}

TEST_F(MenuTest, TheLanguageChangesThePage) {
    choose("Settings");
    choose("Text and captions");
    ASSERT_EQ(page().items[0].label, "Language");
    EXPECT_EQ(page().items[0].value, "automatic");
    screens_.input({.right = 1});
    EXPECT_EQ(page().items[0].value, "English");
    screens_.input({.right = 1}); // German
    EXPECT_EQ(options_.text.language, LanguageChoice::German);
    EXPECT_EQ(page().items[0].label, "Sprache");
    EXPECT_EQ(page().items[0].value, "Deutsch");
}

// A text that is the same in two languages is in the table with both, or is not a word: a number, or the name
// of a key or button as it is printed there.
TEST_F(MenuTest, NoWordOfThePagesIsOutsideTheTable) {
    const auto wordsIn = [&](LanguageChoice language) {
        options_.text.language = language;
        std::vector<std::string> words;
        const auto add = [&] {
            screens_.refresh();
            for (const std::string& text : page().text) words.push_back(text);
            for (const MenuItem& item : page().items) words.insert(words.end(), {item.label, item.value});
            words.insert(words.end(), {page().title, page().note});
        };
        for (const Screen screen : {Screen::Title, Screen::Dives, Screen::Films, Screen::HowToPlay,
                                    Screen::Guide, Screen::Paused, Screen::Results, Screen::Settings}) {
            screens_.open(screen);
            add();
            for (int lesson = 0; screen == Screen::HowToPlay && lesson < 3; ++lesson) {
                screens_.input({.accept = true});
                add();
            }
        }
        for (size_t group = 0, groups = page().items.size() - 1; group < groups; ++group) {
            screens_.open(Screen::Settings);
            screens_.input({.down = static_cast<int>(group)});
            screens_.input({.accept = true});
            add();
        }
        screens_.open(Screen::HandSize);
        for (const float rigDistance_m : {0.0f, 1.0f, 0.3f}) {
            screens_.facts.handSizing = {};
            if (rigDistance_m > 0) screens_.facts.handSizing.see(rigDistance_m, 0.01f);
            add();
        }
        return words;
    };
    screens_.facts.met = {{.species = "snapper"}};
    const auto english = wordsIn(LanguageChoice::English), german = wordsIn(LanguageChoice::German);
    ASSERT_EQ(english.size(), german.size());
    EXPECT_GT(english.size(), 100u);
    size_t same = 0;
    for (size_t i = 0; i < english.size(); ++i) {
        if (english[i] != german[i] || english[i].size() < 3 || english[i] == "Shoal") continue;
        const std::string word = english[i].substr(0, english[i].find("  (")); // a button
        const bool isWord = std::ranges::any_of(word, [](char c) { return std::islower(c) != 0; });
        same += isWord;
        if (isWord) {
            EXPECT_LT(game::findText(word), game::kTexts.size()) << word;
        }
    }
    EXPECT_LT(same, 20u);
}

// The page exists only with a webcam, whose picture it shows.
TEST_F(MenuTest, TheHandIsMeasuredOnAPageOfTheHandsSettings) {
    choose("Settings");
    choose("Hands");
    EXPECT_EQ(find("Measure my hand"), page().items.size());
    EXPECT_FALSE(page().camera);
    screens_.facts.webcam = true;
    screens_.refresh();
    EXPECT_TRUE(page().camera);
    EXPECT_TRUE(page().text.empty());
    screens_.facts.handsNeed =
        game::Notice{"Before the webcam can find your hands, run this once: {}", "get_models"};
    screens_.refresh();
    ASSERT_EQ(page().text.size(), 1u);
    EXPECT_NE(page().text[0].find("run this once: get_models"), std::string::npos);
    choose("Measure my hand");
    ASSERT_EQ(screens_.top(), Screen::HandSize);
    EXPECT_TRUE(page().camera);
    EXPECT_EQ(page().progress, 0.0f);
    const auto hold = [&](float rigDistance_m) {
        for (int i = 0; i < 200; ++i) screens_.facts.handSizing.see(rigDistance_m, 1.0f / 60);
        screens_.refresh();
        return page().note;
    };
    EXPECT_NE(hold(1).find("30 cm"), std::string::npos);
    options_.hands.size = 0.9f;
    EXPECT_NE(hold(hands::HandSizing::kAt_m / 0.9f).find("90 %"), std::string::npos);
    EXPECT_EQ(page().progress, 1.0f);
    choose("Back");
    EXPECT_EQ(screens_.top(), Screen::SettingsGroup);
}

TEST_F(MenuTest, AKeyThatIsTakenIsSaid) {
    choose("Settings");
    choose("Keys and buttons");
    choose("Swap hands");
    ASSERT_TRUE(screens_.capturesKey());
    screens_.input({.back = true}); // is no input for the menus now
    ASSERT_TRUE(screens_.capturesKey());
    screens_.capture({.keysPressed = {GLFW_KEY_P}});
    EXPECT_FALSE(screens_.capturesKey());
    EXPECT_EQ(bindings_.of(Action::SwapHands).keys[0], GLFW_KEY_P);
    EXPECT_EQ(bindings_.of(Action::Pause).keys[1], -1);
    EXPECT_EQ(page().note, "Until now it was for “Pause”, which still has: Escape  (Start)");
    Bindings read;
    ASSERT_TRUE(read.parse(options_.controls.bindings)) << options_.controls.bindings;
    EXPECT_EQ(read.of(Action::SwapHands).keys, bindings_.of(Action::SwapHands).keys);
    EXPECT_EQ(read.of(Action::Pause).keys, bindings_.of(Action::Pause).keys);
    choose("Fullscreen");
    screens_.capture({.keysPressed = {GLFW_KEY_F1}});
    EXPECT_EQ(page().note, "Until now it was for “Technical details”, which has no key or button any more");
    EXPECT_EQ(page().items[find("Technical details")].value, "none");
}

// An arrow key that leads over the rows gives none of them a key.
TEST_F(MenuTest, OnlyAcceptingAsksForAKey) {
    choose("Settings");
    choose("Keys and buttons");
    screens_.input({.right = 1});
    EXPECT_FALSE(screens_.capturesKey());
    choose("Look up");
    EXPECT_TRUE(screens_.capturesKey());
    screens_.capture({.leftPressed = true});
    EXPECT_EQ(bindings_.toText(), "");
    EXPECT_EQ(page().items[find("Reach farther")].value, "E, Page up  (Pad up)");
}

// With mouse and keys there is one lesson more than in a headset.
TEST_F(MenuTest, TheLessonsFollowEachOtherWithTheirPictures) {
    for (const bool xr : {false, true}) {
        options_.xr = xr;
        screens_.open(Screen::HowToPlay);
        std::set<std::string> pictures;
        for (int lesson = 0; lesson < (xr ? 3 : 4); ++lesson) {
            EXPECT_TRUE(tests::succeeded(readSmallPicture(dataRoot() / "content" / page().picture)));
            EXPECT_TRUE(pictures.insert(page().picture).second) << page().picture;
            choose("Next");
        }
        EXPECT_TRUE(pictures.contains(page().picture));
        screens_.input({.back = true});
    }
}

TEST_F(MenuTest, AMutedGameOffersNoVolume) {
    const auto rowsOfSound = [&] {
        screens_.open(Screen::Settings);
        choose("Sound");
        return page().items.size();
    };
    const size_t all = rowsOfSound();
    options_.mute = true;
    EXPECT_EQ(rowsOfSound(), all - 6);
}

TEST_F(MenuTest, DivesInThePlayersOwnFilmSaySo) {
    choose("Dive");
    EXPECT_EQ(page().text, std::vector<std::string>{"Stars in all: 2"});
    options_.environment.photo = "/home/me/beach.jpg";
    screens_.open(Screen::Dives);
    EXPECT_THAT(page().text, testing::Contains("All dives are in beach.jpg"));
}

TEST_F(MenuTest, TheResultsLeadToAnyDive) {
    screens_.open(Screen::Results);
    choose("Choose a dive");
    EXPECT_EQ(screens_.top(), Screen::Dives);
    choose("Back");
    EXPECT_EQ(screens_.top(), Screen::Results);
    choose("Choose a dive");
    choose("The reef by night  \u2605\u2605\u2606 90");
    const auto request = tests::valueOf(asked());
    EXPECT_EQ(request.kind, Request::Kind::Dive);
    EXPECT_EQ(request.name, "night");
}

TEST_F(MenuTest, OneIsOneAndTwoAreSeveral) {
    screens_.facts.results.caught = 3;
    screens_.facts.results.tally.resize(1);
    for (const auto& [count, english, french] : {std::tuple(1, "\u00d71 snapper", "\u00d71 vivaneau"),
                                                 {3, "\u00d73 snappers", "\u00d73 vivaneaux"}}) {
        screens_.facts.results.tally[0].caught = count;
        for (const auto& [language, want] :
             {std::pair(LanguageChoice::English, english), {LanguageChoice::French, french}}) {
            options_.text.language = language;
            screens_.open(Screen::Results);
            EXPECT_EQ(page().gallery.at(0).count + " " + page().gallery.at(0).caption, want);
        }
    }
}

TEST_F(MenuTest, LeftAndRightTurnThePagesOfAnimalsThatWereMet) {
    species_ = {{.name = "ray"}, {.name = "idol"}, {.name = "shark"}, {.name = "snapper"}};
    screens_.facts.met = {{.species = "snapper", .caught = 2, .largest_m = 0.314f},
                          {.species = "shark"},
                          {.species = "ray", .dive = "The reef", .date = "2026-01-31"}};
    choose("Field guide");
    choose("Ray");
    EXPECT_THAT(page().text, testing::Contains("First met: The reef, 2026-01-31"));
    screens_.input({.right = 1});
    EXPECT_EQ(page().title, "Shark");
    choose("Next animal");
    EXPECT_EQ(page().title, "Snapper");
    EXPECT_THAT(page().text, testing::Contains("Caught: 2   Longest: 31 cm"));
    screens_.input({.right = 1});
    EXPECT_EQ(page().title, "Ray");
    choose("Previous animal");
    EXPECT_EQ(page().title, "Snapper");
    screens_.input({.back = true});
    EXPECT_EQ(screens_.top(), Screen::Guide);
}

TEST_F(MenuTest, ARareAnimalIsASilhouetteUntilItIsMet) {
    species_ = {{.name = "snapper"}, {.name = "golden_ray"}};
    screens_.facts.dives[1].rare = {{"golden_ray", 20}};
    choose("Field guide");
    EXPECT_FALSE(page().items[0].enabled);
    choose("?   \u2605 20");
    EXPECT_EQ(page().title, "?");
    EXPECT_EQ(page().picture, "guide/golden_ray.dark.png");
    EXPECT_FALSE(screens_.animalBeside());
    EXPECT_EQ(page().text.at(0), "20 stars bring it to you. Dive: The reef by night");
    screens_.facts.met = {{.species = "golden_ray"}};
    screens_.refresh();
    EXPECT_EQ(page().picture, "") << "the model turns beside the page";
    EXPECT_EQ(screens_.animalBeside(), size_t{1});
    options_.xr = true;
    screens_.refresh();
    EXPECT_EQ(page().picture, "guide/golden_ray.png");
    EXPECT_FALSE(screens_.animalBeside());
}

TEST_F(MenuTest, EachKindOfGoalHasItsWords) {
    screens_.facts.results.goals.clear();
    for (size_t kind = 0; kind < game::kGoalNames.size(); ++kind) {
        dive_.goals.push_back({.kind = static_cast<game::GoalKind>(kind), .count = 3});
        screens_.facts.results.goals.push_back({.goal = static_cast<int>(kind)});
    }
    dive_.goals[static_cast<size_t>(game::GoalKind::First)] = {game::GoalKind::First, 0};
    const auto lines = screens_.goalLines(screens_.facts.results.goals);
    EXPECT_EQ(std::set(lines.begin(), lines.end()).size(), game::kGoalNames.size());
    EXPECT_EQ(lines[static_cast<size_t>(game::GoalKind::First)], "\u2606 First catch: snapper");
    EXPECT_EQ(lines[static_cast<size_t>(game::GoalKind::Quick)], "\u2606 Catch 3 fish within 20 seconds");
    dive_.goals[0].species = 0;
    EXPECT_EQ(screens_.goalLines(std::array{game::GoalView{0, 1, false}})[0],
              "\u2606 Catch 3 snappers\u00a0\u00a01/3");
    species_[0].thing = game::Thing::Bottle;
    EXPECT_EQ(screens_.goalLines(std::array{game::GoalView{0, 3, true}})[0],
              "\u2605 Take 3 snappers out of the sea");
}

TEST(FieldGuide, EachAnimalHasItsPicture) {
    for (const game::Species& kind : tests::valueOf(game::loadSpecies(dataRoot() / "content/species.toml")))
        EXPECT_TRUE(tests::succeeded(readSmallPicture(dataRoot() / "content/guide" / (kind.name + ".png"))));
}

TEST(Bindings, MalformedTextChangesNothing) {
    for (const char* text : {"close=Nothing,- A", "jump=Space,- A", "close=Space,- Z", "close", "=,"}) {
        Bindings bindings;
        EXPECT_FALSE(bindings.parse(text)) << text;
        EXPECT_EQ(bindings.toText(), "") << text;
    }
    EXPECT_TRUE(Bindings().parse(""));
}

size_t placeholders(std::string_view text) {
    size_t count = 0;
    for (size_t at = text.find("{}"); at != std::string_view::npos; at = text.find("{}", at + 2)) ++count;
    return count;
}

TEST(Texts, EachIsThereOnceInEachLanguageWithTheSamePlaceholders) {
    std::set<std::string_view> seen;
    for (const game::TextRow& row : game::kTexts) {
        EXPECT_TRUE(seen.insert(row[0]).second) << row[0] << " is there twice";
        for (const char* text : row) {
            ASSERT_TRUE(text && *text) << row[0];
            EXPECT_EQ(placeholders(text), placeholders(row[0])) << text;
        }
    }
}

TEST(Texts, DivesAndTheirAnimalsHaveTranslations) {
    const auto names = game::diveNames();
    EXPECT_GE(names.size(), 3u);
    for (const std::string& name : names) {
        const auto files = tests::valueOf(game::loadDiveFiles(name));
        EXPECT_LT(game::findText(files.dive.title), game::kTexts.size()) << files.dive.title;
        for (const game::Species& kind : files.species)
            for (const game::InLanguages* texts : {&kind.one, &kind.several, &kind.fact})
                EXPECT_THAT(*texts, testing::Each(testing::Not(testing::IsEmpty()))) << kind.name;
    }
}

TEST(Texts, AnimalsWithoutATranslationHaveTheirEnglishName) {
    const game::Species perch{.one = {"perch", "Barsch"}, .several = {"perches"}};
    EXPECT_EQ(animalName(perch, 1, game::Language::German), "Barsch");
    EXPECT_EQ(animalName(perch, 1, game::Language::French), "perch");
    EXPECT_EQ(animalName(perch, 2, game::Language::German), "perches");
}

TEST(Texts, TheSystemsLocaleChooses) {
    EXPECT_EQ(game::languageOf("de_AT.UTF-8"), game::Language::German);
    EXPECT_EQ(game::languageOf("fr"), game::Language::French);
    EXPECT_EQ(game::languageOf("nl_NL"), game::Language::English);
    EXPECT_EQ(game::languageOf("C"), game::Language::English);
}

// A picture, and the Hud to draw in it.
struct Picture {
    static constexpr glm::ivec2 kSize{640, 360};
    platform::Headless context = tests::valueOf(platform::Headless::open());
    Hud hud = tests::valueOf(Hud::make());
    gl::Target target{kSize.x, kSize.y, 1};
};

// The fonts beside the game draw every text in each of its sizes; the system's fonts play no part.
TEST(Fonts, HaveEachSignOfTheTexts) {
    ImFontGlyphRangesBuilder signs;
    signs.AddText("\u2713\u25a1\u2605\u2190\u2192\u2039\u203a\u00d7\u00a0"); // those of code
    for (const game::TextRow& row : game::kTexts)
        for (const char* text : row) signs.AddText(text);
    for (const game::Species& kind : tests::valueOf(game::loadSpecies(dataRoot() / "content/species.toml")))
        for (const game::InLanguages* texts : {&kind.one, &kind.several, &kind.fact})
            for (const std::string& text : *texts) signs.AddText(text.c_str());
    Picture picture;
    picture.target.bind();
    const auto look = [&](const Pen& pen) {
        for (const TextSize size : {TextSize::Small, TextSize::Body, TextSize::Heading, TextSize::Display})
            for (uint32_t code = 0; code <= IM_UNICODE_CODEPOINT_MAX; ++code)
                EXPECT_TRUE(!signs.GetBit(code) ||
                            pen.fonts->at(size)->FindGlyphNoFallback(static_cast<ImWchar>(code)))
                    << std::hex << code;
    };
    picture.hud.draw({.part = HudPart::Panel, .inDive = false, .overlay = look, .text = {}, .notice = {}},
                     Picture::kSize);
}

// Returns the linear colour over a grey of this coded value.
glm::dvec3 linearOver(uint32_t abgr, double behind8) {
    const double alpha = (abgr >> 24) / 255.0;
    const auto channel = [&](int shift) {
        return math::linearFromSrgb((alpha * (abgr >> shift & 0xFF) + (1 - alpha) * behind8) / 255);
    };
    return {channel(0), channel(8), channel(16)};
}

// Contrast of WCAG 2.2: that of the relative luminances.
double contrast(const glm::dvec3& linear, const glm::dvec3& on) {
    const glm::dvec3 luminance(0.2126, 0.7152, 0.0722);
    return (glm::dot(linear, luminance) + 0.05) / (glm::dot(on, luminance) + 0.05);
}

// WCAG 2.2, 1.4.3: at least 4.5 to 1.
TEST(Colours, TextOnPanelsIsReadableOverWhiteAndBlack) {
    for (const double behind : {0.0, 128.0, 255.0})
        for (const uint32_t text :
             {colour::kWhite, colour::kGrey, colour::kGold, colour::kOrange, colour::kAccent})
            EXPECT_GE(contrast(linearOver(text, 0), linearOver(colour::kPanel, behind)), 4.5)
                << std::hex << text << " over " << behind;
    for (const uint32_t text : {colour::kWhite, colour::kAccent})
        EXPECT_GE(contrast(linearOver(text, 0), linearOver(colour::kFocus, 0)), 4.5);
}

// WCAG 2.2, 1.4.11: at least 3 to 1 between a mark and its casing, before any picture; also for
// deuteranopes (Machado, Oliveira and Fernandes 2009, "A Physiologically-based Model for Simulation of Color
// Vision Deficiency", table 1).
TEST(Colours, MarksStandOutFromTheirCasing) {
    const glm::dmat3 deuteranope = glm::transpose(glm::dmat3(
        0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881));
    for (int behind = 0; behind <= 255; behind += 5)
        for (const uint32_t mark : {colour::kGold, colour::kWhite, colour::kOrange})
            for (const glm::dmat3& eye : {glm::dmat3(1), deuteranope})
                EXPECT_GE(contrast(eye * linearOver(mark, behind), eye * linearOver(colour::kCasing, behind)),
                          3)
                    << std::hex << mark << " over " << behind;
}

// Captions and goals would lie under the pages of a pause and of the results.
TEST(Hud, DrawsNoCaptionsUnderAMenu) {
    Picture picture;
    const game::Caption caption{game::Text("it stings")};
    const std::string goal = "a goal";
    const render::View view;
    const auto drawn = [&](const game::Snapshot& shown, bool withLines) {
        picture.target.bind();
        glClear(GL_COLOR_BUFFER_BIT);
        HudInfo info{.part = HudPart::Panel, .snapshot = &shown, .view = &view, .text = {}, .notice = {}};
        if (withLines) info.captions = {&caption, 1}, info.goals = {&goal, 1};
        picture.hud.draw(info, Picture::kSize);
        return picture.target.read().pixels;
    };
    game::Snapshot diving, paused, over;
    paused.paused = true;
    over.phase = game::Phase::Results;
    EXPECT_NE(drawn(diving, true), drawn(diving, false));
    EXPECT_EQ(drawn(paused, true), drawn(paused, false));
    EXPECT_EQ(drawn(over, true), drawn(over, false));
}

// A finger that goes forward by 4 cm in a tenth of a second presses once, where it pointed before.
TEST(FingerPoke, AQuickMoveForwardPressesOnceAndASlowOneDoesNot) {
    hands::HandPose hand;
    hand.tracked = true;
    glm::vec3& tip = hand.joints[hands::kFingerJoints[1].tip].position;
    const auto presses = [&](float forward_mps, int frames) {
        FingerPoke poke;
        tip = {0.1f, 0, -0.5f};
        int count = 0;
        for (int frame = 0; frame < frames; ++frame) {
            if (frame > 10) tip.z -= forward_mps / 60;
            poke.step(pointingInView(hand, {1, 0.5f}), 1.0f / 60);
            count += poke.pressed;
            EXPECT_NEAR(poke.at.x, 0.6f, 0.01f);
        }
        return count;
    };
    EXPECT_EQ(presses(0.4f, 18), 1);
    EXPECT_EQ(presses(0.02f, 120), 0);
}

// Otherwise a tracker that sees the hand on the keys would take the focus away in every frame.
TEST(MenuControls, FingersRestWhileKeysOrMouseAreUsed) {
    MenuControls controls;
    std::array<Pointing, 2> fingers;
    fingers[1] = {.points = true, .at = {0.5f, 0.5f}, .forward_m = 0.4f};
    const auto step = [&](const platform::WindowInput& input, float dt_s) {
        return controls.step(input, nullptr, fingers, {}, dt_s);
    };
    EXPECT_TRUE(step({}, 0.01f).pointer);
    platform::WindowInput key, mouse;
    key.keysPressed = {GLFW_KEY_DOWN};
    mouse.cursorMoved = {3, 0};
    mouse.cursor = {0.1, 0.1};
    EXPECT_FALSE(step(key, 0.01f).pointer);
    EXPECT_FALSE(step({}, 0.9f * MenuControls::kFingersRest_s).pointer);
    EXPECT_FALSE(controls.finger());
    EXPECT_TRUE(step({}, 0.2f * MenuControls::kFingersRest_s).pointer);
    EXPECT_NEAR(step(mouse, 0.01f).pointer->x, 0.1f, 1e-6f);
    EXPECT_FALSE(step({}, 0.01f).pointer);
}

// Every page of the menus is reached, used and left with one device alone, as the window reports it.
enum class Device { Keys, Gamepad, Mouse };

class OneDevice : public WithScreens, public testing::WithParamInterface<Device> {
  protected:
    MenuControls controls_;
    Picture picture_;
    TextSettings text_;

    void SetUp() override {
        WithScreens::SetUp();
        screens_.facts.headset = true;
        open(Screen::Title);
    }

    void open(Screen screen) {
        screens_.open(screen);
        frame({});
    }
    // Passes on the device's input since the last frame, and draws.
    void frame(const platform::WindowInput& input) {
        screens_.input(controls_.step(input, nullptr, {}, {Picture::kSize}, 1.0f / 60));
        picture_.target.bind();
        picture_.hud.draw({.part = HudPart::Panel,
                           .inDive = false,
                           .overlay = [this](const Pen& pen) { screens_.draw(pen); },
                           .text = text_,
                           .notice = {}},
                          Picture::kSize);
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
                           glm::dvec2(Picture::kSize),
                 .cursorMoved = {1, 1}};
        frame(input);
        input.leftPressed = input.leftButton = true;
        frame(input);
        frame({.cursor = input.cursor});
    }
    void focus(size_t item) {
        while (screens_.menu().focus() < item) step(GLFW_KEY_DOWN, GLFW_GAMEPAD_BUTTON_DPAD_DOWN);
        while (screens_.menu().focus() > item) step(GLFW_KEY_UP, GLFW_GAMEPAD_BUTTON_DPAD_UP);
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
    screens_.facts.met = {{.species = "snapper"}};
    for (const char* label :
         {"Dive", "Free swim", "My film or photo", "Settings", "How to play", "Field guide"}) {
        choose(label);
        seen.insert(*screens_.top());
        if (*screens_.top() == Screen::Guide) {
            choose("Snapper"); // as a title
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
