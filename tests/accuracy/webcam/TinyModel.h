// A made network that uses every operator that NeuralNet knows: for its test, and as a seed of its fuzz
// target.
#pragma once

#include <TfLite_generated.h>

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <vector>

namespace shoal::hands::test {

// Of a picture of 4 by 4 pixels of two channels that are everywhere a and b, with v = (a + 2b + 0.25, b / 2 -
// a), its negative parts times a half and a quarter:
//   output 0: 28 rows of 2: 10v, 7v, 7v, 5v; then these as 2 by 2 pixels, resized to 4 by 4 and with a third
//   channel of 0;
//   output 1: three numbers: sigmoid of 7.25 v.x, of 7.25 v.y, and of 1.
class TinyModel {
  public:
    std::vector<uint8_t> make() {
        using namespace tflite;
        const auto picture = tensor({1, 4, 4, 2});
        // 1, 2, -1, 0.5 of half precision.
        const auto half =
            constant<uint16_t>({2, 1, 1, 2}, TensorType::Float16, {0x3c00, 0x4000, 0xbc00, 0x3800});
        const auto filter = tensor({2, 1, 1, 2}), mixed = tensor({1, 4, 4, 2}), bent = tensor({1, 4, 4, 2});
        add(Operation::Dequantize, {half}, filter);
        add(Operation::Convolution, {picture, filter, floats({2}, {0.25f, 0})}, mixed,
            Options::ConvolutionOptions, CreateConvolutionOptions(to_, Padding::Valid, 1, 1).Union());
        add(Operation::Prelu, {mixed, floats({1, 1, 2}, {0.5f, 0.25f})}, bent);
        const auto sums = tensor({1, 2, 2, 2}), most = tensor({1, 2, 2, 2}), both = tensor({1, 2, 2, 2});
        add(Operation::DepthwiseConvolution,
            {bent, floats({1, 3, 3, 2}, std::vector<float>(18, 1)), floats({2}, {0, 0})}, sums,
            Options::DepthwiseOptions, CreateDepthwiseOptions(to_, Padding::Same, 2, 2, 1).Union());
        add(Operation::MaxPool, {bent}, most, Options::PoolOptions,
            CreatePoolOptions(to_, Padding::Valid, 2, 2, 2, 2).Union());
        add(Operation::Add, {sums, most}, both, Options::AddOptions, CreateAddOptions(to_).Union());
        const auto large = tensor({1, 4, 4, 2}), padded = tensor({1, 4, 4, 3}), mean = tensor({1, 2}),
                   dense = tensor({1, 3});
        add(Operation::ResizeBilinear, {both, integers({2}, {4, 4})}, large, Options::ResizeOptions,
            CreateResizeOptions(to_, 0, 0, false, true).Union());
        add(Operation::Pad, {large, integers({4, 2}, {0, 0, 0, 0, 0, 0, 0, 1})}, padded);
        add(Operation::Mean, {both, integers({2}, {1, 2})}, mean);
        add(Operation::FullyConnected, {mean, floats({3, 2}, {1, 0, 0, 1, 0, 0}), floats({3}, {0, 0, 1})},
            dense, Options::FullyConnectedOptions, CreateFullyConnectedOptions(to_).Union());
        const auto small = tensor({1, 4, 2}), rest = tensor({1, 24, 2}), joined = tensor({1, 28, 2}),
                   sure = tensor({1, 3});
        add(Operation::Logistic, {dense}, sure);
        add(Operation::Reshape, {both}, small);
        add(Operation::Reshape, {padded}, rest);
        add(Operation::Concatenation, {small, rest}, joined, Options::ConcatenationOptions,
            CreateConcatenationOptions(to_, 1).Union());

        return finish(picture, {joined, sure});
    }

