#include "engine/core/ThreadPool.h"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#ifdef __linux__
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace shoal {

struct ThreadPool::State {
    std::mutex mutex;
    std::condition_variable called, done;
    // Guarded by mutex:
    void (*part)(void*, int) = nullptr;
    void* context = nullptr;
    int next = 0, parts = 0, unfinished = 0;
    bool stop = false;
    std::vector<std::thread> helpers;

    // With the lock held; parts are so large that taking one costs nothing beside it.
    void work(std::unique_lock<std::mutex>& lock) {
        while (next < parts) {
            const int mine = next++;
            lock.unlock();
            part(context, mine);
            lock.lock();
            if (--unfinished == 0) done.notify_all();
        }
    }

    void wait() {
        std::unique_lock lock(mutex);
        for (;;) {
            called.wait(lock, [&] { return stop || next < parts; });
            if (stop) return;
            work(lock);
        }
    }
};

ThreadPool::ThreadPool(int helpers) : state_(std::make_unique<State>()) {
    for (int k = 0; k < helpers; ++k) state_->helpers.emplace_back([state = state_.get()] { state->wait(); });
}

ThreadPool::ThreadPool(ThreadPool&&) noexcept = default;
ThreadPool& ThreadPool::operator=(ThreadPool&& other) noexcept {
    std::swap(state_, other.state_);
    return *this;
}

ThreadPool::~ThreadPool() {
    if (!state_) return;
    {
        const std::lock_guard lock(state_->mutex);
        state_->stop = true;
        state_->next = state_->parts;
    }
    state_->called.notify_all();
    for (std::thread& helper : state_->helpers) helper.join();
}

void ThreadPool::start(int parts, void (*part)(void*, int), void* context) {
    State& s = *state_;
    {
        const std::lock_guard lock(s.mutex);
        s.part = part;
        s.context = context;
        s.next = 0;
        s.parts = s.unfinished = parts;
    }
    s.called.notify_all();
}

void ThreadPool::finish() {
    State& s = *state_;
    std::unique_lock lock(s.mutex);
    s.work(lock);
    s.done.wait(lock, [&] { return s.unfinished == 0; });
}

void lowerThreadPriority() {
#ifdef __linux__
    // On Linux niceness is each thread's own. 10: a tenth of the weight of a thread that has not stepped
    // back.
    constexpr int kNiceness = 10;
    setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNiceness);
#endif
}

} // namespace shoal
