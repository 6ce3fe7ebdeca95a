// damaged_TARGET FOLDER...: gives a fuzz target each file below the folders (relative ones: of the reference
// data) as it is, cut short, and with bytes changed by a seeded generator. Ends with 77 if there is none.
#include "engine/core/Random.h"
#include "tests/TestPaths.h"
#include "tests/fuzz/Target.h"

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <spdlog/spdlog.h>
#include <vector>

using namespace shoal;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace {

std::string tried; // said where it ends the process
int inputs = 0;

void tryIt(std::string_view bytes, const std::string& how) {
    tried = how;
    ++inputs;
    LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
}

// Changes mostly the JSON of a model, whose numbers decide which bytes are read.
void changeModel(std::string& bytes, size_t jsonEnd, Random& random) {
    const auto size = static_cast<uint32_t>(bytes.size());
    if (size == 0) return;
    const uint32_t within =
        random.below(4) == 0 ? size : static_cast<uint32_t>(std::min<size_t>(jsonEnd, size));
    size_t at = random.below(within);
    switch (random.below(8)) {
    case 0: // any byte
        bytes[at] = static_cast<char>(random.next());
        break;
    case 1: // a huge 32-bit number
        for (size_t i = at; i < std::min<size_t>(at + 4, size); ++i) bytes[i] = '\xFF';
        break;
    case 2:
        bytes.resize(at);
        break;
    default: // another digit, sign or bracket for the next digit
        while (at < within && !std::isdigit(static_cast<unsigned char>(bytes[at]))) ++at;
        if (at < within) bytes[at] = "0123456789-.]}"[random.below(14)];
        break;
    }
}

// Changes 1 to 8 bytes, every second time within the first 256, where headers are.
void changeBytes(std::string& bytes, bool head, Random& random) {
    const size_t range = head ? std::min<size_t>(256, bytes.size()) : bytes.size();
    for (uint32_t left = 1 + random.below(8); left > 0; --left)
        bytes[random.below(static_cast<uint32_t>(range))] = static_cast<char>(random.next());
}

void damage(const Path& file) {
    constexpr size_t kCuts = 40, kChanged = 150;
    const auto read = readFile(file, 400'000);
    if (!read || read->empty()) return; // larger
    fuzz::beside = file.parent_path();
    const std::string good(read->begin(), read->end());
    tryIt(good, file.string());
    for (size_t i = 0; i < kCuts; ++i) {
        const size_t length = std::min(i < 16 ? 4 * i : good.size() * i / kCuts, good.size());
        tryIt(std::string_view(good).substr(0, length), file.string() + ", cut at " + std::to_string(length));
    }
    const bool isModel = file.extension() == ".glb" || file.extension() == ".gltf";
    for (size_t seed = 0; seed < kChanged; ++seed) {
        Random random(seed);
        std::string bytes = good;
        if (isModel)
            for (uint32_t left = 1 + random.below(3); left > 0; --left)
                changeModel(bytes, good.find(std::string_view("BIN\0", 4)), random);
        else
            changeBytes(bytes, seed % 2 == 0, random);
        tryIt(bytes, file.string() + ", seed " + std::to_string(seed));
    }
}

} // namespace

int main(int count, char** arguments) {
    spdlog::set_level(spdlog::level::err); // thousands of warnings say nothing
    std::signal(SIGABRT, [](int) { std::fprintf(stderr, "%s\n", tried.c_str()); });
    std::vector<Path> files;
    for (int i = 1; i < count; ++i) {
        std::error_code code;
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(tests::sharedDataFolder() / arguments[i], code))
            if (const auto end = entry.path().extension();
                entry.is_regular_file() && end != ".bin" && end != ".json")
                files.push_back(entry.path());
    }
    std::ranges::sort(files);
    for (const Path& file : files) damage(file);
    std::printf("%zu files: %d of %d inputs were taken\n", files.size(), fuzz::taken, inputs);
    return files.empty() ? 77 : fuzz::taken == 0;
}
