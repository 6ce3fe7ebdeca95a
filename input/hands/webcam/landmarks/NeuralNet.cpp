#include "input/hands/webcam/landmarks/NeuralNet.h"

#include <TfLite_generated.h>
#include <opencv2/core.hpp>
#include <xnnpack.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

namespace shoal::hands {

namespace {

using Shape = std::vector<size_t>;

constexpr size_t kMostTensors = 1024;                    // of a network, and as many operators
constexpr size_t kMostNumbers = size_t{1} << 21;         // of a tensor
constexpr size_t kMostInAll = size_t{1} << 25;           // of all tensors
constexpr size_t kMostMultiplications = size_t{1} << 30; // of a run
// XNNPACK keeps weights for each operator that uses them, though these share a tensor, and a pointer for each
// pixel that a pixel of a result is made from.
constexpr size_t kMostWeights = size_t{1} << 23, kMostPointers = size_t{1} << 23;
constexpr size_t kMostWide = 1 << 14;             // of a dimension
constexpr int kMostKernel = 16, kMostStride = 16; // pixels
constexpr size_t kExtra = XNN_EXTRA_BYTES / sizeof(float);
static_assert(std::endian::native == std::endian::little, "weights are copied as they are in the file");

size_t countOf(const Shape& shape) {
    return std::accumulate(shape.begin(), shape.end(), size_t{1}, std::multiplies<>());
}

// Of a convolution or pooling; 0: it does not fit.
size_t outputSize(size_t input, size_t kernel, size_t stride, tflite::Padding padding) {
    if (padding == tflite::Padding::Same) return (input + stride - 1) / stride;
    return input < kernel ? 0 : (input - kernel) / stride + 1;
}

struct Limits {
    float low = -std::numeric_limits<float>::infinity(), high = std::numeric_limits<float>::infinity();
};

struct Tensor {
    Shape shape;
    size_t count = 0;
    tflite::TensorType type{};
    std::span<const uint8_t> bytes; // of a constant
    const float* weights = nullptr; // the same, as single precision
    bool made = false;              // it has its numbers when the next operator runs
    bool used = false;              // by a later operator
    uint32_t id = XNN_INVALID_VALUE_ID;
    uint32_t externalId = XNN_INVALID_VALUE_ID, flags = 0;
};

} // namespace

void NeuralNet::Delete::operator()(xnn_runtime* runtime) const { xnn_delete_runtime(runtime); }

// Functions return false where the file is wrong; fault_ then says how.
class NeuralNet::Builder {
  public:
    bool build(std::span<const uint8_t> file);
    NeuralNet net;
    const char* fault() const { return fault_; }

  private:
    using Operator = tflite::Operator;
    struct Window {
        size_t height, width;
        int strideHeight, strideWidth;
        tflite::Padding padding;
    };

    bool require(bool holds, const char* otherwise) {
        if (!holds && !fault_) fault_ = otherwise;
        return holds;
    }
    bool readTensors(const tflite::Model& model, const tflite::SubGraph& graph);
    bool placeInputAndOutputs(const tflite::SubGraph& graph);
    bool add(const Operator& op);
    bool addDequantize(const Operator& op);
    bool addConvolution(const Operator& op, bool depthwise);
    bool addMaxPool(const Operator& op);
    bool addFullyConnected(const Operator& op);
    bool addPad(const Operator& op);
    bool addOther(const Operator& op);

    tflite::Operation kind(const Operator& op) const {
        return op.code() < codes_.size() ? codes_[op.code()] : tflite::Operation(-1);
    }
    Tensor* tensor(const flatbuffers::Vector<int32_t>* list, uint32_t place) {
        if (!list || place >= list->size()) return nullptr;
        const auto index = static_cast<uint32_t>(list->Get(place));
        return index < tensors_.size() ? &tensors_[index] : nullptr;
    }
    Tensor* floats(const Operator& op, uint32_t place);  // an input that is there
    Tensor* weights(const Operator& op, uint32_t place); // one that is constant
    std::optional<std::vector<int32_t>> integers(const Operator& op, uint32_t place);
    Tensor* output(const Operator& op); // the one output, which is not there yet
    bool define(Tensor& tensor);
    bool finish(Tensor& made, xnn_status status);
    std::optional<Limits> limitsOf(tflite::Activation activation);
    bool fits(const Window& window, const Tensor& in, const Tensor& out);
    bool mayMultiply(const Tensor& weights, size_t times);
    bool mayPoint(size_t count);

