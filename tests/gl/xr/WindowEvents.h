// Sends events to the window whose OpenGL context is current.
#pragma once

#include <functional>

namespace shoal::test {

// Presses and releases a key of X; the window gets both events at its next poll.
void strikeKey(const char* key);

// Calls the function whenever the window polls events, until it returns false.
void onEachPoll(std::function<bool()> then);

} // namespace shoal::test
