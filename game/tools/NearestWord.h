// "Did you mean ...?" for a mistyped word. Any thread.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shoal::app {

// Returns the restricted Damerau-Levenshtein distance: the insertions, deletions, substitutions and swaps of
// neighbouring letters from one word to the other, no letter edited twice.
inline int editDistance(std::string_view a, std::string_view b) {
    const size_t columns = b.size() + 1;
    std::vector<int> distances((a.size() + 1) * columns); // distance of each prefix of a to each prefix of b
    const auto at = [&](size_t i, size_t j) -> int& { return distances[i * columns + j]; };
    for (size_t i = 0; i <= a.size(); ++i) at(i, 0) = static_cast<int>(i);
    for (size_t j = 0; j <= b.size(); ++j) at(0, j) = static_cast<int>(j);
    for (size_t i = 1; i <= a.size(); ++i)
        for (size_t j = 1; j <= b.size(); ++j) {
            const int substituted = at(i - 1, j - 1) + (a[i - 1] != b[j - 1]);
            at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, substituted});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
        }
    return at(a.size(), b.size());
}

// Returns "; did you mean WORD?" with the known word at the smallest distance, or nothing if that is more
// than 2 or not less than half of the given word's letters, so that not every short word is near.
inline std::string didYouMean(std::string_view given, std::span<const std::string> known) {
    constexpr size_t kLongest = 64; // longest word that may be mistyped
    constexpr int kMaxDistance = 2;
    if (given.size() > kLongest) return "";
    const auto distance = [&](const std::string& word) { return editDistance(given, word); };
    const auto nearest = std::ranges::min_element(known, {}, distance);
    if (nearest == known.end()) return "";
    const int smallest = distance(*nearest);
    if (smallest > kMaxDistance || 2 * static_cast<size_t>(smallest) >= given.size()) return "";
    return "; did you mean " + *nearest + "?";
}

} // namespace shoal::app
