// Every malformed glTF file among the reference data yields a value or an Error in one sentence.
#include "tests/Test.h"
#include "tests/robustness/gltf/Sound.h"

namespace shoal::scene {
namespace {

Path malformedFolder() { return tests::sharedDataFolder() / "malformed"; }

std::vector<Path> malformedFiles() {
    std::vector<Path> files;
    std::error_code code;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(malformedFolder(), code)) {
        const std::string extension = entry.path().extension().string();
        if (entry.is_regular_file() && (extension == ".gltf" || extension == ".glb"))
            files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

TEST(MalformedModels, EachIsAModelOrAnError) {
    const std::vector<Path> files = malformedFiles();
    if (files.empty()) GTEST_SKIP() << "no reference data at " << malformedFolder();
    size_t refused = 0;
    for (const Path& file : files) {
        SCOPED_TRACE(file.string());
        const Result<Model> model = loadModel(file);
        if (model) {
            expectSound(*model);
            continue;
        }
        ++refused;
        EXPECT_EQ(model.error().path, file.string());
        EXPECT_FALSE(model.error().reason.empty());
        EXPECT_EQ(model.error().reason.find('\n'), std::string::npos);
        EXPECT_FALSE(model.error().reason.ends_with('.'));
    }
    std::printf("%zu files, %zu refused\n", files.size(), refused);
}

} // namespace
} // namespace shoal::scene
