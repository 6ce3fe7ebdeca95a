// The program: its command line, generated from the tables of settings, and its commands. The only file that
// includes CLI11, which takes 15 seconds to compile. Exit status: 0 success, 1 the command failed or an
// expectation was not met, 2 the command line was wrong.
#include "engine/core/Log.h"
#include "engine/core/RunProgram.h"
#include "game/settings/KeptFiles.h"
#include "game/tools/Commands.h"
#include "game/tools/NearestWord.h"

#include <CLI/CLI.hpp>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <sstream>
#include <unistd.h>

namespace shoal::app {

namespace {

struct AddOption {
    CLI::App& command;
    const Setting& row;

    template <class Number> CLI::Option* operator()(Number* value) const {
        const TextSetting text = numberSetting(*value, row);
        CLI::Option* option =
            (*this)(text)->type_name("NUMBER" + text.wants.substr(text.wants.find(" from ")));
        if constexpr (std::is_arithmetic_v<Number>) option->default_str(fmt::format("{}", *value));
        return option;
    }
    CLI::Option* operator()(std::string* value) const {
        return command.add_option(row.option, *value, row.help)->capture_default_str();
    }
    CLI::Option* operator()(std::vector<std::string>* value) const {
        return command.add_option(row.option, *value, row.help);
    }
    CLI::Option* operator()(bool* value) const { return command.add_flag(row.option, *value, row.help); }
    CLI::Option* operator()(const TextSetting& text) const {
        const auto set = [name = row.option, set = text.set, wants = text.wants](const std::string& given) {
            if (!set(given)) throw CLI::ValidationError(name, wants);
        };
        CLI::Option* option = command.add_option_function<std::string>(row.option, set, row.help);
        if (!text.names.empty()) option->check(CLI::IsMember(text.names))->default_str(text.get());
        return option;
    }
};

void addSettings(CLI::App& command, const SettingsTable& table) {
    for (const Setting& row : table.rows) {
        CLI::Option* option = std::visit(AddOption{command, row}, row.value);
        option->group(enumName(row.category))->required(row.required);
        if (!row.placeholder.empty()) option->type_name(row.placeholder);
    }
    for (const Setting& row : table.rows) { // once all options are there
        for (const std::string& other : row.excludes)
            command.get_option(row.option)->excludes(command.get_option(other));
        for (const std::string& other : row.needs)
            command.get_option(row.option)->needs(command.get_option(other));
    }
}

struct Command {
    const char* name;
    const char* about;
    SettingsTable table;
    bool readsFile; // the player's settings file
    std::function<int()> run;
};

// Returns why the words could not be parsed, in one sentence.
std::string explained(const CLI::ParseError& error, const CLI::App& app, const CLI::App& command,
                      const std::vector<std::string>& words) {
    for (const std::string& word : words) {
        const std::string name = word.substr(0, word.find('=')); // without its value
        if (!name.starts_with("--") || app.get_option_no_throw(name) || command.get_option_no_throw(name))
            continue;
        std::vector<std::string> known;
        for (const CLI::Option* each : command.get_options())
            for (const std::string& option : each->get_lnames()) known.push_back("--" + option);
        return "there is no option " + name + didYouMean(name, known);
    }
    return error.what();
}

// Doubles backslashes, because zenity and kdialog read a backslash as the start of an escape sequence.
std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) out += c == '\\' ? "\\\\" : std::string(1, c);
    return out;
}

// Returns whether the game was started from a menu: no standard stream is a terminal, and there is a display.
bool startedFromMenu() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::isatty(stream)) return false;
    for (const char* display : {"DISPLAY", "WAYLAND_DISPLAY"})
        if (const char* set = std::getenv(display); set && *set) return true;
    return false;
}

// Shows the text in a message box until the player closes it, by the first installed of three programs. They
// work even where no window with OpenGL can be opened.
void showMessageBox(const std::string& text) {
    const auto shows = [](std::vector<std::string> words) {
        return runProgram(std::move(words)).value_or(127) != 127; // 127: a shell found no such program
    };
    (void)(shows({"zenity", "--error", "--no-markup", "--title=Shoal", "--text=" + escaped(text)}) ||
           shows({"kdialog", "--title", "Shoal", "--error", escaped(text)}) ||
           shows({"xmessage", "-center", "-title", "Shoal", text}));
}

int wrongCommandLine(const std::string& why, const std::string& command) {
    const std::string message = why + " (" + command + " --help lists what there is)";
    std::fprintf(stderr, "shoal: %s\n", message.c_str());
    const bool tool = command != "shoal" && command != "shoal play"; // tools run in scripts, not menus
    if (!tool && startedFromMenu()) showMessageBox("Shoal cannot start: " + message);
    return 2;
}

