// Every malformed glTF file among the reference data yields a value or an Error in one sentence.
#include "tests/Test.h"
#include "tests/robustness/gltf/Sound.h"

namespace shoal::scene {
namespace {

TEST(MalformedModels, EachIsAModelOrAnError) {
    const Path folder = tests::sharedDataFolder() / "malformed";
    if (!exists(folder)) GTEST_SKIP() << "no reference data at " << folder;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const Path& file = entry.path();
        if (file.extension() != ".gltf" && file.extension() != ".glb") continue;
        SCOPED_TRACE(file.string());
        const Result<Model> model = loadModel(file);
        if (model) {
            EXPECT_TRUE(isSound(*model));
            continue;
        }
        EXPECT_EQ(model.error().path, file.string());
        EXPECT_FALSE(model.error().reason.empty());
        EXPECT_EQ(model.error().reason.find('\n'), std::string::npos);
        EXPECT_FALSE(model.error().reason.ends_with('.'));
    }
}

} // namespace
} // namespace shoal::scene
