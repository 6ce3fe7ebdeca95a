#include "input/hands/webcam/landmarks/HandNets.h"

#include <TfLite_generated.h>
#include <xnnpack.h>

#include <bit>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>

namespace shoal::hands {

namespace {

using tflite::Operator;
using Shape = std::vector<size_t>;

constexpr size_t kExtra = XNN_EXTRA_BYTES / sizeof(float);
static_assert(std::endian::native == std::endian::little, "weights are copied as they are in the file");

// Limits of a layer's results.
struct Limits {
    float low, high;
};

Limits limitsOf(tflite::Activation activation) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    return {activation == tflite::Activation::None ? -kInfinity : 0,
            activation == tflite::Activation::Relu6 ? 6 : kInfinity};
}

uint32_t flagsOf(tflite::Padding padding) {
    return padding == tflite::Padding::Same ? uint32_t{XNN_FLAG_TENSORFLOW_SAME_PADDING} : 0u;
}

struct Tensor {
    Shape shape;
    size_t count = 0;
    std::span<const uint8_t> bytes; // of a constant
    const float* weights = nullptr; // the same, as single precision
    uint32_t id = XNN_INVALID_VALUE_ID;
    uint32_t externalId = XNN_INVALID_VALUE_ID, flags = 0;
};

class Builder {
  public:
    NeuralNet net;

    // Returns null, or the reason why it failed.
    const char* build(std::span<const uint8_t> file) {
        const tflite::Model& model = *tflite::GetModel(file.data());
        const tflite::SubGraph& graph = *model.subgraphs()->Get(0);
        for (const tflite::OperatorCode* code : *model.operator_codes()) codes_.push_back(code->code());
        readTensors(model, graph);
        placeInputAndOutputs(graph);
        if (xnn_initialize(nullptr) != xnn_status_success ||
            xnn_create_subgraph(static_cast<uint32_t>(externals_.size()), 0, &graph_) != xnn_status_success)
            return "cannot be run: XNNPACK does not work on this processor";
        const std::unique_ptr<xnn_subgraph, decltype(&xnn_delete_subgraph)> owner(graph_,
                                                                                  xnn_delete_subgraph);
        for (const Operator* op : *graph.operators())
            if (add(*op) != xnn_status_success) return "is not the known model";
        xnn_runtime_t runtime = nullptr;
        const bool made = xnn_create_runtime(graph_, &runtime) == xnn_status_success;
        net.runtime = {runtime, [](xnn_runtime* owned) { xnn_delete_runtime(owned); }};
        if (!made || xnn_setup_runtime(runtime, externals_.size(), externals_.data()) != xnn_status_success)
            return "is refused by XNNPACK";
        return nullptr;
    }

  private:
    tflite::Operation kind(const Operator& op) const { return codes_[op.code()]; }
    Tensor& tensor(const flatbuffers::Vector<int32_t>& list, uint32_t place) {
        return tensors_[list.Get(place)];
    }
    // Return the tensor as defined to XNNPACK, in single precision.
    const Tensor& in(const Operator& op, uint32_t place) { return define(tensor(*op.inputs(), place)); }
    const Tensor& out(const Operator& op) { return define(tensor(*op.outputs(), 0)); }

    void readTensors(const tflite::Model& model, const tflite::SubGraph& graph) {
        for (const tflite::Tensor* from : *graph.tensors()) {
            Tensor& tensor = tensors_.emplace_back();
            if (from->shape()) tensor.shape.assign(from->shape()->begin(), from->shape()->end());
            tensor.count =
                std::accumulate(tensor.shape.begin(), tensor.shape.end(), size_t{1}, std::multiplies<>());
            if (const auto* data = model.buffers()->Get(from->buffer())->data())
                tensor.bytes = {data->data(), data->size()};
        }
    }

