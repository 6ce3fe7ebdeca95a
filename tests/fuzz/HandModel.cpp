// Models of hands: whatever the file, what is read runs within its bounds.
#include "input/hands/webcam/landmarks/NeuralNet.h"
#include "tests/fuzz/Target.h"

#include <algorithm>

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::vector<uint8_t> aligned(data, data + size); // as a file that was read
    auto net = hands::NeuralNet::read(aligned, "input.tflite");
    if (!net) return 0;
    fuzz::expect(net->inputShape().size() == 4 && net->outputs() >= 1);
    std::ranges::fill(net->input(), 0.5f);
    if (!net->run()) return 0;
    [[maybe_unused]] static volatile float last;
    for (size_t i = 0; i < net->outputs(); ++i)
        for (const float number : net->output(i)) last = number;
    return 0;
}
