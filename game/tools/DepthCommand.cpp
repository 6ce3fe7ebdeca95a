// shoal depth: makes the depth track of a film.
#include "engine/core/Log.h"
#include "engine/core/WriteFile.h"
#include "engine/depth/estimate/FilmDepth.h"
#include "engine/media/Pictures.h"
#include "game/tools/Commands.h"

#include <unistd.h>

#include <array>
#include <cstdio>

namespace shoal::app {

int depth(const DepthOptions& options) {
    constexpr int kCannotBeKnown = 3;
    const auto failed = [](const Error& error) {
        log::error("{}", error.message());
        return 1;
    };
    std::error_code ignored;
    if (options.video.find("://") != std::string::npos || options.video.starts_with("camera:") ||
        (std::filesystem::exists(options.video, ignored) &&
         !std::filesystem::is_regular_file(options.video, ignored)))
        return failed({options.video, "is live: depth is made of files"});
    if (Status possible =
            checkOutputs(std::array{NamedFile{"--out", options.out}, NamedFile{"--preview", options.preview}},
                         std::array{NamedFile{"VIDEO", options.video}});
        !possible)
        return failed(possible.error());
    if (!options.preview.empty() && media::writtenAs(options.preview) != media::WrittenAs::Png)
        return failed({options.preview, "is of no kind that can be written; use .png"});
    depth::FilmDepthOptions film;
    film.layout = options.layout;
    film.baseline_m = static_cast<double>(options.baseline_m);
    film.height_m = static_cast<double>(options.height_m);
    film.speed_mPerS = static_cast<double>(options.speed_mPerS);
    film.preview = options.preview;
    const bool shown = isatty(STDERR_FILENO);
    if (shown) film.progress = [](double share) { std::fprintf(stderr, "\r%5.1f %%", 100 * share); };
    const auto made = depth::makeFilmDepth(options.video, options.out, film);
    if (shown) std::fputs("\r", stderr);
    if (!made) return failed(made.error());
    if (*made == depth::FilmDepth::CannotBeKnown) {
        log::error("{}: how far away things are cannot be known: its camera stands still or only turns, or "
                   "too little of the picture agrees",
                   options.video);
        return kCannotBeKnown;
    }
    std::printf("%s: depth of %s\n", options.out.c_str(), options.video.c_str());
    return 0;
}

} // namespace shoal::app
