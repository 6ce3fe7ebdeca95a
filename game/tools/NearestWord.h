// "Did you mean ...?" for a mistyped word. Any thread.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace shoal::app {

// Returns the restricted Damerau-Levenshtein distance: the insertions, deletions, substitutions and swaps of
// neighbouring letters from one word to the other, no letter edited twice.
int editDistance(std::string_view a, std::string_view b);

// Returns the known word at the smallest distance: at most 2, and less than half of the given word's letters,
// so that not every short word is near. Empty: there is none.
std::string_view nearestWord(std::string_view given, std::span<const std::string> known);

// Returns "; did you mean NAME?", or nothing.
std::string didYouMean(std::string_view given, std::span<const std::string> known);

} // namespace shoal::app
