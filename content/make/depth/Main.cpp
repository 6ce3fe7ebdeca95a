// shoal-depth: makes the depth track of a film. Exit status: 0 success, 1 it failed, 2 the command line was
// wrong, 3 distances cannot be known from the film.
#include "content/make/depth/FilmDepth.h"
#include "engine/core/Log.h"
#include "engine/core/Number.h"
#include "engine/core/WriteFile.h"
#include "engine/media/Pictures.h"

#include <CLI/CLI.hpp>

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <exception>

namespace {

using namespace shoal;

struct Options {
    std::string video, out;
    depth::FilmDepthOptions film;
    bool verbose = false;
};

void addNumber(CLI::App& app, const char* name, double& value, double low, double high, const char* help) {
    const std::string wants = fmt::format("wants a number from {} to {}", low, high);
    const auto set = [&value, name, low, high, wants](const std::string& given) {
        const auto number = parseNumber(given, low, high);
        if (!number) throw CLI::ValidationError(name, wants);
        value = *number;
    };
    app.add_option_function<std::string>(name, set, help)
        ->default_str(fmt::format("{}", value))
        ->type_name(fmt::format("NUMBER from {} to {}", low, high));
}

void addOptions(CLI::App& app, Options& options) {
    app.add_option("VIDEO", options.video, "An equirectangular 360-degree video, a file")->required();
    app.add_option(
           "-o,--out", options.out,
           "The depth track. Shoal uses NAME.depth.mkv beside NAME.mp4; an interrupted run goes on from "
           "FILE.part")
        ->type_name("FILE")
        ->required();
    app.add_option("--preview", options.film.preview,
                   "Writes a picture: the video's middle and its depth, side by side")
        ->type_name("FILE.png");
    constexpr auto& kLayouts = kEnumNames<media::Layout>;
    const auto setLayout = [&layout = options.film.layout](const std::string& name) {
        layout = enumNamed<media::Layout>(name).value_or(layout);
    };
    app.add_option_function<std::string>("--layout", setLayout,
                                         "Layout of the video's eyes; auto: recognised")
        ->check(CLI::IsMember(std::vector<std::string>(kLayouts.begin(), kLayouts.end())))
        ->default_str(enumName(options.film.layout));
    addNumber(app, "--baseline", options.film.baseline_m, 0.01, 1,
              "Distance between the eyes of a stereo video, metres");
    addNumber(
        app, "--height", options.film.height_m, 0.05, 1000,
        "Height of a mono video's camera over what lies below it, metres, the median over the video: the "
        "scale, which a picture does not tell");
    addNumber(
        app, "--speed", options.film.speed_mPerS, 0, 1000,
        "Speed of a mono video's camera, metres a second, the median over the video: the scale instead of "
        "--height; 0: not known");
    app.add_flag("--verbose", options.verbose, "Say more on standard error");
}

int fail(const Error& error, int status = 1) {
    log::error("{}", error.message());
    return status;
}

int make(Options& options) {
    constexpr int kCannotBeKnown = 3;
    std::error_code ignored;
    if (options.video.find("://") != std::string::npos || options.video.starts_with("camera:") ||
        (std::filesystem::exists(options.video, ignored) &&
         !std::filesystem::is_regular_file(options.video, ignored)))
        return fail({options.video, "is live: depth is made of files"});
    const Path& preview = options.film.preview;
    if (Status possible =
            checkOutputs(std::array{NamedFile{"--out", options.out}, NamedFile{"--preview", preview}},
                         std::array{NamedFile{"VIDEO", options.video}});
        !possible)
        return fail(possible.error());
    if (!preview.empty() && media::writtenAs(preview) != media::WrittenAs::Png)
        return fail({preview.string(), "is of no kind that can be written; use .png"});
    const bool shown = isatty(STDERR_FILENO);
    if (shown) options.film.progress = [](double share) { std::fprintf(stderr, "\r%5.1f %%", 100 * share); };
    const auto made = depth::makeFilmDepth(options.video, options.out, options.film);
    if (shown) std::fputs("\r", stderr);
    if (!made) return fail(made.error());
    if (*made == depth::FilmDepth::CannotBeKnown)
        return fail({options.video,
                     "how far away things are cannot be known: its camera stands still or only "
                     "turns, or too little of the picture agrees"},
                    kCannotBeKnown);
    std::printf("%s: depth of %s\n", options.out.c_str(), options.video.c_str());
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    // A closed reader, or a file that may not grow, makes the write fail instead of ending the program.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    log::setUp(false);
    Options options;
    CLI::App app{"Finds how far away things are in a 360-degree video, for Shoal.", "shoal-depth"};
    app.set_version_flag("--version", SHOAL_VERSION);
    try {
        addOptions(app, options);
        app.parse(argc, argv);
        if (options.verbose) log::setUp(true);
        return make(options);
    } catch (const CLI::Success& asked) { // --help, --version
        return app.exit(asked);
    } catch (const CLI::ParseError& error) {
        return fail({"", std::string(error.what()) + " (shoal-depth --help lists what there is)"}, 2);
    } catch (const std::exception& exception) {
        return fail({"", std::string("had to stop: ") + exception.what()});
    }
}
