// A convolutional network, read from a TensorFlow Lite file and run by XNNPACK on the calling thread.
#pragma once

#include "engine/core/Result.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

struct xnn_runtime;

namespace shoal::hands {

class NeuralNet {
  public:
    // Reads a file whose checksum was verified before; its contents are not checked. name: for the error.
    static Result<NeuralNet> read(std::span<const uint8_t> tfLite, const std::string& name);

    // The one input, to be filled before run(): rows of pixels of channels.
    std::span<float> input() { return {input_.data(), inputCount_}; }
    const std::vector<size_t>& inputShape() const { return inputShape_; } // dimensions, first the batch (1)
    bool run();
    // Outputs in the file's order.
    size_t outputs() const { return outputs_.size(); }
    std::span<const float> output(size_t number) const {
        return {outputs_[number].data(), outputCounts_[number]};
    }

  private:
    NeuralNet() = default;
    struct Delete {
        void operator()(xnn_runtime* runtime) const;
    };
    class Builder;

    // XNNPACK reads a little beyond the ends of arrays: all are longer than counted.
    std::vector<float> input_;
    size_t inputCount_ = 0;
    std::vector<size_t> inputShape_;
    std::vector<std::vector<float>> outputs_, weights_;
    std::vector<size_t> outputCounts_;
    std::unique_ptr<xnn_runtime, Delete> runtime_; // last: it uses all of the above
};

} // namespace shoal::hands
