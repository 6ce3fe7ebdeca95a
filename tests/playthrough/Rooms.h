// Small files with grids of distances of the dives' films, so that playthroughs can be played in the rooms of
// their films on machines that decode no film. The program makes each grid from the film's depth track;
// tests/unit/app/ViewsTest.cpp compares the files with these grids, and writes them.
//
// A file is zlib's gzip: a double, the film's length in seconds; an int32, the number of steps; for each step
// the distances of its cells in millimetres as uint16, less those of the step before. Little-endian.
#pragma once

#include "engine/core/Files.h"
#include "game/rules/FilmSpace.h"

#include <zlib.h>

#include <memory>
#include <vector>

namespace shoal::game {

struct Room {
    double length_s = 1;
    std::vector<uint16_t> surface_mm; // in the form that FilmSpace takes
};

inline Result<Room> readRoom(const Path& file) {
    const auto opened = std::unique_ptr<gzFile_s, int (*)(gzFile)>(gzopen(file.c_str(), "rb"), gzclose);
    Room room;
    int32_t steps = 0;
    const auto read = [&](void* to, size_t bytes) {
        return opened && gzread(opened.get(), to, static_cast<unsigned>(bytes)) == static_cast<int>(bytes);
    };
    bool whole = read(&room.length_s, sizeof room.length_s) && read(&steps, sizeof steps) && steps > 0 &&
                 steps <= FilmSpace::kMaxSteps;
    if (whole) room.surface_mm.resize(static_cast<size_t>(steps) * FilmSpace::kCells);
    if (!whole || !read(room.surface_mm.data(), room.surface_mm.size() * sizeof(uint16_t)))
        return Error{file.string(), "is no room of a film"};
    for (size_t i = FilmSpace::kCells; i < room.surface_mm.size(); ++i)
        room.surface_mm[i] =
            static_cast<uint16_t>(room.surface_mm[i] + room.surface_mm[i - FilmSpace::kCells]);
    return room;
}

inline bool writeRoom(const Path& file, const Room& room) {
    std::vector<uint16_t> changes = room.surface_mm;
    for (size_t i = changes.size() - 1; i >= FilmSpace::kCells; --i)
        changes[i] = static_cast<uint16_t>(changes[i] - changes[i - FilmSpace::kCells]);
    const auto steps = static_cast<int32_t>(changes.size() / FilmSpace::kCells);
    const auto bytes = static_cast<unsigned>(changes.size() * sizeof(uint16_t));
    gzFile to = gzopen(file.c_str(), "wb9");
    const bool written = to && gzwrite(to, &room.length_s, sizeof room.length_s) > 0 &&
                         gzwrite(to, &steps, sizeof steps) > 0 && gzwrite(to, changes.data(), bytes) > 0;
    return to && gzclose(to) == Z_OK && written;
}

// Returns tests/playthrough/rooms/NAME.room for a film below content/, "video/NAME.mp4".
inline Path roomFileOf(const std::string& video) {
    return dataRoot() / "tests/playthrough/rooms" / (Path(video).stem().string() + ".room");
}

inline Result<std::shared_ptr<const FilmSpace>> roomOf(const std::string& video) {
    auto room = readRoom(roomFileOf(video));
    if (!room) return room.error();
    return std::make_shared<const FilmSpace>(room->length_s, std::move(room->surface_mm));
}

} // namespace shoal::game
