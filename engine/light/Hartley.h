// The fast Hartley transform of many sequences side by side.
#pragma once

#include <vector>

namespace shoal::light {

// H(k) = sum over n of x(n) (cos + sin)(2 pi k n / N). It is real and its own inverse but for a factor N. A
// circular convolution with an even kernel is a product, as in a Fourier transform: H_out(k) = K(k) H_in(k),
// with K(k) = K(N - k). Bracewell 1984, "The fast Hartley transform".
class Hartley {
  public:
    explicit Hartley(int length); // N, a power of two >= 8

    // Transforms in place `lanes` sequences: element n of lane i at data[n * lanes + i]. lanes: a multiple of
    // 16. One thread at a time.
    void transform(float* data, int lanes);

  private:
    int length_;
    std::vector<int> order_;             // bit-reversed index of each element
    std::vector<float> cosines_, sines_; // of 2 pi k / N
    std::vector<float> work_;            // scratch for 16 lanes, which fits into the cache
};

} // namespace shoal::light
