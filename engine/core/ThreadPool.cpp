#include "engine/core/ThreadPool.h"

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace shoal {

// As the other constructor has finished by then, the destructor ends the helpers if one cannot be started.
ThreadPool::ThreadPool(int helpers) : ThreadPool() {
    for (int k = 0; k < helpers; ++k) helpers_.emplace_back([this] { wait(); });
}

ThreadPool::~ThreadPool() {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    next_ = parts_;
    called_.notify_all();
}

// Runs parts until none is left; call it with the lock held. Locking costs little beside a part's work.
void ThreadPool::work(std::unique_lock<std::mutex>& lock) {
    while (next_ < parts_) {
        const int mine = next_++;
        lock.unlock();
        part_(mine);
        lock.lock();
        if (--unfinished_ == 0) done_.notify_all();
    }
}

void ThreadPool::wait() {
    std::unique_lock lock(mutex_);
    for (;;) {
        called_.wait(lock, [&] { return stop_ || next_ < parts_; });
        if (stop_) return;
        work(lock);
    }
}

void ThreadPool::begin(int parts, std::function<void(int)> part) {
    {
        const std::lock_guard lock(mutex_);
        part_ = std::move(part);
        next_ = 0;
        parts_ = unfinished_ = parts;
    }
    called_.notify_all(); // beyond the lock, on which a helper would wait at once
}

void ThreadPool::finish() {
    std::unique_lock lock(mutex_);
    work(lock);
    done_.wait(lock, [&] { return unfinished_ == 0; });
}

void lowerThreadPriority() {
#ifdef __linux__
    // On Linux each thread has its own niceness; 10 gives it a tenth of the usual share of a processor.
    constexpr int kNiceness = 10;
    setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNiceness);
#endif
}

} // namespace shoal