    // The parts of a concatenation of rows are written one behind the other, so that it needs no operator.
    void placeInputAndOutputs(const tflite::SubGraph& graph) {
        const auto place = [&](Tensor& part, float* at, uint32_t flags) {
            part.externalId = static_cast<uint32_t>(externals_.size());
            part.flags = flags;
            externals_.push_back({part.externalId, at});
        };
        Tensor& input = tensor(*graph.inputs(), 0);
        net.input.resize(input.count + kExtra);
        place(input, net.input.data(), XNN_VALUE_FLAG_EXTERNAL_INPUT);
        for (uint32_t number = 0; number < graph.outputs()->size(); ++number) {
            Tensor& output = tensor(*graph.outputs(), number);
            float* at = net.outputs.emplace_back(output.count + kExtra).data();
            const Operator* joins = nullptr;
            for (const Operator* op : *graph.operators())
                if (kind(*op) == tflite::Operation::Concatenation && &tensor(*op->outputs(), 0) == &output)
                    joins = op;
            if (!joins) {
                place(output, at, XNN_VALUE_FLAG_EXTERNAL_OUTPUT);
                continue;
            }
            for (uint32_t k = 0; k < joins->inputs()->size(); ++k) {
                Tensor& part = tensor(*joins->inputs(), k);
                place(part, at, XNN_VALUE_FLAG_EXTERNAL_OUTPUT);
                at += part.count;
            }
        }
    }

    const Tensor& define(Tensor& tensor) {
        if (tensor.id != XNN_INVALID_VALUE_ID) return tensor;
        if (!tensor.weights && !tensor.bytes.empty()) {
            std::vector<float>& numbers = net.weights.emplace_back(tensor.count + kExtra);
            std::memcpy(numbers.data(), tensor.bytes.data(), tensor.bytes.size());
            tensor.weights = numbers.data();
        }
        // XNNPACK refuses an operator on a tensor that it did not accept here.
        xnn_define_tensor_value(graph_, xnn_datatype_fp32, tensor.shape.size(), tensor.shape.data(),
                                tensor.weights, tensor.externalId, tensor.flags, &tensor.id);
        return tensor;
    }

    // Converts weights of half precision.
    xnn_status dequantize(const Operator& op) {
        const Tensor& half = tensor(*op.inputs(), 0);
        Tensor& whole = tensor(*op.outputs(), 0);
        std::vector<float>& numbers = net.weights.emplace_back(whole.count + kExtra);
        std::vector<uint8_t> aligned(half.bytes.begin(), half.bytes.end());
        const auto count = static_cast<int>(whole.count);
        cv::Mat to(1, count, CV_32F, numbers.data());
        cv::Mat(1, count, CV_16F, aligned.data()).convertTo(to, CV_32F);
        whole.weights = numbers.data();
        return xnn_status_success;
    }

    // Calls one of XNNPACK's functions for convolutions. outChannels: the number of channels of the
    // output, for the function that takes it.
    template <class Define, class Options, class... Counts>
    xnn_status addConvolution(Define xnnDefine, const Operator& op, const Options& options,
                              Counts... outChannels) {
        const Tensor &from = in(op, 0), &filter = in(op, 1), &bias = in(op, 2), &to = out(op);
        const Limits limits = limitsOf(options.activation());
        return xnnDefine(graph_, 0, 0, 0, 0, static_cast<uint32_t>(filter.shape[1]),
                         static_cast<uint32_t>(filter.shape[2]), options.stride_h(), options.stride_w(), 1, 1,
                         1, from.shape[3], outChannels..., limits.low, limits.high, from.id, filter.id,
                         bias.id, to.id, flagsOf(options.padding()));
    }

    xnn_status addMaxPool(const Operator& op) {
        const Tensor &from = in(op, 0), &to = out(op);
        const auto& options = *op.options_as_PoolOptions();
        const Limits limits = limitsOf(options.activation());
        return xnn_define_max_pooling_2d(graph_, 0, 0, 0, 0, options.height(), options.width(),
                                         options.stride_h(), options.stride_w(), 1, 1, limits.low,
                                         limits.high, from.id, to.id, flagsOf(options.padding()));
    }

