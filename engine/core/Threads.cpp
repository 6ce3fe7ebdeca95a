#include "engine/core/Threads.h"

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace shoal {

void lowerThreadPriority() {
#ifdef __linux__
    // On Linux niceness is each thread's own. 10: a tenth of the weight of a thread that has not stepped
    // back.
    constexpr int kNiceness = 10;
    setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNiceness);
#endif
}

} // namespace shoal
