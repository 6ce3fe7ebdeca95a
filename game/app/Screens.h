// The menu pages: title, settings, pause, results and their subpages. They change the player's settings
// themselves; all else that the player asks for is a request to the program. Main thread.
#pragma once

#include "game/app/FirstSteps.h"
#include "game/session/GameSession.h"
#include "game/settings/KeptFiles.h"
#include "game/ui/Menu.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace shoal::app {

enum class Screen {
    Title,
    Dives,
    Swims, // the places for free swims
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

struct Request {
    enum class Kind {
        Dive,
        SkipFirstSteps,
        Swim,
        OpenFilm,
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
    std::string name; // of a dive or a free swim, or a file; no file: the dive's own film
};

struct DiveName {
    std::string name, title;
    std::string picture{};                           // below content/; empty: none
    std::vector<std::pair<std::string, int>> rare{}; // species that come for stars, and for how many
};

// Data that the pages show besides settings.
struct ScreenFacts {
    const game::SpeciesTable* species = nullptr;
    const game::DiveFile* dive = nullptr;
    std::vector<DiveName> dives;
    bool headset = false;     // a headset is there
    bool headsetLost = false; // the headset was lost in mid-dive, which goes on in the window
    uint64_t seed = 0;        // of the present dive
    DiveScores scores;        // scores of this dive, before the last one
    std::map<std::string, DiveScores> allScores{}; // of all dives, the last one too
    std::vector<MetAnimal> met;
    std::vector<MetAnimal> metBefore{}; // when the present dive began
    game::Snapshot results;             // when the present program state began
    Mode mode = Mode::Dive;
    bool webcam = false;                     // a webcam tracks the hands
    std::optional<game::Notice> handsNeed{}; // TrackedHands::needs()
    hands::HandSizing handSizing{};          // measurement on the page HandSize
};

class Screens {
  public:
    // options and bindings must outlive this.
    Screens(PlayOptions& options, Bindings& bindings)
        : options_(options), bindings_(bindings), table_(settingsOf(options)) {}

    void open(Screen screen, size_t focus = 0); // as the only page
    void close() { stack_.clear(); }
    void openWithError(Screen screen, std::string error);                         // over the title page
    void showError(std::string error);                                            // on the open page
    void dropped(const std::string& file) { ask(Request::Kind::OpenFilm, file); } // onto the window
    bool isOpen() const { return !stack_.empty(); }
    std::optional<Screen> top() const;
    bool showsCamera() const; // the page shows the webcam's image
    // Returns the species of the animal that the page leaves room for beside it.
    std::optional<size_t> animalBeside() const;
    // Returns whether a binding waits for the next key or button, which only capture() must then read.
    bool capturesKey() const { return captured_.has_value(); }
    void capture(const platform::WindowInput& input);

    void input(const MenuInput& input);
    std::optional<Request> takeRequest() { return std::exchange(request_, std::nullopt); }
    void draw(const Pen& pen) {
        if (isOpen()) menu_.draw(pen);
    }
    // Updates the page that is open, after its words or numbers have changed.
    void refresh();
    // Saves a setting that the player has changed by a key of the game, and requests that it take effect.
    void keep(std::string_view key);

    ScreenFacts facts;

    const Menu& menu() const { return menu_; }

    // Returns whether a fish of that length is longer than all of its species that the player had caught when
    // the dive began; false if the player had caught none.
    bool isRecord(const game::Species& kind, float length_m) const;
    // Returns a line for each of the dive's goals, with its progress.
    std::vector<std::string> goalLines(std::span<const game::GoalView> goals) const;

  private:
    struct Level { // one page of the stack
        Screen screen;
        size_t index = 0; // the SettingsPage, the lesson, or the animal's index in the table of species
        size_t focus = 0;
    };
    void push(Screen screen, size_t index = 0, size_t focus = 0);
    void back();
    void turnTo(int steps); // the next or previous animal of the guide
    void ask(Request::Kind kind, std::string name = {}) { request_ = Request{kind, std::move(name)}; }
    MenuPage page();

    std::vector<MenuPicture> catches() const;
    // Returns how many stars a player needs to meet an animal, and the title of its dive; 0: it needs none.
    std::pair<int, std::string> rarity(const game::Species& animal) const;
    bool hasPage(size_t species) const; // in the field guide
    // Each of these functions fills items_ and returns the page without its items.
    MenuPage titlePage();
    MenuPage divesPage(); // for free swims too
    MenuPage filmsPage();
    MenuPage settingsPage();
    MenuPage groupPage();
    MenuPage handSizePage();
    MenuPage bindingsPage();
    MenuPage howToPlayPage();
    MenuPage guidePage();
    MenuPage animalPage();
    MenuPage pausedPage();
    MenuPage resultsPage();

    template <class... Values> auto in(game::Text text, const Values&... values) const {
        return text.in(language(), values...);
    }
    void button(game::Text label, std::function<void()> act) { itemButton(in(label), std::move(act)); }
    void itemButton(std::string label, std::function<void()> act); // label from content, already translated
    void backButton() {
        button("Back", [this] { back(); });
    }
    void settingEntry(size_t row);
    void changed(size_t row);
    void captured(std::optional<Action> loser);
    game::Language language() const { return options_.text.shownLanguage(); }
    std::string named(std::string_view english) const {
        return std::string(game::translated(english, language()));
    }

    PlayOptions& options_;
    Bindings& bindings_;
    SettingsTable table_;
    std::vector<Level> stack_;
    std::vector<MenuItem> items_; // of the page that is being made
    Menu menu_;
    std::optional<Request> request_;
    std::optional<Action> captured_; // the action that waits for a key
    std::string message_, error_;    // texts below the items
    FilmList films_;                 // on the page Films
};

// The states of the program, and the menu pages that each shows over the picture.
class ProgramStates {
  public:
    enum class State { Title, Diving, Paused, Results };

    // Session and screens must outlive this. keepsScores: writes scores to the player's file.
    ProgramStates(GameSession& session, Screens& screens, Mode mode, bool keepsScores);

    State state() const;
    Mode mode() const { return mode_; }
    bool byPerson() const { return playedByAPerson(session_.source); }

    // Handles input of the game; menus read their own.
    void input(const Controls& controls, bool lostFocus, bool& leaving);
    // Opens and closes pages, and keeps score and guide; once a frame, after the simulation.
    void update();

  private:
    void entered(State state);
    void keepScore();
    void keepGuide();

    GameSession& session_;
    Screens& screens_;
    Mode mode_;
    bool keepsScores_;
    std::vector<game::SpeciesTally> counted_; // of this dive, in the field guide already
    State before_;
};

} // namespace shoal::app
