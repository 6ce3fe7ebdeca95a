// Shows an error to a player who has started the game from a menu and sees no terminal. Main thread.
#pragma once

#include <string>

namespace shoal::app {

// Returns whether no standard stream is a terminal and there is a display to show a box on.
bool startedFromMenu();

// Shows the text until the player closes it, by the first of zenity, kdialog and xmessage that is installed;
// they work where no window with OpenGL can be opened. Returns false if none is installed.
bool showMessageBox(const std::string& text);

} // namespace shoal::app
