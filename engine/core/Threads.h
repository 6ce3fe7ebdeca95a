// Scheduling priority of threads.
#pragma once

namespace shoal {

// Lowers the priority of the calling thread and of those it starts from now on: for work with a deadline of a
// video frame, beside threads with the deadline of a display frame. Without effect where the system has no
// priorities for threads.
void lowerThreadPriority();

} // namespace shoal
