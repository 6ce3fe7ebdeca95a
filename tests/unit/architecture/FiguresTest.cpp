// Figures quoted in READMEs are those of tests/bench/figures, rounded as they are printed: figures.txt.
#include "engine/core/Files.h"
#include "tests/TestPaths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <vector>

namespace shoal::quoted {
namespace {
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

} // namespace

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

} // namespace shoal::quoted
