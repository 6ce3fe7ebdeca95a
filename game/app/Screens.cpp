#include "game/app/Screens.h"

#include "engine/core/Log.h"
#include "game/ui/Hud.h"

#include <GLFW/glfw3.h>
#include <fmt/chrono.h>
#include <fmt/ranges.h>

#include <cctype>
#include <cmath>

namespace shoal::app {

// The pages of settings, by SettingsPage without None.
constexpr auto kGroups =
    std::to_array<game::Text>({"Hands", "Comfort", "Picture", "Sound", "Text and captions"});

// Returns a key's name for the player: translated, or the file's name with spaces: "PageUp", "Page up".
static std::string keyLabel(std::string_view name, game::Language language) {
    const auto text = game::translated(name, language);
    if (text != name) return std::string(text);
    std::string label;
    for (const unsigned char c : name) {
        const bool next =
            std::isupper(c) && !label.empty() && std::islower(static_cast<unsigned char>(label.back()));
        if (next) label += ' ';
        label += static_cast<char>(next ? std::tolower(c) : c);
    }
    return label;
}

// Returns the keys and the button as text; empty if there is none.
static std::string keysText(const Bindings::Keys& keys, game::Language language) {
    std::string text;
    for (const int key : keys.keys)
        if (key >= 0) text += (text.empty() ? "" : ", ") + keyLabel(keyName(key), language);
    if (keys.button >= 0)
        text += (text.empty() ? "(" : "  (") + keyLabel(buttonName(keys.button), language) + ")";
    return text;
}

static std::string capitalised(std::string name) {
    if (!name.empty() && static_cast<unsigned char>(name[0]) < 0x80)
        name[0] = static_cast<char>(std::toupper(name[0]));
    return name;
}

static std::string goalText(const game::Goal& goal, const game::SpeciesTable& species,
                            game::Language language) {
    static constexpr std::array<game::Text, game::kGoalNames.size()> kGoals = {
        "Catch {} fish",
        "Catch {} different species",
        "Score {} points",
        "Catch {} fish and lose none to the shark",
        "Catch {} different species in a row",
        "Catch {} fish within {} seconds",
        "First catch: {}",
        "Catch {} fish with each hand",
        "Bring fish to feed on {} mussels",
        "Turn the shark away with stones: {}",
        "Touch {} kinds of animals",
        "Catch {} fish in a row and frighten none in between"}; // by GoalKind
    const game::Text text = kGoals[static_cast<size_t>(goal.kind)];
    if (goal.kind == game::GoalKind::Quick) return text.in(language, goal.count, std::lround(goal.within_s));
    if (goal.kind == game::GoalKind::Guests && goal.count == 1)
        return game::Text("Bring fish to feed on a mussel").in(language);
    if (goal.kind == game::GoalKind::TurnShark && goal.count == 1)
        return game::Text("Turn the shark away with a stone").in(language);
    if (goal.species < 0) return text.in(language, goal.count);
    const std::string& name = animalName(species[goal.species], goal.count, language);
    if (goal.kind == game::GoalKind::First) return text.in(language, name);
    return game::Text(species[goal.species].thing == game::Thing::None
                          ? game::Text("Catch {} {}")
                          : game::Text("Take {} {} out of the sea"))
        .in(language, goal.count, name);
}

// Returns the stars of a dive as glyphs, those not earned empty.
static std::string starText(int stars) {
    std::string text;
    for (int i = 0; i < static_cast<int>(game::kGoals); ++i) text += i < stars ? "\u2605" : "\u2606";
    return text;
}

static const MetAnimal* findMet(const std::vector<MetAnimal>& met, const std::string& species) {
    const auto found = std::ranges::find(met, species, &MetAnimal::species);
    return found == met.end() ? nullptr : &*found;
}

void Screens::open(Screen screen, size_t focus) {
    stack_.clear();
    push(screen, 0, focus);
}

void Screens::openWithError(Screen screen, std::string error) {
    open(Screen::Title);
    if (screen != Screen::Title) push(screen);
    showError(std::move(error));
}

void Screens::showError(std::string error) {
    error_ = std::move(error);
    if (isOpen()) refresh();
}

void Screens::keep(std::string_view key) {
    for (size_t row = 0; row < table_.rows.size(); ++row)
        if (table_.rows[row].key() == key) changed(row);
}

std::optional<Screen> Screens::top() const {
    return stack_.empty() ? std::nullopt : std::optional(stack_.back().screen);
}

bool Screens::showsCamera() const {
    if (stack_.empty() || !facts.webcam) return false;
    const Level& level = stack_.back();
    return level.screen == Screen::HandSize ||
           (level.screen == Screen::SettingsGroup && level.index == static_cast<size_t>(SettingsPage::Hands));
}

void Screens::push(Screen screen, size_t index, size_t focus) {
    if (!stack_.empty()) stack_.back().focus = menu_.focus();
    stack_.push_back({.screen = screen, .index = index});
    message_.clear();
    error_.clear();
    if (screen == Screen::Films) films_.look();
    const auto last = std::ranges::find(facts.dives, facts.dive->name, &DiveName::name);
    if ((screen == Screen::Dives || screen == Screen::Swims) && last != facts.dives.end())
        focus = static_cast<size_t>(last - facts.dives.begin());
    menu_.show(page(), focus);
}

void Screens::back() {
    captured_.reset();
    message_.clear();
    error_.clear();
    if (stack_.size() == 1) { // Escape on the lowest page; the title screen is left by its own button
        if (top() == Screen::Paused) ask(Request::Kind::Resume);
        if (top() == Screen::Results) ask(Request::Kind::Title);
        return;
    }
    stack_.pop_back();
    menu_.show(page(), stack_.back().focus);
}

MenuPage Screens::page() {
    using S = Screens;
    constexpr std::array kPages = {&S::titlePage,     &S::divesPage, &S::divesPage,    &S::filmsPage,
                                   &S::settingsPage,  &S::groupPage, &S::handSizePage, &S::bindingsPage,
                                   &S::howToPlayPage, &S::guidePage, &S::animalPage,   &S::pausedPage,
                                   &S::resultsPage}; // by Screen
    const Screen screen = stack_.back().screen;
    MenuPage page = (this->*kPages[static_cast<size_t>(screen)])();
    if (screen == Screen::Guide || screen == Screen::Animal) { // names begin as titles do
        page.title = capitalised(page.title);
        for (MenuItem& item : items_) item.label = capitalised(item.label);
    }
    page.camera = showsCamera();
    page.items = std::exchange(items_, {});
    page.error = error_;
    if (!message_.empty()) page.note = message_;
    return page;
}

void Screens::refresh() {
    if (isOpen()) menu_.update(page());
}

void Screens::input(const MenuInput& input) {
    if (stack_.empty() || captured_) return;
    if (top() == Screen::Films) refresh(); // the list grows
    const auto event = menu_.input(input);
    if (!event) return;
    if (event->kind == MenuEvent::Kind::Back) return back();
    if (event->kind == MenuEvent::Kind::Turn) return turnTo(event->steps);
    const size_t depth = stack_.size();
    const auto act = menu_.page().items[event->item].act; // the call may replace the page
    act(*event);
    if (stack_.size() == depth) refresh();
}

void Screens::itemButton(std::string label, std::function<void()> act) {
    items_.push_back({.label = std::move(label), .act = [act = std::move(act)](const MenuEvent&) { act(); }});
}

// Saves a changed setting at once. Only changed settings are written, none from the command line.
void Screens::changed(size_t row) {
    if (Status saved = saveSetting(table_.rows[row]); !saved) {
        log::warn("{}", saved.error().message());
        error_ = saved.error().message();
    }
    ask(Request::Kind::SettingsChanged);
}

void Screens::settingEntry(size_t row) {
    const Setting& setting = table_.rows[row];
    items_.push_back({.label = in(*setting.label),
                      .value = shownValue(setting, language()),
                      .fraction = sliderOf(setting),
                      .act = [this, row](const MenuEvent& event) {
                          if (event.kind == MenuEvent::Kind::Slide)
                              slide(table_.rows[row], event.fraction);
                          else
                              adjust(table_.rows[row], event.steps);
                          changed(row);
                      }});
}

MenuPage Screens::titlePage() {
    button("Dive", [this] {
        facts.dives.size() > 1 ? push(Screen::Dives) : ask(Request::Kind::Dive, options_.dive);
    });
    button("Free swim", [this] {
        facts.dives.size() > 1 ? push(Screen::Swims) : ask(Request::Kind::Swim, options_.dive);
    });
    button("My film or photo", [this] { push(Screen::Films); });
    if (facts.headset && !options_.xr) button("Headset", [this] { ask(Request::Kind::Headset); });
    button("Settings", [this] { push(Screen::Settings); });
    button("How to play", [this] { push(Screen::HowToPlay); });
    button("Field guide", [this] { push(Screen::Guide); });
    button("Quit", [this] { ask(Request::Kind::Quit); });
    return {.title = "Shoal",
            .text = {in("Catch fish with your bare hands")},
            .note = options_.xr ? in("Poke with a fingertip, or pull a controller’s trigger")
                                : in("Arrow keys and Enter, mouse or gamepad"),
            .layout = PageLayout::Side,
            .wordmark = true};
}

MenuPage Screens::divesPage() {
    const bool swims = top() == Screen::Swims;
    const EnvironmentOptions& shown = options_.environment;
    for (const DiveName& dive : facts.dives) {
        std::string label = named(dive.title);
        const auto scores = facts.allScores.find(dive.name);
        if (scores != facts.allScores.end() && !swims) {
            label += "  " + starText(scores->second.stars);
            if (!scores->second.top.empty()) label += fmt::format(" {}", scores->second.top.front());
        }
        itemButton(std::move(label), [this, swims, name = dive.name] {
            ask(swims ? Request::Kind::Swim : Request::Kind::Dive, name);
        });
        if (shown.isOwnVideo()) items_.back().picture = dive.picture;
    }
    backButton();
    MenuPage page{.title = in(swims ? game::Text("Free swim") : "Choose a dive"), .layout = PageLayout::Side};
    page.text = {swims ? in("No clock, no shark: meet the animals.")
                       : in("Stars in all: {}", starsIn(facts.allScores))};
    if (!shown.isOwnVideo()) // one of these is its file
        page.text.push_back(
            in("All dives are in {}", Path(shown.video + shown.photo + shown.env).filename().string()));
    return page;
}

MenuPage Screens::filmsPage() {
    if (!options_.environment.isOwnVideo())
        button("The dive’s own film", [this] { ask(Request::Kind::OpenFilm); });
    const auto [files, complete] = films_.found();
    std::string folders;
    for (const Path& folder : films_.folders()) folders += (folders.empty() ? "" : ", ") + folder.string();
    for (const Path& file : files)
        itemButton(file.filename().string(), [this, file] { ask(Request::Kind::OpenFilm, file.string()); });
    backButton();
    return {.title = in("My film or photo"),
            .text = {in("Drop a 360-degree video or any photo on this window, or choose one of these."),
                     in("To add some, put them in one of these folders: {}", folders),
                     in("Videos: MP4, MKV, WebM, MOV. Photos: JPEG, PNG, WebP, TIFF, AVIF. High dynamic "
                        "range: HDR, EXR, PFM.")},
            .note = !complete       ? in("Loading")
                    : files.empty() ? in("There are no films or photos in these folders yet.")
                                    : ""};
}

MenuPage Screens::settingsPage() {
    for (size_t i = 0; i < kGroups.size(); ++i)
        button(kGroups[i], [this, i] { push(Screen::SettingsGroup, i + 1); });
    button("Keys and buttons", [this] { push(Screen::Bindings); });
    backButton();
    return {.title = in("Settings"), .layout = PageLayout::Side};
}

MenuPage Screens::groupPage() {
    const size_t index = stack_.back().index;
    const auto group = static_cast<SettingsPage>(index);
    const bool isMuted = group == SettingsPage::Sound && options_.mute; // nothing would be heard
    for (size_t row = 0; row < table_.rows.size() && !isMuted; ++row)
        if (table_.rows[row].page == group) settingEntry(row);
    if (group == SettingsPage::Hands && facts.webcam)
        button("Measure my hand", [this] { push(Screen::HandSize); });
    backButton();
    MenuPage page{.title = in(kGroups[index - 1])};
    if (group == SettingsPage::Hands && facts.handsNeed) page.text = {facts.handsNeed->in(language())};
    return page;
}

MenuPage Screens::handSizePage() {
    using enum hands::HandSizing::State;
    backButton();
    MenuPage page{.title = in("Hand size"),
                  .text = {in("Hold one open hand still, palm towards the camera and 30 cm away from it: the "
                              "length of a sheet of A4 paper.")},
                  .progress = facts.handSizing.progress(),
                  .layout = PageLayout::Side};
    const auto state = facts.handSizing.state();
    page.note = state == Elsewhere ? in("No hand is that small or that big: is it 30 cm away?")
                : state == Holding ? in("Keep it there")
                : state == Done
                    ? in("Your hand has {} % of the usual size.", std::lround(100 * options_.hands.size))
                    : "";
    return page;
}

MenuPage Screens::bindingsPage() {
    for (size_t i = 0; i < kActions; ++i) {
        const auto action = static_cast<Action>(i);
        const std::string keys = keysText(bindings_.of(action), language());
        items_.push_back({.label = in(kActionRows[i].label),
                          .value = keys.empty() ? named("none") : keys,
                          .isButton = true,
                          .act = [this, action](const MenuEvent&) {
                              captured_ = action;
                              message_ = in("Press a key or a button for “{}”. Esc: cancel",
                                            in(kActionRows[static_cast<size_t>(action)].label));
                          }});
    }
    button("Reset all keys", [this] {
        bindings_ = Bindings();
        captured({});
    });
    backButton();
    return {.title = in("Keys and buttons")};
}

void Screens::captured(std::optional<Action> loser) {
    captured_.reset();
    message_.clear();
    if (loser) {
        const char* label = in(kActionRows[static_cast<size_t>(*loser)].label);
        const std::string left = keysText(bindings_.of(*loser), language());
        message_ = left.empty() ? in("Until now it was for “{}”, which has no key or button any more", label)
                                : in("Until now it was for “{}”, which still has: {}", label, left);
    }
    options_.controls.bindings = bindings_.toText();
    keep("bindings");
    refresh();
}

// Binds the key or the button; Escape and a press of the mouse cancel.
void Screens::capture(const platform::WindowInput& input) {
    const int key = input.keysPressed.empty() ? -1 : input.keysPressed.front();
    const std::vector<int>& buttons = input.gamepad.pressed;
    if (key >= 0 && key != GLFW_KEY_ESCAPE) return captured(bindings_.bind(*captured_, key, false));
    if (key < 0 && !buttons.empty()) return captured(bindings_.bind(*captured_, buttons.front(), true));
    if (key < 0 && !input.leftPressed) return;
    captured_.reset();
    message_.clear();
    refresh();
}

// Makes one of the lessons; the first comes again after the last.
MenuPage Screens::howToPlayPage() {
    struct Lesson {
        const char* picture;
        std::vector<game::Text> text;
    };
    constexpr game::Text kSlowly("Fish fear a fast hand and are curious about one that keeps still: move "
                                 "slowly, or wait in their way.");
    std::vector<Lesson> lessons;
    if (options_.xr)
        lessons = {{"lessons/catch.jpg",
                    {"Reach for a fish and close your hand on it", "Hold it for a second", kSlowly}}};
    else
        lessons = {{"lessons/catch.jpg",
                    {"Reach with the mouse. When a fish glows, hold the left button: your hand closes. Hold "
                     "the fish for a second, and it counts.",
                     kSlowly}},
                   {"dives/reef.jpg",
                    {"The mouse wheel reaches nearer or farther. Look around with the arrow keys or with the "
                     "right button held. Tab swaps hands.",
                     "With a gamepad, look with the left stick, reach with the right one and close your hand "
                     "with the right trigger.",
                     "Pause with Esc, the middle mouse button or Start on a gamepad. All keys are in the "
                     "settings."}}};
    lessons.push_back(
        {"lessons/shark.jpg",
         {"A struggling fish draws the shark. When it points at your hand, let go or pull your hand away.",
          "Different species in a row count double, then three, four and five times. Each dive has three "
          "goals. Jellyfish sting the hand that closes on them."}});
    lessons.push_back({"lessons/mussel.jpg",
                       {"Hold a mussel until it cracks, and fish come to feed. A stone thrown at the shark’s "
                        "head turns it away. Take bottles out of the sea."}});
    const size_t index = stack_.back().index;
    button("Next", [this, next = (index + 1) % lessons.size()] {
        stack_.back().index = next;
        menu_.show(page(), 0);
    });
    backButton();
    MenuPage page{.title = in("How to play"), .picture = lessons[index].picture};
    for (const game::Text text : lessons[index].text) page.text.emplace_back(in(text));
    page.note = fmt::format("{} / {}", index + 1, lessons.size());
    return page;
}

// Makes the field guide; each animal that the player has met leads to a page of its own.
MenuPage Screens::guidePage() {
    const game::SpeciesTable& all = *facts.species;
    size_t met = 0;
    for (size_t species = 0; species < all.size(); ++species) {
        const bool known = findMet(facts.met, all[species].name);
        met += known;
        const int stars = rarity(all[species]).first;
        itemButton(known   ? animalName(all[species], 1, language())
                   : stars ? fmt::format("?   \u2605 {}", stars)
                           : "?",
                   [this, species] { push(Screen::Animal, species); });
        items_.back().enabled = hasPage(species);
    }
    backButton();
    return {.title = in("Field guide"),
            .text = {in("You have met {} of {} animals. Touch an animal in the water to get to know it.", met,
                        all.size())},
            .layout = PageLayout::Side};
}

std::pair<int, std::string> Screens::rarity(const game::Species& animal) const {
    for (const DiveName& dive : facts.dives)
        for (const auto& [species, stars] : dive.rare)
            if (species == animal.name) return {stars, named(dive.title)};
    return {};
}

bool Screens::hasPage(size_t species) const {
    const game::Species& animal = (*facts.species)[species];
    return findMet(facts.met, animal.name) || rarity(animal).first > 0;
}

std::optional<size_t> Screens::animalBeside() const {
    if (top() != Screen::Animal || options_.xr) return std::nullopt; // a headset's page has nothing beside it
    const size_t species = stack_.back().index;
    return findMet(facts.met, (*facts.species)[species].name) ? std::optional(species) : std::nullopt;
}

MenuPage Screens::animalPage() {
    const game::Species& animal = (*facts.species)[stack_.back().index];
    button("Next animal", [this] { turnTo(1); });
    button("Previous animal", [this] { turnTo(-1); });
    backButton();
    MenuPage page{.title = animalName(animal, 1, language()),
                  .picture = "guide/" + animal.name + ".png",
                  .text = {textIn(animal.fact, language())},
                  .layout = PageLayout::Side,
                  .turns = true};
    if (animalBeside()) page.picture.clear();
    const MetAnimal* met = findMet(facts.met, animal.name);
    if (!met) { // a rare one: its silhouette
        const auto [stars, dive] = rarity(animal);
        page.title = "?";
        page.picture = "guide/" + animal.name + ".dark.png";
        page.text = {in("{} stars bring it to you. Dive: {}", stars, dive)};
        return page;
    }
    if (met->caught > 0) {
        page.text.push_back(in("Caught: {}", met->caught));
        if (met->largest_m > 0) page.text.back() += "   " + in("Longest: {}", lengthText(met->largest_m));
    }
    if (!met->dive.empty()) page.text.push_back(in("First met: {}, {}", named(met->dive), met->date));
    return page;
}

void Screens::turnTo(int steps) {
    const size_t count = facts.species->size();
    size_t& index = stack_.back().index;
    for (size_t tries = 0; tries < count; ++tries) {
        index = (index + (steps > 0 ? 1 : count - 1)) % count;
        if (hasPage(index)) break;
    }
    menu_.show(page(), menu_.focus());
}

std::vector<std::string> Screens::goalLines(std::span<const game::GoalView> goals) const {
    std::vector<std::string> lines;
    for (const game::GoalView& view : goals) {
        if (static_cast<size_t>(view.goal) >= facts.dive->goals.size()) continue; // of an earlier dive
        const game::Goal& goal = facts.dive->goals[view.goal];
        lines.push_back((view.reached ? "\u2605 " : "\u2606 ") + goalText(goal, *facts.species, language()));
        if (!view.reached && view.progress > 0)
            lines.back() += fmt::format("\u00a0\u00a0{}/{}", view.progress, goal.count); // not broken
    }
    return lines;
}

MenuPage Screens::pausedPage() {
    button("Resume", [this] { ask(Request::Kind::Resume); });
    if (facts.mode == Mode::FirstSteps)
        button("Skip the first steps", [this] { ask(Request::Kind::SkipFirstSteps); });
    else
        button("Start again", [this] { ask(Request::Kind::Restart); });
    if (facts.headsetLost && !options_.xr) button("Headset", [this] { ask(Request::Kind::Headset); });
    if (options_.xr) button("Recentre view", [this] { ask(Request::Kind::Recentre); });
    if (!options_.xr) button("Photo mode", [this] { ask(Request::Kind::Photo); });
    if (facts.mode != Mode::Dive) button("Field guide", [this] { push(Screen::Guide); });
    button("Settings", [this] { push(Screen::Settings); });
    button("How to play", [this] { push(Screen::HowToPlay); });
    button("Title screen", [this] { ask(Request::Kind::Title); });
    button("Quit", [this] { ask(Request::Kind::Quit); });
    MenuPage page{.title = in("Paused"), .layout = PageLayout::Side};
    if (options_.xr) page.note = in("Close a hand to go on");
    if (facts.mode == Mode::Dive) page.text = goalLines(facts.results.goals);
    return page;
}

bool Screens::isRecord(const game::Species& kind, float length_m) const {
    const MetAnimal* before = findMet(facts.metBefore, kind.name);
    return before && before->caught > 0 && length_m > before->largest_m;
}

// Returns pictures of what was caught in the dive, the longest first.
std::vector<MenuPicture> Screens::catches() const {
    const std::vector<game::SpeciesTally>& tally = facts.results.tally;
    std::vector<size_t> caught;
    for (size_t i = 0; i < tally.size(); ++i)
        if (tally[i].caught > 0) caught.push_back(i);
    const auto length_m = [&](size_t i) {
        return tally[i].largest_m > 0 ? tally[i].largest_m : (*facts.species)[i].length_m;
    };
    std::ranges::stable_sort(caught, std::ranges::greater(), length_m);
    std::vector<MenuPicture> pictures;
    for (const size_t i : caught) {
        const game::Species& kind = (*facts.species)[i];
        const float largest_m = tally[i].largest_m;
        const bool before = findMet(facts.metBefore, kind.name), record = isRecord(kind, largest_m);
        pictures.push_back({.file = "guide/" + kind.name + ".png",
                            .count = fmt::format("\u00d7{}", tally[i].caught),
                            .caption = animalName(kind, tally[i].caught, language()),
                            .note = (largest_m > 0 ? lengthText(largest_m) + "  " : "") +
                                    (before ? record ? in("record") : "" : in("new")),
                            .marked = record || !before});
    }
    return pictures;
}

MenuPage Screens::resultsPage() {
    const game::Snapshot& s = facts.results;
    MenuPage page{.title = in("The dive is over: {}", s.score), .gallery = catches()};
    page.text = goalLines(s.goals);
    std::string line = s.caught == 1 ? in("1 fish caught") : in("{} fish caught", s.caught);
    if (s.lost > 0) line += ", " + in("{} taken by the shark", s.lost);
    page.text.push_back(line + "   " + in("Stars in all: {}", starsIn(facts.allScores)));
    const DiveScores& before = facts.scores;
    line.clear();
    if (s.score > (before.top.empty() ? 0 : before.top.front()))
        line = in("Your best dive yet");
    else if (before.last > 0 && s.score > before.last)
        line = in("Better than last time by {}", s.score - before.last);
    if (!before.top.empty())
        line += (line.empty() ? "" : "   ") + in("Your best dives before: {}", fmt::join(before.top, "  "));
    if (!line.empty()) page.text.push_back(line);
    button("Dive again", [this] { ask(Request::Kind::Restart); });
    if (facts.dives.size() > 1) button("Choose a dive", [this] { push(Screen::Dives); });
    button("Title screen", [this] { ask(Request::Kind::Title); });
    button("Quit", [this] { ask(Request::Kind::Quit); });
    page.note = in("Seed {}", facts.seed);
    if (options_.xr) page.note = in("Close both hands: dive again") + std::string("   ") + page.note;
    return page;
}

ProgramStates::ProgramStates(GameSession& session, Screens& screens, Mode mode, bool keepsScores)
    : session_(session), screens_(screens), mode_(mode), keepsScores_(keepsScores), before_(state()) {
    screens_.facts.mode = mode_;
    screens_.facts.metBefore = screens_.facts.met;
    screens_.close();
    entered(before_);
}

ProgramStates::State ProgramStates::state() const {
    if (mode_ == Mode::Title) return State::Title;
    if (session_.after.phase == game::Phase::Results) return State::Results;
    // A pause is the decision of the player, the headset, or the script or replay that plays.
    return (byPerson() ? session_.paused : session_.after.paused) ? State::Paused : State::Diving;
}

void ProgramStates::input(const Controls& controls, bool lostFocus, bool& leaving) {
    const bool pause = controls.wasPressed(Action::Pause);
    if (!byPerson()) { // a script or replay pauses and ends by itself
        leaving |= pause;
        return;
    }
    if (state() == State::Diving && (pause || lostFocus)) session_.paused = true;
}

void ProgramStates::update() {
    const State now = state();
    if (now == before_) return;
    before_ = now;
    entered(now);
}

void ProgramStates::entered(State state) {
    ScreenFacts& facts = screens_.facts;
    facts.results = session_.after;
    if (facts.seed != session_.dive.seed()) { // another dive of the session
        counted_.clear();
        facts.metBefore = facts.met;
    }
    facts.seed = session_.dive.seed();
    keepGuide();
    if (state == State::Diving) return screens_.close();
    if (state == State::Results) keepScore();
    screens_.open(state == State::Title    ? Screen::Title
                  : state == State::Paused ? Screen::Paused
                                           : Screen::Results);
}

void ProgramStates::keepScore() {
    const std::string& dive = session_.dive.file().name;
    screens_.facts.scores = readScores()[dive];
    // Only a person's dives count.
    if (!keepsScores_ || !byPerson()) return;
    const auto stars = std::ranges::count_if(session_.after.goals, &game::GoalView::reached);
    if (Status saved = addScore(dive, session_.after.score, static_cast<int>(stars)); !saved)
        log::warn("{}", saved.error().message());
    screens_.facts.allScores = readScores();
}

void ProgramStates::keepGuide() {
    std::vector<MetAnimal>& met = screens_.facts.met;
    const std::vector<MetAnimal> before = met;
    const auto& tally = session_.after.tally;
    counted_.resize(tally.size());
    for (size_t i = 0; i < tally.size(); ++i) {
        if (!tally[i].touched) continue;
        const std::string& name = session_.dive.species()[i].name;
        auto animal = std::ranges::find(met, name, &MetAnimal::species);
        if (animal == met.end()) {
            const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
            animal = met.insert(animal, {.species = name,
                                         .dive = session_.dive.file().title,
                                         .date = fmt::format("{:%Y-%m-%d}", fmt::localtime(now))});
        }
        animal->caught += tally[i].caught - counted_[i].caught;
        animal->largest_m = std::max(animal->largest_m, tally[i].largest_m);
    }
    counted_ = tally;
    if (met == before || !keepsScores_ || !byPerson()) return;
    if (Status saved = saveGuide(met); !saved) log::warn("{}", saved.error().message());
}

} // namespace shoal::app
