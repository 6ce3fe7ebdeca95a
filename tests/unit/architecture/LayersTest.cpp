// The layers of the source tree, read from its #include lines: an arrow points to the same or a lower layer,
// and folders never depend on each other in a circle. What sources may not use, and figures
// that READMEs quote.
#include "engine/core/Files.h"
#include "tests/Test.h"

#include <regex>

namespace shoal {
namespace {

// Calls visit(path below the root, line) for each line of the sources below a folder.
template <class Visit> void eachLine(const std::string& top, const Visit& visit) {
    const std::filesystem::path root = tests::sourceFolder();
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / top)) {
        const auto file = std::filesystem::relative(entry.path(), root);
        if (file.extension() != ".cpp" && file.extension() != ".h") continue;
        std::ifstream text(entry.path());
        for (std::string line; std::getline(text, line);) visit(file, line);
    }
}

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

Folders layerIncludes() {
    static const std::regex kInclude("^#include \"((?:engine|game|input)/[^\"]+)\"");
    Folders folders;
    for (const char* top : {"engine", "game", "input"})
        eachLine(top, [&](const std::filesystem::path& file, const std::string& line) {
            if (file.parent_path() == top) return; // engine/Precompiled.h has no layer
            const std::string from = folderOf(file.string());
            folders[from];
            std::smatch match;
            if (std::regex_search(line, match, kInclude) && folderOf(match[1]) != from)
                folders[from].insert(folderOf(match[1]));
        });
    return folders;
}

bool reaches(const Folders& folders, const std::string& from, const std::string& to,
             std::set<std::string>& visited) {
    if (!visited.insert(from).second) return false;
    for (const std::string& next : folders.at(from))
        if (next == to || reaches(folders, next, to, visited)) return true;
    return false;
}

TEST(Layers, AnArrowPointsToTheSameOrALowerLayer) {
    for (const auto& [from, targets] : layerIncludes()) {
        ASSERT_TRUE(kLayerOf.count(from)) << from << " is in no layer";
        for (const std::string& to : targets)
            EXPECT_LE(kLayerOf.at(to), kLayerOf.at(from)) << from << " includes " << to;
    }
}

TEST(Layers, NoFolderDependsOnItself) {
    const Folders folders = layerIncludes();
    for (const auto& [folder, targets] : folders) {
        std::set<std::string> visited;
        EXPECT_FALSE(reaches(folders, folder, folder, visited)) << folder;
    }
}

TEST(Layers, RulesKnowNeitherPicturesNorSoundNorDevices) {
    const std::set<std::string> allowed = {"engine/core", "engine/math", "engine/scene", "engine/physics",
                                           "engine/sim"};
    const auto folders = layerIncludes();
    for (const std::string& to : folders.at("game/rules"))
        EXPECT_TRUE(allowed.count(to)) << "game/rules includes " << to;
}

// Files survive a full disk and a crash only if all code writes them through this function.
TEST(Sources, WriteFilesThroughOneFunction) {
    static const std::regex kWrites(
        "ofstream|fopen\\(|imwrite|O_CREAT|avio_open(?!_dyn_buf)|(std::filesystem|fs)::rename");
    for (const char* top : {"engine", "game", "input"})
        eachLine(top, [](const std::filesystem::path& file, const std::string& line) {
            if (file.stem() != "WriteFile") {
                EXPECT_FALSE(std::regex_search(line, kWrites)) << file << ": " << line;
            }
        });
}

// States are equal on every machine only without functions whose results depend on compiler or library.
TEST(Sources, TheRulesUseNothingThatDiffersBetweenMachines) {
    static const std::regex kDiffers(
        "std::(sin|cos|tan|asin|acos|atan2?|exp2?|log2?|pow|hypot|cbrt)\\b|unordered_|_distribution|std::"
        "shuffle|"
        "random_device|system_clock|steady_clock|\\brand\\(|long "
        "double|glm::(sin|cos|tan|asin|acos|atan|exp|log|pow|angleAxis|slerp)\\b");
    for (const char* folder : {"game/rules", "engine/physics", "engine/sim"})
        eachLine(folder, [](const std::filesystem::path& file, const std::string& line) {
            EXPECT_FALSE(std::regex_search(line.substr(0, line.find("//")), kDiffers))
                << file << ": " << line;
        });
}

// Figures quoted in READMEs are those of tests/bench/figures, rounded as they are printed: figures.txt.
std::string textOf(const std::string& file) {
    const auto text = readText(tests::sourceFolder() / file);
    EXPECT_TRUE(text) << file;
    return text ? *text : "";
}

// Returns the number at "FIGURES / SECTION / ROW / COLUMN [/ UNIT]"; NaN if there is no such cell.
double figureAt(const std::string& place) {
    static const std::regex kPlace(" *(.+?) / (.+?) / (.+?) / ([0-9]+)(?: / ([0-9]+))?");
    std::smatch part;
    if (!std::regex_match(place, part, kPlace)) return NAN;
    const std::string figures = "\n" + textOf("tests/bench/figures/" + part[1].str() + ".md");
    const size_t from = part[2] == "-" ? 0 : figures.find("\n" + part[2].str());
    const size_t row = figures.find("\n| " + part[3].str() + " |", from);
    if (from == std::string::npos || row == std::string::npos) return NAN;
    std::istringstream cells(figures.substr(row + 2)); // behind the row's first bar
    std::string cell;
    for (int i = 0; i <= std::stoi(part[4]); ++i) std::getline(cells, cell, '|');
    return std::atof(cell.c_str()) / (part[5].matched ? std::stod(part[5]) : 1);
}

// Returns the README's numbers at the places where the phrase has "#".
std::vector<std::string> numbersIn(const std::string& readme, const std::string& phrase) {
    const std::string text = std::regex_replace(textOf(readme), std::regex("\\s+"), " ");
    const std::string plain = std::regex_replace(phrase, std::regex(R"([.|*()+^$?\[\]{}\\])"), R"(\$&)");
    std::smatch match;
    if (!std::regex_search(text, match,
                           std::regex(std::regex_replace(plain, std::regex("#"), "([0-9.]*[0-9])"))))
        return {};
    return {match.begin() + 1, match.end()};
}

double lastDigit(const std::string& number) {
    const size_t point = number.find('.');
    return point == std::string::npos ? 1 : std::pow(10.0, -static_cast<double>(number.size() - point - 1));
}

TEST(Figures, ReadmesQuoteMeasuredFigures) {
    std::istringstream lines(textOf("tests/unit/architecture/figures.txt"));
    std::string quote;
    std::vector<std::string> numbers; // of the quote, of which `next` were compared
    size_t next = 0, quotes = 0;
    const auto allWereCompared = [&] { EXPECT_EQ(next, numbers.size()) << quote; };
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line.starts_with('#')) continue;
        if (line.starts_with(' ')) {
            ASSERT_LT(next, numbers.size()) << quote << ": is not there, or has fewer numbers";
            const std::string& number = numbers[next++];
            EXPECT_NEAR(std::stod(number), figureAt(line), 0.501 * lastDigit(number)) << quote << line;
            continue;
        }
        allWereCompared();
        quote = line;
        const size_t colon = line.find(": ");
        numbers = numbersIn(line.substr(0, colon), line.substr(colon + 2));
        next = 0, ++quotes;
    }
    allWereCompared();
    EXPECT_GT(quotes, 15u);
}

} // namespace
} // namespace shoal
