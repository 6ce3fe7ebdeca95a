// Tests of the search for a headset's runtime, which follows the OpenXR loader's.
#include "engine/xr/Headset.h"
#include "tests/TestPaths.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace shoal::xr {
namespace {

TEST(HeadsetRuntime, IsFoundInThePlayersFolderOrByItsVariable) {
    const bool elsewhere = std::filesystem::exists("/etc/xdg/openxr/1/active_runtime.json") ||
                           std::filesystem::exists("/etc/openxr/1/active_runtime.json");
    const tests::ScratchFolder folder;
    ::unsetenv("XR_RUNTIME_JSON");
    ::setenv("XDG_CONFIG_HOME", folder.path().c_str(), 1);
    EXPECT_EQ(Headset::hasRuntime(), elsewhere);
    std::filesystem::create_directories(folder.path() / "openxr/1");
    std::ofstream(folder.path() / "openxr/1/active_runtime.json") << "{}";
    EXPECT_TRUE(Headset::hasRuntime());
    ::setenv("XDG_CONFIG_HOME", (folder.path() / "empty").c_str(), 1);
    EXPECT_EQ(Headset::hasRuntime(), elsewhere);
    ::setenv("XR_RUNTIME_JSON", "/a/runtime.json", 1);
    EXPECT_TRUE(Headset::hasRuntime());
    ::unsetenv("XR_RUNTIME_JSON");
    ::unsetenv("XDG_CONFIG_HOME");
}

} // namespace
} // namespace shoal::xr
