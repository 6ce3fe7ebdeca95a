// How threads share the processor.
#pragma once

namespace shoal {

// The calling thread, and those it starts from now on, step back while others want to run: for work that has
// a frame of the video's time to finish, beside threads that have a frame of the display's. Does nothing
// where the system knows no such thing.
void stepBack();

} // namespace shoal
