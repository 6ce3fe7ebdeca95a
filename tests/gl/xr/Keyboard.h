// Keys struck in the window whose OpenGL context is current.
#pragma once

namespace shoal::test {

// Pressed and released; the window learns of it when it looks for events next. glfwKey: GLFW_KEY_F1 to F12.
void strikeFunctionKey(int glfwKey);

} // namespace shoal::test
