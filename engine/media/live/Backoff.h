// How long to wait before trying again: longer each time in vain.
#pragma once

#include <algorithm>

namespace shoal::media {

class Backoff {
  public:
    Backoff(double first_s, double most_s) : first_s_(first_s), most_s_(most_s), next_s_(first_s) {}

    double next_s() {
        const double now_s = next_s_;
        next_s_ = std::min(2 * next_s_, most_s_);
        return now_s;
    }
    void succeeded() { next_s_ = first_s_; }

  private:
    double first_s_, most_s_, next_s_;
};

} // namespace shoal::media