    xnn_status addPad(const Operator& op) {
        const Tensor &from = in(op, 0), &to = out(op);
        const std::span<const uint8_t> bytes = tensor(*op.inputs(), 1).bytes;
        std::vector<int32_t> by(bytes.size() / sizeof(int32_t)); // two for each dimension
        std::memcpy(by.data(), bytes.data(), bytes.size());
        Shape before, after;
        for (size_t i = 0; i < from.shape.size(); ++i) {
            before.push_back(static_cast<size_t>(by[2 * i]));
            after.push_back(static_cast<size_t>(by[2 * i + 1]));
        }
        return xnn_define_static_constant_pad(graph_, before.data(), after.data(), 0, from.id, to.id, 0);
    }

    // Fails if the operator is none of these, or XNNPACK refuses it.
    xnn_status add(const Operator& op) {
        const Limits none = limitsOf(tflite::Activation::None);
        switch (kind(op)) {
        case tflite::Operation::Concatenation: // its parts are in place
            return xnn_status_success;
        case tflite::Operation::Dequantize:
            return dequantize(op);
        case tflite::Operation::Convolution:
            return addConvolution(xnn_define_convolution_2d, op, *op.options_as_ConvolutionOptions(),
                                  tensor(*op.outputs(), 0).shape[3]);
        case tflite::Operation::DepthwiseConvolution:
            return addConvolution(xnn_define_depthwise_convolution_2d, op, *op.options_as_DepthwiseOptions());
        case tflite::Operation::MaxPool:
            return addMaxPool(op);
        case tflite::Operation::FullyConnected: {
            const Limits limits = limitsOf(op.options_as_FullyConnectedOptions()->activation());
            return xnn_define_fully_connected(graph_, limits.low, limits.high, in(op, 0).id, in(op, 1).id,
                                              in(op, 2).id, out(op).id, 0);
        }
        case tflite::Operation::Pad:
            return addPad(op);
        case tflite::Operation::Add: {
            const Limits limits = limitsOf(op.options_as_AddOptions()->activation());
            return xnn_define_add2(graph_, limits.low, limits.high, in(op, 0).id, in(op, 1).id, out(op).id,
                                   0);
        }
        case tflite::Operation::Logistic:
            return xnn_define_sigmoid(graph_, in(op, 0).id, out(op).id, 0);
        case tflite::Operation::Prelu:
            return xnn_define_prelu(graph_, in(op, 0).id, in(op, 1).id, out(op).id, 0);
        case tflite::Operation::Reshape: {
            const Shape& to = out(op).shape;
            return xnn_define_static_reshape(graph_, to.size(), to.data(), in(op, 0).id, out(op).id, 0);
        }
        case tflite::Operation::Mean: // over the whole picture
            return xnn_define_global_average_pooling_2d(graph_, none.low, none.high, in(op, 0).id, out(op).id,
                                                        0);
        case tflite::Operation::ResizeBilinear: { // between the middles of pixels
            const Shape& to = out(op).shape;
            return xnn_define_static_resize_bilinear_2d(graph_, to[1], to[2], in(op, 0).id, out(op).id, 0);
        }
        }
        return xnn_status_unsupported_parameter;
    }

    std::vector<Tensor> tensors_;
    std::vector<tflite::Operation> codes_;
    std::vector<xnn_external_value> externals_;
    xnn_subgraph_t graph_ = nullptr;
};

} // namespace

Result<NeuralNet> NeuralNet::read(std::span<const uint8_t> tfLite, const std::string& name) {
    Builder builder;
    if (const char* fault = builder.build(tfLite)) return Error{name, fault};
    return std::move(builder.net);
}

bool NeuralNet::run() { return xnn_invoke_runtime(runtime.get()) == xnn_status_success; }

} // namespace shoal::hands
