#include "input/haptics/HapticOutput.h"

#include "engine/core/Log.h"
#include "input/haptics/Rack.h"

#include <atomic>
#include <chrono>
#include <thread>

namespace shoal::haptics {

namespace {

// Hands the newest value from one thread to another: three slots, of which the writer owns one, the reader
// one, and the one between is swapped. Neither side ever waits.
class Mailbox {
  public:
    void put(const HapticFrame& frame) {
        slots_[writing_] = frame;
        writing_ = between_.exchange(writing_ | kFresh, std::memory_order_acq_rel) & ~kFresh;
    }
    const HapticFrame& newest() {
        if (between_.load(std::memory_order_acquire) & kFresh)
            reading_ = between_.exchange(reading_, std::memory_order_acq_rel) & ~kFresh;
        return slots_[reading_];
    }

  private:
    static constexpr unsigned kFresh = 4;
    std::array<HapticFrame, 3> slots_{};
    std::atomic<unsigned> between_{1};
    unsigned writing_ = 0, reading_ = 2;
};

} // namespace

struct HapticOutput::State {
    Mailbox mailbox;
    std::atomic<int> ready{0};
    std::jthread thread; // last: it ends before what it uses

    explicit State(HidBus bus) {
        thread = std::jthread([this, bus = std::move(bus)](const std::stop_token& stop) {
            Rack rack(bus);
            const auto began = std::chrono::steady_clock::now();
            while (!stop.stop_requested()) {
                rack.step(mailbox.newest(),
                          std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
                ready = static_cast<int>(rack.ready());
                for (const std::string& complaint : rack.takeComplaints()) log::warn("{}", complaint);
                std::this_thread::sleep_for(std::chrono::milliseconds(4));
            }
        });
    }
};

HapticOutput::HapticOutput(HidBus bus) : state_(std::make_unique<State>(std::move(bus))) {}
HapticOutput::HapticOutput(HapticOutput&&) noexcept = default;
HapticOutput& HapticOutput::operator=(HapticOutput&&) noexcept = default;
HapticOutput::~HapticOutput() = default;

void HapticOutput::submit(const HapticFrame& frame) { state_->mailbox.put(frame); }
int HapticOutput::ready() const { return state_->ready; }

} // namespace shoal::haptics
