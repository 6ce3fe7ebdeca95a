// The pages of the menus: title, settings, pause, results and what they lead to. They change the player's
// settings themselves; all else that the player asks for is a request to the program. Main thread.
#pragma once

#include "game/rules/DiveFile.h"
#include "game/rules/Snapshot.h"
#include "game/session/Controls.h"
#include "game/settings/EditSetting.h"
#include "game/settings/KeptFiles.h"
#include "game/settings/PlayOptions.h"
#include "game/ui/Menu.h"
#include "input/hands/HandSize.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace shoal::app {

enum class Screen {
    Title,
    Dives,
    Swims, // where to swim freely
    Films,
    Settings,
    SettingsGroup,
    HandSize,
    Bindings,
    HowToPlay,
    Guide,
    Animal,
    Paused,
    Results
};

// What the player has asked for.
struct Request {
    enum class Kind {
        Dive,
        SkipFirstSteps,
        Swim,
        OpenFilm,
        OwnFilm,
        Headset,
        Resume,
        Recentre,
        Restart,
        Photo,
        Title,
        Quit,
        SettingsChanged
    };
    Kind kind;
    std::string name; // of the place of a dive or a free swim, or a file
};

struct DiveName {
    std::string name, title;
    std::string picture{}; // in content; empty: none
    int best = 0;          // score; 0: none yet
};

// What the pages show besides settings.
struct ScreenFacts {
    const game::SpeciesTable* species = nullptr;
    const game::DiveFile* dive = nullptr;
    std::vector<DiveName> dives;
    bool headset = false;         // there is one
    bool headsetLost = false;     // in mid-dive, and what is played is in the window since
    bool ownFilm = true;          // the dive's own film is shown
    uint64_t seed = 0;            // of the last dive
    DiveScores scores;            // of this dive, before the last one
    std::vector<std::string> met; // species that the player has touched
    game::Snapshot results;       // as the last dive ended
    bool freeSwim = false, firstSteps = false;
    bool webcam = false;                     // hands come from one
    std::optional<game::Notice> handsNeed{}; // TrackedHands::needs()
    hands::HandSizing handSizing{};          // on the page for that
};

class Screens {
  public:
    // Both outlive this.
    Screens(PlayOptions& options, Bindings& bindings);

    void open(Screen screen); // and no other below it
    void close() { stack_.clear(); }
    void openWithError(Screen screen, std::string error);                         // above the title screen
    void showError(std::string error);                                            // on the page that is open
    void dropped(const std::string& file) { ask(Request::Kind::OpenFilm, file); } // onto the window
    bool isOpen() const { return !stack_.empty(); }
    std::optional<Screen> top() const;
    bool showsCamera() const; // what a webcam sees belongs to the page
    // A text setting of bindings waits for the next key or button, which is no input for the menus.
    bool capturesKey() const { return captured_.has_value(); }

    void input(const MenuInput& input);
    void keyPressed(int key);       // while it captures
    void buttonPressed(int button); // the same
    void cancelCapture();           // a mouse has no key to give
    std::optional<Request> takeRequest();
    void draw(const Pen& pen);
    // Words or numbers that a page shows have changed.
    void refresh();
    // The player has changed this setting by a key of the game: it is kept, and asked to take effect.
    void keep(std::string_view key);

    ScreenFacts facts;

    const Menu& menu() const { return menu_; }

    // The dive's goals, each with how far it has got.
    std::vector<std::string> goalLines(std::span<const game::GoalView> goals) const;

  private:
    struct Entry {
        MenuItem item;
        std::function<void(const MenuEvent&)> act;
    };
    struct Level { // of the stack of pages
        Screen screen;
        SettingsPage group = SettingsPage::None;
        size_t species = 0; // of the page Animal
        size_t focus = 0;
    };
    void push(Screen screen, SettingsPage group = SettingsPage::None);
    void back();
    void ask(Request::Kind kind, std::string name = {}) { request_ = Request{kind, std::move(name)}; }
    void show(size_t focus);
    MenuPage page();
    MenuPage pageOf(const Level& level);

    // Each fills entries_ and returns the page without its items.
    MenuPage titlePage();
    MenuPage divesPage();
    MenuPage swimsPage();
    MenuPage filmsPage();
    MenuPage settingsPage();
    MenuPage groupPage(SettingsPage group);
    MenuPage handSizePage();
    MenuPage bindingsPage();
    MenuPage howToPlayPage();
    MenuPage guidePage();
    MenuPage animalPage(size_t species);
    MenuPage pausedPage();
    MenuPage resultsPage();

    void button(game::Text label, std::function<void()> act);
    void itemButton(std::string label, std::function<void()> act); // named by content, not by a text
    void diveButton(std::string label, const DiveName& dive, Request::Kind kind); // with its picture
    void backButton();
    void settingEntry(size_t row);
    void keepRow(size_t row);
    void changed(size_t row);
    void captured(std::optional<Action> loser);
    const char* in(game::Text text) const { return text.in(language()); }
    game::Language language() const;
    std::string named(std::string_view english) const;
    std::string otherFilm() const;

    PlayOptions& options_;
    Bindings& bindings_;
    SettingsTable table_;
    std::vector<Level> stack_;
    std::vector<Entry> entries_; // of the page that is shown
    Menu menu_;
    std::optional<Request> request_;
    std::optional<Action> captured_; // is being given a key
    std::string message_, error_;    // below the items
};

// The language of the screen, as chosen or as the system has it.
game::Language languageIn(const TextSettings& settings);

} // namespace shoal::app