int parseAndRun(CLI::App& app, const std::vector<std::string>& words, const std::vector<Command>& commands) {
    std::vector<CLI::App*> parsed;
    bool verbose = false, headless = false;
    app.add_flag("--verbose", verbose, "Say more on standard error");
    for (const Command& command : commands) {
        parsed.push_back(app.add_subcommand(command.name, command.about)->fallthrough());
        addSettings(*parsed.back(), command.table);
        if (!parsed.back()->get_option_no_throw("--headless"))
            parsed.back()->add_flag("--headless", headless,
                                    "Accepted by every command; this one opens no window in any case");
    }
    try {
        app.parse(std::vector<std::string>(words.rbegin(), words.rend())); // CLI11 reads them backwards
    } catch (const CLI::ParseError& error) {
        std::ostringstream out, err;
        const int status = app.exit(error, out, err);
        std::fputs(out.str().c_str(), stdout);
        if (status == 0) return 0;
        const auto given = std::ranges::find_if(parsed, [](const CLI::App* each) { return each->parsed(); });
        const CLI::App& command = given == parsed.end() ? app : **given;
        return wrongCommandLine(explained(error, app, command, words),
                                &command == &app ? "shoal" : "shoal " + command.get_name());
    }
    const CLI::App& play = *parsed.front();
    const std::string hands = play.count("--hands") ? play["--hands"]->as<std::string>() : "";
    if (hands.starts_with("script:") || hands.starts_with("replay:"))
        for (const Setting& row : commands.front().table.rows)
            if (row.personal && play.count(row.option) > 0)
                return wrongCommandLine(row.option + ": a script or replay brings its own", "shoal play");
    if (verbose) log::setUp(true);
    for (size_t i = 0; i < commands.size(); ++i)
        if (*parsed[i]) return commands[i].run();
    return commands.front().run();
}

int exitStatus(const Status& status) {
    if (status) return 0;
    log::error("{}", status.error().message());
    return 1;
}

// Returns whether a person plays: scripts and measurements run with nobody to close a box.
bool playedByAPerson(const PlayOptions& options) {
    const std::string& hands = options.hands.source;
    return !options.headless && !options.timedemo && !options.at_s && !hands.starts_with("script:") &&
           !hands.starts_with("replay:");
}

int runPlay(const PlayOptions& options) {
    const Status played = play(options);
    const int status = stopSignal != 0 ? 128 + stopSignal : exitStatus(played);
    if (!played && playedByAPerson(options) && startedFromMenu())
        showMessageBox("Shoal had to stop: " + played.error().message());
    return status;
}

int run(int argc, char** argv) {
    CLI::App app{"Shoal: catch fish inside a 360-degree video that lights them.\nWithout a command it plays: "
                 "`shoal` is `shoal play`, and `shoal FILE` dives in that 360-degree video or photo.",
                 "shoal"};
    app.set_version_flag("--version", SHOAL_VERSION);
    app.require_subcommand(0, 1);
    app.footer("`shoal COMMAND --help` lists a command's settings and units, `shoal play --help` those of "
               "the game.");

    PlayOptions playOptions;
    ViewOptions viewOptions;
    LightOptions lightOptions;
    PanoramaOptions panoramaOptions;
    CheckOptions checkOptions;
    DevicesOptions devicesOptions;
    const std::vector<Command> commands = {
        {"play", "Play a dive (the default)", settingsOf(playOptions), true,
         [&] { return runPlay(playOptions); }},
        {"view", "Light any glTF model in any surroundings", settingsOf(viewOptions), false,
         [&] { return exitStatus(view(viewOptions)); }},
        {"light", "Write the light of an environment, for other engines", settingsOf(lightOptions), false,
         [&] { return exitStatus(light(lightOptions)); }},
        {"panorama", "Grow an ordinary photo to a full environment", settingsOf(panoramaOptions), false,
         [&] { return exitStatus(panorama(panoramaOptions)); }},
        {"check", "Is this video, photo, model, dive, playthrough or replay usable?",
         settingsOf(checkOptions), false, [&] { return check(checkOptions); }},
        {"devices", "List hands, cameras, haptic devices and sound outputs", settingsOf(devicesOptions), true,
         [&] { return devices(devicesOptions); }},
    };

    // `shoal --size 640x360` means `shoal play --size 640x360`.
    std::vector<std::string> words(argv + 1, argv + argc);
    const auto isNamed = [&](const Command& command) { return !words.empty() && words[0] == command.name; };
    const auto named = std::ranges::find_if(commands, isNamed);
    // Only a file or an address has one of these characters.
    if (named == commands.end() && !words.empty() && !words[0].starts_with('-') &&
        words[0].find_first_of("./:") == std::string::npos) {
        std::vector<std::string> names;
        for (const Command& each : commands) names.push_back(each.name);
        return wrongCommandLine("there is no command " + words[0] + didYouMean(words[0], names), "shoal");
    }
    const bool global = !words.empty() && (words[0] == "--help" || words[0] == "-h" ||
                                           words[0] == "--version" || words[0] == "--verbose");
    const Command& command = named == commands.end() ? commands.front() : *named;
    if (named == commands.end() && !global) words.insert(words.begin(), command.name);
    log::setUp(false);
    // The settings file comes first, so that the command line overrides it. Runs without a window ignore it:
    // for scripts and tests they are equal on every machine.
    if (command.readsFile && std::ranges::find(words, "--headless") == words.end())
        loadSettings(command.table);
    return parseAndRun(app, words, commands);
}

} // namespace
} // namespace shoal::app

int main(int argc, char** argv) {
    // A write fails with an error, not a signal, if its reader is gone or its file may not grow.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    std::set_terminate([] { // an exception that nothing catches, in any thread; touches no files
        std::fputs("shoal: had to stop: there is not enough memory, or the program contradicts itself\n",
                   stderr);
        std::_Exit(1);
    });
    return shoal::app::run(argc, argv);
}
