// The shaders of a dive are valid GLSL 3.30 and GLSL ES 3.00, by Khronos' reference compiler.
#include "engine/core/Files.h"
#include "engine/gl/Program.h"
#include "tests/Test.h"

#include <regex>

namespace shoal {
namespace {

// GLSL ES has no noperspective. Shaders use it only where w = 1, so that it makes no difference.
const std::string kDesktop = "#version 330 core\n",
                  kEs = "#version 300 es\nprecision highp float;\nprecision highp int;\n"
                        "precision highp sampler2D;\n#define noperspective\n";

// Every name that the shader asks for by #ifdef, but those of OLLFB, which is of OpenGL 4.3 and no dive's.
std::set<std::string> featuresOf(const std::string& stem) {
    std::set<std::string> features;
    const std::regex asked("#ifn?def (\\w+)|defined\\((\\w+)\\)");
    for (const char* stage : {".vert", ".frag"}) {
        const auto source = tests::valueOf(gl::readShader(stem + stage, {}, 330));
        for (std::sregex_iterator m(source.text.begin(), source.text.end(), asked), end; m != end; ++m)
            features.insert((*m)[1].matched ? (*m)[1] : (*m)[2]);
    }
    std::erase_if(features, [](const std::string& feature) { return feature.starts_with("LAYERS"); });
    return features;
}

class ShaderDialects : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Passes, ShaderDialects,
                         testing::Values("Background", "Depth", "EquirectComposite", "Fade", "FloorShadow",
                                         "Layer", "Object", "Planes", "Premultiply", "Particles"),
                         [](const auto& spec) { return std::string(spec.param); });

// Without features, with each, and with each pair of them.
TEST_P(ShaderDialects, Compile) {
    if (std::system("glslangValidator --version >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "no glslangValidator: install glslang-tools";
    const std::string stem = std::string("render/") + GetParam();
    const std::set<std::string> features = featuresOf(stem);
    std::set<std::set<std::string>> cases = {{}};
    for (const std::string& a : features)
        for (const std::string& b : features) cases.insert({a, b});
    cases.erase({"MIRRORS", "PHONG_RINGS"}); // two sources of glossy light: ObjectPass never asks for both
    const tests::ScratchFolder folder;
    std::string command = "cd '" + folder.path().string() + "' && glslangValidator";
    for (const std::string& header : {kDesktop, kEs})
        for (const char* stage : {".vert", ".frag"})
            for (const std::set<std::string>& with : cases) {
                std::string name = header == kEs ? "300" : "330";
                for (const std::string& feature : with) name += "_" + feature;
                const auto source =
                    tests::valueOf(gl::readShader(stem + stage, {with.begin(), with.end()}, 330));
                ASSERT_TRUE(source.text.starts_with(kDesktop));
                std::ofstream(folder / (name + stage)) << header << source.text.substr(kDesktop.size());
                command += " " + name + stage;
            }
    EXPECT_EQ(std::system((command + " >errors.txt").c_str()), 0) << readText(folder / "errors.txt").value();
}

} // namespace
} // namespace shoal