    std::vector<Tensor> tensors_;
    std::vector<tflite::Operation> codes_;
    std::vector<xnn_external_value> externals_;
    std::vector<Tensor*> externalOutputs_;
    xnn_subgraph_t graph_ = nullptr;
    size_t multiplications_ = 0, weights_ = 0, pointers_ = 0;
    const char* fault_ = nullptr;
};

bool NeuralNet::Builder::readTensors(const tflite::Model& model, const tflite::SubGraph& graph) {
    if (!require(graph.tensors() && model.buffers() && graph.tensors()->size() <= kMostTensors,
                 "has too many tensors or none"))
        return false;
    size_t all = 0;
    for (const tflite::Tensor* from : *graph.tensors()) {
        Tensor& tensor = tensors_.emplace_back();
        tensor.type = from->type();
        if (from->shape())
            for (const int32_t size : *from->shape()) {
                if (!require(size > 0 && static_cast<size_t>(size) <= kMostWide && tensor.shape.size() < 4,
                             "has a tensor of a size that is not supported"))
                    return false;
                tensor.shape.push_back(static_cast<size_t>(size));
            }
        tensor.count = countOf(tensor.shape); // at most 2^56
        if (!require(tensor.count <= kMostNumbers && (all += tensor.count) <= kMostInAll, "is too large"))
            return false;
        if (from->buffer() >= model.buffers()->size()) return require(false, "lacks a buffer");
        if (const auto* data = model.buffers()->Get(from->buffer())->data()) {
            const size_t width = tensor.type == tflite::TensorType::Float16 ? 2 : 4;
            if (data->size() == 0) continue;
            if (!require(data->size() == width * tensor.count,
                         "has a constant that is not as long as stated"))
                return false;
            tensor.bytes = {data->data(), data->size()};
        }
    }
    return true;
}

// A concatenation of rows is where its parts are: they are written one behind the other at once.
bool NeuralNet::Builder::placeInputAndOutputs(const tflite::SubGraph& graph) {
    Tensor* in = tensor(graph.inputs(), 0);
    if (!require(in && graph.inputs()->size() == 1 && in->bytes.empty() &&
                     in->type == tflite::TensorType::Float32 && in->shape.size() == 4 && in->shape[0] == 1,
                 "needs one input, a picture") ||
        !require(graph.outputs() && graph.outputs()->size() >= 1 && graph.outputs()->size() <= 8,
                 "needs one to eight outputs"))
        return false;
    net.inputShape_ = in->shape;
    net.inputCount_ = in->count;
    net.input_.resize(in->count + kExtra);
    in->externalId = 0;
    in->flags = XNN_VALUE_FLAG_EXTERNAL_INPUT;
    externals_.push_back({0, net.input_.data()});
    const auto place = [&](Tensor* part, float* at) {
        if (!require(part && part->bytes.empty() && part->externalId == XNN_INVALID_VALUE_ID &&
                         externals_.size() < 64,
                     "has an output that cannot be one"))
            return false;
        part->externalId = static_cast<uint32_t>(externals_.size());
        part->flags = XNN_VALUE_FLAG_EXTERNAL_OUTPUT;
        externals_.push_back({part->externalId, at});
        externalOutputs_.push_back(part);
        return true;
    };
    for (uint32_t number = 0; number < graph.outputs()->size(); ++number) {
        Tensor* out = tensor(graph.outputs(), number);
        if (!require(out, "lacks an output")) return false;
        net.outputCounts_.push_back(out->count);
        float* at = net.outputs_.emplace_back(out->count + kExtra).data();
        const Operator* joins = nullptr;
        for (const Operator* op : *graph.operators())
            if (kind(*op) == tflite::Operation::Concatenation && tensor(op->outputs(), 0) == out) joins = op;
        if (!joins) {
            if (!place(out, at)) return false;
            continue;
        }
        const auto* options = joins->options_as_ConcatenationOptions();
        size_t before = 1, together = 0;
        const size_t rank = out->shape.size();
        const size_t axis = options && options->axis() >= 0 ? static_cast<size_t>(options->axis()) : rank;
        for (size_t i = 0; i < std::min(axis, rank); ++i) before *= out->shape[i];
        if (!require(joins->inputs() && axis < rank && before == 1 &&
                         options->activation() == tflite::Activation::None,
                     "joins tensors in a way that is not supported"))
            return false;
        for (uint32_t k = 0; k < joins->inputs()->size(); ++k) {
            Tensor* part = tensor(joins->inputs(), k);
            if (!require(part && together + part->count <= out->count, "joins tensors that do not fit") ||
                !place(part, at + together))
                return false;
            together += part->count;
        }
        if (!require(together == out->count, "joins tensors that do not fit")) return false;
    }
    return true;
}

bool NeuralNet::Builder::define(Tensor& tensor) {
    return require(tensor.id != XNN_INVALID_VALUE_ID ||
                       xnn_define_tensor_value(graph_, xnn_datatype_fp32, tensor.shape.size(),
                                               tensor.shape.data(), tensor.weights, tensor.externalId,
                                               tensor.flags, &tensor.id) == xnn_status_success,
                   "has a tensor that XNNPACK refuses");
}

Tensor* NeuralNet::Builder::floats(const Operator& op, uint32_t place) {
    Tensor* found = tensor(op.inputs(), place);
    if (!require(found && found->type == tflite::TensorType::Float32 && !found->shape.empty(),
                 "has an operator that lacks an input"))
        return nullptr;
    if (!found->made && !found->bytes.empty()) {
        std::vector<float>& numbers = net.weights_.emplace_back(found->count + kExtra);
        std::memcpy(numbers.data(), found->bytes.data(), found->bytes.size());
        found->weights = numbers.data();
        found->made = true;
    }
    found->used = true;
    return require(found->made, "uses a tensor before it is made") && define(*found) ? found : nullptr;
}

Tensor* NeuralNet::Builder::weights(const Operator& op, uint32_t place) {
    Tensor* found = floats(op, place);
    return found && require(found->weights, "has weights that are not constant") ? found : nullptr;
}

std::optional<std::vector<int32_t>> NeuralNet::Builder::integers(const Operator& op, uint32_t place) {
    const Tensor* found = tensor(op.inputs(), place);
    if (!require(found && found->type == tflite::TensorType::Int32 && !found->bytes.empty(),
                 "has an operator that lacks its numbers"))
        return std::nullopt;
    std::vector<int32_t> numbers(found->count);
    std::memcpy(numbers.data(), found->bytes.data(), found->bytes.size());
    return numbers;
}

Tensor* NeuralNet::Builder::output(const Operator& op) {
    Tensor* found = tensor(op.outputs(), 0);
    const bool fresh = found && op.outputs()->size() == 1 && found->type == tflite::TensorType::Float32 &&
                       !found->shape.empty() && found->bytes.empty() && !found->made;
    return require(fresh, "has an operator without an output of its own") && define(*found) ? found : nullptr;
}

bool NeuralNet::Builder::finish(Tensor& made, xnn_status status) {
    made.made = true;
    return require(status == xnn_status_success, "has an operator that XNNPACK refuses");
}

std::optional<Limits> NeuralNet::Builder::limitsOf(tflite::Activation activation) {
    switch (activation) {
    case tflite::Activation::None:
        return Limits{};
    case tflite::Activation::Relu:
        return Limits{.low = 0};
    case tflite::Activation::Relu6:
        return Limits{0, 6};
    }
    require(false, "has an activation that is not supported");
    return std::nullopt;
}

bool NeuralNet::Builder::fits(const Window& window, const Tensor& in, const Tensor& out) {
    const auto within = [](int stride) { return stride >= 1 && stride <= kMostStride; };
    return require(
               in.shape.size() == 4 && out.shape.size() == 4 && in.shape[0] == 1 && out.shape[0] == 1 &&
                   within(window.strideHeight) && within(window.strideWidth) && window.height >= 1 &&
                   window.width >= 1 && window.height <= kMostKernel && window.width <= kMostKernel &&
                   (window.padding == tflite::Padding::Same || window.padding == tflite::Padding::Valid) &&
                   out.shape[1] == outputSize(in.shape[1], window.height,
                                              static_cast<size_t>(window.strideHeight), window.padding) &&
                   out.shape[2] == outputSize(in.shape[2], window.width,
                                              static_cast<size_t>(window.strideWidth), window.padding),
               "has a convolution whose sizes do not fit") &&
           mayPoint(window.height * window.width * out.shape[1] * out.shape[2]);
}

bool NeuralNet::Builder::mayMultiply(const Tensor& weights, size_t times) {
    weights_ += weights.count;
    multiplications_ += weights.count * times;
    return require(weights_ <= kMostWeights && multiplications_ <= kMostMultiplications, "is too large");
}

bool NeuralNet::Builder::mayPoint(size_t count) {
    pointers_ += count;
    return require(pointers_ <= kMostPointers, "is too large");
}

bool NeuralNet::Builder::addDequantize(const Operator& op) {
    const Tensor* half = tensor(op.inputs(), 0);
    Tensor* out = tensor(op.outputs(), 0);
    if (!require(half && out && half->type == tflite::TensorType::Float16 && !half->bytes.empty() &&
                     out->type == tflite::TensorType::Float32 && half->shape == out->shape &&
                     !out->shape.empty() && out->bytes.empty() && !out->made && out->flags == 0,
                 "has weights that are not of half precision"))
        return false;
    std::vector<float>& numbers = net.weights_.emplace_back(out->count + kExtra);
    std::vector<uint8_t> aligned(half->bytes.begin(), half->bytes.end());
    const auto count = static_cast<int>(out->count);
    cv::Mat whole(1, count, CV_32F, numbers.data());
    cv::Mat(1, count, CV_16F, aligned.data()).convertTo(whole, CV_32F);
    out->weights = numbers.data();
    out->made = true;
    return true;
}

bool NeuralNet::Builder::addConvolution(const Operator& op, bool depthwise) {
    const Tensor *in = floats(op, 0), *filter = weights(op, 1), *bias = weights(op, 2);
    Tensor* out = output(op);
    const auto* plain = op.options_as_ConvolutionOptions();
    const auto* deep = op.options_as_DepthwiseOptions();
    if (!in || !filter || !bias || !out) return false;
    if (!require((depthwise
                      ? deep && deep->multiplier() == 1 && deep->dilation_h() == 1 && deep->dilation_w() == 1
                      : plain && plain->dilation_h() == 1 && plain->dilation_w() == 1) &&
                     filter->shape.size() == 4,
                 "has a convolution that is not supported"))
        return false;
    const Window window{filter->shape[1], filter->shape[2], depthwise ? deep->stride_h() : plain->stride_h(),
                        depthwise ? deep->stride_w() : plain->stride_w(),
                        depthwise ? deep->padding() : plain->padding()};
    const auto limits = limitsOf(depthwise ? deep->activation() : plain->activation());
    if (!limits || !fits(window, *in, *out)) return false;
    const size_t from = in->shape[3], to = out->shape[3];
    if (!require(bias->shape == Shape{to} &&
                     (depthwise ? filter->shape[0] == 1 && filter->shape[3] == from && to == from
                                : filter->shape[0] == to && filter->shape[3] == from),
                 "has a convolution whose channels do not fit"))
        return false;
    if (!mayMultiply(*filter, out->shape[1] * out->shape[2])) return false;
    const auto height = static_cast<uint32_t>(window.height), width = static_cast<uint32_t>(window.width),
               down = static_cast<uint32_t>(window.strideHeight),
               across = static_cast<uint32_t>(window.strideWidth),
               flags =
                   window.padding == tflite::Padding::Same ? uint32_t{XNN_FLAG_TENSORFLOW_SAME_PADDING} : 0u;
    return finish(*out, depthwise ? xnn_define_depthwise_convolution_2d(graph_, 0, 0, 0, 0, height, width,
                                                                        down, across, 1, 1, 1, from,
                                                                        limits->low, limits->high, in->id,
                                                                        filter->id, bias->id, out->id, flags)
                                  : xnn_define_convolution_2d(graph_, 0, 0, 0, 0, height, width, down, across,
                                                              1, 1, 1, from, to, limits->low, limits->high,
                                                              in->id, filter->id, bias->id, out->id, flags));
}

bool NeuralNet::Builder::addMaxPool(const Operator& op) {
    const Tensor* in = floats(op, 0);
    Tensor* out = output(op);
    const auto* options = op.options_as_PoolOptions();
    if (!in || !out ||
        !require(options && options->height() > 0 && options->width() > 0, "has a pool of no size"))
        return false;
    const Window window{static_cast<size_t>(options->height()), static_cast<size_t>(options->width()),
                        options->stride_h(), options->stride_w(), options->padding()};
    const auto limits = limitsOf(options->activation());
    if (!limits || !fits(window, *in, *out) ||
        !require(in->shape[3] == out->shape[3], "has a pool that changes channels"))
        return false;
    return finish(
        *out, xnn_define_max_pooling_2d(
                  graph_, 0, 0, 0, 0, static_cast<uint32_t>(window.height),
                  static_cast<uint32_t>(window.width), static_cast<uint32_t>(window.strideHeight),
                  static_cast<uint32_t>(window.strideWidth), 1, 1, limits->low, limits->high, in->id, out->id,
                  window.padding == tflite::Padding::Same ? uint32_t{XNN_FLAG_TENSORFLOW_SAME_PADDING} : 0u));
}

bool NeuralNet::Builder::addFullyConnected(const Operator& op) {
    const Tensor *in = floats(op, 0), *filter = weights(op, 1), *bias = weights(op, 2);
    Tensor* out = output(op);
    const auto* options = op.options_as_FullyConnectedOptions();
    if (!in || !filter || !bias || !out) return false;
    const auto limits = limitsOf(options ? options->activation() : tflite::Activation::None);
    if (!limits || !require(in->shape.size() == 2 && filter->shape == Shape{out->count, in->count} &&
                                bias->shape == Shape{out->count} && out->shape == Shape{1, out->count},
                            "has a layer whose sizes do not fit"))
        return false;
    return mayMultiply(*filter, 1) &&
           finish(*out, xnn_define_fully_connected(graph_, limits->low, limits->high, in->id, filter->id,
                                                   bias->id, out->id, 0));
}

bool NeuralNet::Builder::addPad(const Operator& op) {
    const Tensor* in = floats(op, 0);
    Tensor* out = output(op);
    const auto by = integers(op, 1);
    if (!in || !out || !by) return false;
    const size_t rank = in->shape.size();
    bool fits = by->size() == 2 * rank && out->shape.size() == rank;
    Shape before(rank), after(rank);
    for (size_t i = 0; fits && i < rank; ++i) {
        const int64_t low = (*by)[2 * i], high = (*by)[2 * i + 1];
        fits = low >= 0 && high >= 0 &&
               low + high + static_cast<int64_t>(in->shape[i]) == static_cast<int64_t>(out->shape[i]);
        before[i] = static_cast<size_t>(low);
        after[i] = static_cast<size_t>(high);
    }
    return require(fits, "has a margin that does not fit") &&
           finish(*out,
                  xnn_define_static_constant_pad(graph_, before.data(), after.data(), 0, in->id, out->id, 0));
}

bool NeuralNet::Builder::addOther(const Operator& op) {
    const Tensor* in = floats(op, 0);
    Tensor* out = in ? output(op) : nullptr;
    if (!out) return false;
    const Shape &from = in->shape, &to = out->shape;
    constexpr const char* kMisfit = "has an operator whose sizes do not fit";
    switch (kind(op)) {
    case tflite::Operation::Add: {
        const Tensor* other = floats(op, 1);
        const auto* options = op.options_as_AddOptions();
        const auto limits = limitsOf(options ? options->activation() : tflite::Activation::None);
        return other && limits && require(from == to && other->shape == to, kMisfit) &&
               finish(*out,
                      xnn_define_add2(graph_, limits->low, limits->high, in->id, other->id, out->id, 0));
    }
    case tflite::Operation::Logistic:
        return require(from == to, kMisfit) && finish(*out, xnn_define_sigmoid(graph_, in->id, out->id, 0));
    case tflite::Operation::Prelu: {
        const Tensor* slope = weights(op, 1);
        return slope &&
               require(from == to && slope->count == to.back() && slope->shape.back() == to.back(),
                       kMisfit) &&
               finish(*out, xnn_define_prelu(graph_, in->id, slope->id, out->id, 0));
    }
    case tflite::Operation::Reshape:
        return require(in->count == out->count, kMisfit) &&
               finish(*out, xnn_define_static_reshape(graph_, to.size(), to.data(), in->id, out->id, 0));
    case tflite::Operation::Mean: { // over the whole picture
        const auto axes = integers(op, 1);
        return axes &&
               require(*axes == std::vector<int32_t>{1, 2} && from.size() == 4 && from[0] == 1 &&
                           out->count == from[3],
                       kMisfit) &&
               finish(*out, xnn_define_global_average_pooling_2d(graph_, Limits{}.low, Limits{}.high, in->id,
                                                                 out->id, 0));
    }
    case tflite::Operation::ResizeBilinear: {
        const auto* options = op.options_as_ResizeOptions();
        return require(options && options->half_pixel_centers() && !options->align_corners() &&
                           from.size() == 4 && to.size() == 4 && from[0] == 1 && to[0] == 1 &&
                           from[3] == to[3],
                       kMisfit) &&
               mayPoint(4 * to[1] * to[2]) &&
               finish(*out, xnn_define_static_resize_bilinear_2d(graph_, to[1], to[2], in->id, out->id, 0));
    }
    default:
        return require(false, "has an operator that is not supported");
    }
}

bool NeuralNet::Builder::add(const Operator& op) {
    switch (kind(op)) {
    case tflite::Operation::Dequantize:
        return addDequantize(op);
    case tflite::Operation::Convolution:
    case tflite::Operation::DepthwiseConvolution:
        return addConvolution(op, kind(op) == tflite::Operation::DepthwiseConvolution);
    case tflite::Operation::MaxPool:
        return addMaxPool(op);
    case tflite::Operation::FullyConnected:
        return addFullyConnected(op);
    case tflite::Operation::Pad:
        return addPad(op);
    case tflite::Operation::Concatenation: // its parts are in place
        return true;
    default:
        return addOther(op);
    }
}

bool NeuralNet::Builder::build(std::span<const uint8_t> file) {
    flatbuffers::Verifier verifier(file.data(), file.size());
    if (!require(file.size() >= 8 && file.size() < FLATBUFFERS_MAX_BUFFER_SIZE &&
                     tflite::VerifyModelBuffer(verifier),
                 "is no TensorFlow Lite model"))
        return false;
    const tflite::Model& model = *tflite::GetModel(file.data());
    if (!require(model.version() == 3 && model.subgraphs() && model.subgraphs()->size() == 1 &&
                     model.operator_codes(),
                 "is no model of version 3 with one graph"))
        return false;
    const tflite::SubGraph& graph = *model.subgraphs()->Get(0);
    if (!require(graph.operators() && graph.operators()->size() <= kMostTensors,
                 "has too many operators or none"))
        return false;
    for (const tflite::OperatorCode* code : *model.operator_codes()) codes_.push_back(code->code());
    if (!readTensors(model, graph) || !placeInputAndOutputs(graph)) return false;
    if (!require(xnn_initialize(nullptr) == xnn_status_success &&
                     xnn_create_subgraph(static_cast<uint32_t>(externals_.size()), 0, &graph_) ==
                         xnn_status_success,
                 "cannot be run: XNNPACK does not work on this processor"))
        return false;
    const std::unique_ptr<xnn_subgraph, decltype(&xnn_delete_subgraph)> owner(graph_, xnn_delete_subgraph);
    Tensor& in = *tensor(graph.inputs(), 0);
    in.made = true;
    if (!define(in)) return false;
    for (const Operator* op : *graph.operators())
        if (!add(*op)) return false;
    for (const Tensor* out : externalOutputs_)
        if (!require(out->made, "has an output that nothing makes")) return false;
    for (const Tensor& each : tensors_) // XNNPACK aborts over results that go nowhere
        if (!require(!each.made || each.weights || each.used || each.flags == XNN_VALUE_FLAG_EXTERNAL_OUTPUT,
                     "makes what nothing uses"))
            return false;
    xnn_runtime_t runtime = nullptr;
    const bool made = xnn_create_runtime(graph_, &runtime) == xnn_status_success;
    net.runtime_.reset(runtime);
    return require(made &&
                       xnn_setup_runtime(runtime, externals_.size(), externals_.data()) == xnn_status_success,
                   "is refused by XNNPACK");
}

Result<NeuralNet> NeuralNet::read(std::span<const uint8_t> tfLite, const std::string& name) {
    Builder builder;
    if (!builder.build(tfLite)) return Error{name, builder.fault()};
    return std::move(builder.net);
}

bool NeuralNet::run() { return xnn_invoke_runtime(runtime_.get()) == xnn_status_success; }

} // namespace shoal::hands
