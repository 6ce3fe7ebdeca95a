#include "game/settings/FilmFolders.h"

#include <algorithm>
#include <array>
#include <string>

namespace shoal::app {

namespace {

constexpr std::array kEndings = {".mp4",  ".mkv", ".webm", ".mov", ".jpg",
                                 ".jpeg", ".png", ".hdr",  ".exr", ".pfm"};
constexpr size_t kMaxLooked = 5000; // entries read of each folder

bool endsAsFilm(const Path& file) {
    const bool depth = file.stem().extension() == ".depth"; // a depth track belongs to the film beside it
    return !depth && std::ranges::find(kEndings, extensionOf(file)) != kEndings.end();
}

} // namespace

std::vector<Path> filmsAndPhotos() {
    struct Found {
        Path file;
        std::filesystem::file_time_type changed;
    };
    std::vector<Found> found;
    std::error_code code;
    for (const Path& folder : {userFolder(UserFolder::Videos), userFolder(UserFolder::Pictures),
                               userFolder(UserFolder::Downloads)}) {
        size_t looked = 0;
        for (std::filesystem::directory_iterator entry(folder, code), end;
             !code && entry != end && looked < kMaxLooked; entry.increment(code), ++looked)
            if (endsAsFilm(entry->path()) && entry->is_regular_file(code))
                found.push_back({entry->path(), entry->last_write_time(code)});
    }
    std::ranges::sort(found, std::ranges::greater(), &Found::changed);
    std::vector<Path> files;
    for (size_t i = 0; i < std::min(found.size(), kMaxFilms); ++i) files.push_back(std::move(found[i].file));
    return files;
}

} // namespace shoal::app
