// Good models with some of their bytes changed, a few thousand times, by a seeded generator: each is a sound
// model or an Error. Says most when built with the sanitizers.
#include "tests/robustness/gltf/Sound.h"

#include "engine/core/Log.h"
#include "engine/core/Random.h"

#include <cctype>
#include <iostream>
#include <spdlog/spdlog.h>
#include <unistd.h>

namespace shoal::scene {
namespace {

std::vector<Path> smallModels() {
    const Path shared = tests::sharedDataFolder();
    std::vector<Path> files;
    for (const Path& folder : {shared / "gltf", tests::sourceFolder() / "content/models"}) {
        std::error_code code;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, code))
            if (const auto extension = entry.path().extension(); extension == ".glb" || extension == ".gltf")
                if (entry.file_size() < 400'000) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string bytesOf(const Path& file) {
    auto bytes = readFile(file, 1 << 20);
    return bytes ? std::string(bytes->begin(), bytes->end()) : "";
}

// Changes mostly the JSON at the beginning, whose numbers decide which bytes are read.
void mutate(std::string& bytes, size_t jsonEnd, Random& random) {
    const auto size = static_cast<uint32_t>(bytes.size());
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

TEST(MutatedModels, EachIsAModelOrAnError) {
    const std::vector<Path> files = smallModels();
    if (files.empty()) GTEST_SKIP() << "no models";
    const tests::ScratchFolder folder;
    const auto level = spdlog::get_level();
    spdlog::set_level(spdlog::level::err); // thousands of warnings say nothing
    LoadLimits limits;
    limits.maxVertices = limits.maxIndices = limits.maxImagePixels = limits.maxKeyValues = 2'000'000;
    Random random(7);
    const char* more = std::getenv("SHOAL_ROUNDS");
    const int rounds = more ? std::atoi(more) : 150; // of each file
    int loaded = 0, refused = 0;
    for (const Path& file : files) {
        for (const auto& beside : std::filesystem::directory_iterator(file.parent_path()))
            if (beside.path().extension() == ".bin")
                std::filesystem::copy(beside.path(), folder / beside.path().filename(),
                                      std::filesystem::copy_options::overwrite_existing);
        const std::string good = bytesOf(file);
        const size_t jsonEnd = file.extension() == ".gltf" ? good.size() : good.find(std::string("BIN\0", 4));
        for (int round = 0; round < rounds; ++round) {
            std::string bytes = good;
            for (uint32_t i = 0, count = 1 + random.below(3); i < count && !bytes.empty(); ++i)
                mutate(bytes, jsonEnd, random);
            const Path changed = folder / ("changed" + file.extension().string());
            std::ofstream(changed, std::ios::binary) << bytes;
            SCOPED_TRACE(file.string() + ", round " + std::to_string(round));
            const auto model = loadModel(changed, {}, limits);
            (model ? loaded : refused) += 1;
            if (model) expectSound(*model);
            ASSERT_FALSE(testing::Test::HasFailure()) << "kept: " << changed;
        }
    }
    spdlog::set_level(level);
    std::cout << files.size() << " models: " << loaded << " variants loaded, " << refused << " refused\n";
}

} // namespace
} // namespace shoal::scene
