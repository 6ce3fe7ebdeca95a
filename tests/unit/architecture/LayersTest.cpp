// The layers of the source tree, read from its #include lines: an arrow points to the same or a lower layer,
// and folders never depend on each other in a circle.
#include "tests/TestPaths.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace shoal {

namespace {

using Folders = std::map<std::string, std::set<std::string>>; // by folder: those whose headers it includes

// Layer of each folder, from the lowest up. A folder that is missing has to be added to this table.
const std::map<std::string, int> kLayerOf = {
    {"engine/core", 0},        {"engine/math", 0},                                                 //
    {"engine/gl", 1},          {"engine/media", 1},  {"engine/platform", 1},                       //
    {"engine/light", 2},       {"engine/scene", 2},  {"engine/panorama", 2},  {"engine/audio", 2}, //
    {"engine/physics", 2},     {"engine/sim", 2},                                                  //
    {"engine/camera", 3},      {"engine/water", 3},  {"engine/occlusion", 3}, {"engine/depth", 3}, //
    {"engine/environment", 4},                                                                     //
    {"engine/render", 5},      {"engine/xr", 5},                                                   //
    {"input/hands", 5},        {"input/haptics", 5},                                               //
    {"game/texts", 5},         {"game/rules", 6},    {"game/feedback", 7},    {"game/playthrough", 8},
    {"game/settings", 8},                                                  //
    {"game/views", 9},         {"game/ui", 10},      {"game/session", 10}, //
    {"game/app", 11},          {"game/tools", 11},
};

// engine/media/live belongs to engine/media.
std::string folderOf(const std::string& file) {
    const size_t second = file.find('/', file.find('/') + 1);
    return file.substr(0, second);
}

Folders includesOf(const std::filesystem::path& root) {
    static const std::regex kInclude("^#include \"((?:engine|game|input)/[^\"]+)\"");
    Folders folders;
    for (const char* top : {"engine", "game", "input"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / top)) {
            const auto extension = entry.path().extension();
            if (extension != ".cpp" && extension != ".h") continue;
            if (entry.path().parent_path() == root / top) continue; // engine/Precompiled.h has no layer
            const std::string from = folderOf(std::filesystem::relative(entry.path(), root).string());
            folders[from];
            std::ifstream file(entry.path());
            std::smatch match;
            for (std::string line; std::getline(file, line);)
                if (std::regex_search(line, match, kInclude) && folderOf(match[1]) != from)
                    folders[from].insert(folderOf(match[1]));
        }
    return folders;
}

bool reaches(const Folders& folders, const std::string& from, const std::string& to,
             std::set<std::string>& visited) {
    if (!visited.insert(from).second) return false;
    for (const std::string& next : folders.at(from))
        if (next == to || reaches(folders, next, to, visited)) return true;
    return false;
}

} // namespace

TEST(Layers, AnArrowPointsToTheSameOrALowerLayer) {
    for (const auto& [from, targets] : includesOf(tests::sourceFolder())) {
        ASSERT_TRUE(kLayerOf.count(from)) << from << " is in no layer";
        for (const std::string& to : targets)
            EXPECT_LE(kLayerOf.at(to), kLayerOf.at(from)) << from << " includes " << to;
    }
}

TEST(Layers, NoFolderDependsOnItself) {
    const Folders folders = includesOf(tests::sourceFolder());
    for (const auto& [folder, targets] : folders) {
        std::set<std::string> visited;
        EXPECT_FALSE(reaches(folders, folder, folder, visited)) << folder;
    }
}

TEST(Layers, RulesKnowNeitherPicturesNorSoundNorDevices) {
    const std::set<std::string> allowed = {"engine/core", "engine/math", "engine/scene", "engine/physics",
                                           "engine/sim"};
    const auto folders = includesOf(tests::sourceFolder());
    for (const std::string& to : folders.at("game/rules"))
        EXPECT_TRUE(allowed.count(to)) << "game/rules includes " << to;
}

// Files survive a full disk and a crash only if all code writes them through this function.
TEST(Sources, WriteFilesThroughOneFunction) {
    static const std::regex kWrites(
        "ofstream|fopen\\(|imwrite|O_CREAT|avio_open(?!_dyn_buf)|(std::filesystem|fs)::rename");
    for (const char* top : {"engine", "game", "input"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(tests::sourceFolder() / top)) {
            const auto extension = entry.path().extension();
            if ((extension != ".cpp" && extension != ".h") || entry.path().stem() == "WriteFile") continue;
            std::ifstream file(entry.path());
            for (std::string line; std::getline(file, line);)
                EXPECT_FALSE(std::regex_search(line, kWrites)) << entry.path() << ": " << line;
        }
}

// States are equal on every machine only without functions whose results depend on compiler or library.
TEST(Sources, TheRulesUseNothingThatDiffersBetweenMachines) {
    static const std::regex kDiffers(
        "std::(sin|cos|tan|asin|acos|atan2?|exp2?|log2?|pow|hypot|cbrt)\\b|unordered_|_distribution|std::"
        "shuffle|"
        "random_device|system_clock|steady_clock|\\brand\\(|long "
        "double|glm::(sin|cos|tan|asin|acos|atan|exp|log|pow|angleAxis|slerp)\\b");
    for (const char* folder : {"game/rules", "engine/physics", "engine/sim"})
        for (const auto& entry : std::filesystem::directory_iterator(tests::sourceFolder() / folder)) {
            std::ifstream file(entry.path());
            for (std::string line; std::getline(file, line);)
                EXPECT_FALSE(std::regex_search(line.substr(0, line.find("//")), kDiffers))
                    << entry.path() << ": " << line;
        }
}

} // namespace shoal