    // Layers of 1024 by 1024 weights, all of one tensor.
    std::vector<uint8_t> makeLayers(int count) {
        const auto picture = tensor({1, 1, 1, 1024}),
                   weights = floats({1024, 1024}, std::vector<float>(1024 * 1024)),
                   bias = floats({1024}, std::vector<float>(1024));
        auto last = tensor({1, 1024});
        add(tflite::Operation::Reshape, {picture}, last);
        for (int i = 0; i < count; ++i) {
            const auto next = tensor({1, 1024});
            add(tflite::Operation::FullyConnected, {last, weights, bias}, next);
            last = next;
        }
        return finish(picture, {last});
    }

    // A pixel, resized to so many pictures of 1024 by 1024.
    std::vector<uint8_t> makePictures(int count) {
        const auto picture = tensor({1, 1, 1, 1}), size = integers({2}, {1024, 1024});
        std::vector<int32_t> outs;
        for (int i = 0; i < count; ++i) {
            outs.push_back(tensor({1, 1024, 1024, 1}));
            add(tflite::Operation::ResizeBilinear, {picture, size}, outs.back(),
                tflite::Options::ResizeOptions, tflite::CreateResizeOptions(to_, 0, 0, false, true).Union());
        }
        return finish(picture, outs);
    }

  private:
    std::vector<uint8_t> finish(int32_t in, const std::vector<int32_t>& outs) {
        const std::vector<int32_t> ins{in};
        const auto graph = tflite::CreateSubGraphDirect(to_, &tensors_, &ins, &outs, &operators_);
        const std::vector graphs{graph};
        FinishModelBuffer(to_, tflite::CreateModelDirect(to_, 3, &codes_, &graphs, "made", &buffers_));
        return {to_.GetBufferPointer(), to_.GetBufferPointer() + to_.GetSize()};
    }
    int32_t tensor(const std::vector<int32_t>& shape, tflite::TensorType type = tflite::TensorType::Float32,
                   uint32_t buffer = 0) {
        if (buffers_.empty())
            buffers_.push_back(tflite::CreateBuffer(to_)); // that of tensors without constants
        tensors_.push_back(tflite::CreateTensorDirect(to_, &shape, type, buffer));
        return static_cast<int32_t>(tensors_.size() - 1);
    }
    template <class T>
    int32_t constant(const std::vector<int32_t>& shape, tflite::TensorType type,
                     const std::vector<T>& values) {
        if (buffers_.empty()) buffers_.push_back(tflite::CreateBuffer(to_));
        std::vector<uint8_t> bytes(values.size() * sizeof(T));
        std::memcpy(bytes.data(), values.data(), bytes.size());
        buffers_.push_back(tflite::CreateBufferDirect(to_, &bytes));
        return tensor(shape, type, static_cast<uint32_t>(buffers_.size() - 1));
    }
    int32_t floats(const std::vector<int32_t>& shape, const std::vector<float>& values) {
        return constant(shape, tflite::TensorType::Float32, values);
    }
    int32_t integers(const std::vector<int32_t>& shape, const std::vector<int32_t>& values) {
        return constant(shape, tflite::TensorType::Int32, values);
    }
    void add(tflite::Operation operation, const std::vector<int32_t>& in, int32_t out,
             tflite::Options kind = tflite::Options::NONE, flatbuffers::Offset<void> options = 0) {
        codes_.push_back(tflite::CreateOperatorCode(to_, 0, 0, 1, operation));
        const std::vector<int32_t> outs{out};
        operators_.push_back(tflite::CreateOperatorDirect(to_, static_cast<uint32_t>(codes_.size() - 1), &in,
                                                          &outs, kind, options));
    }

    flatbuffers::FlatBufferBuilder to_;
    std::vector<flatbuffers::Offset<tflite::Buffer>> buffers_;
    std::vector<flatbuffers::Offset<tflite::Tensor>> tensors_;
    std::vector<flatbuffers::Offset<tflite::OperatorCode>> codes_;
    std::vector<flatbuffers::Offset<tflite::Operator>> operators_;
};

} // namespace shoal::hands::test
