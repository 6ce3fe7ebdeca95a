// Sends events to the window whose OpenGL context is current.
#pragma once

#include <functional>

namespace shoal::test {

// Pressed and released; the window learns of it when it looks for events next. glfwKey: F1 to F12, Escape,
// Enter, Down, Home.
void strikeKey(int glfwKey);

// Whenever the window looks for events, until it returns false.
void onEachPoll(std::function<bool()> then);

} // namespace shoal::test
