// Every malformed glTF file among the reference data yields a value or an Error in one sentence. Each lies
// beside the Khronos validator's verdict, FILE.report.json; how many of those with errors are refused is
// printed.
#include "tests/TestPaths.h"
#include "tests/robustness/gltf/Sound.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>

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

int validatorErrors(const Path& file, std::string& codes) {
    std::ifstream stream(file.string() + ".report.json");
    if (!stream) return 0;
    const auto report = nlohmann::json::parse(stream, nullptr, false);
    if (report.is_discarded() || !report.contains("issues")) return 0;
    for (const auto& message : report["issues"].value("messages", nlohmann::json::array()))
        if (message.value("severity", 1) == 0) codes += " " + message.value("code", "");
    return report["issues"].value("numErrors", 0);
}

TEST(MalformedModels, EachIsAModelOrAnError) {
    const std::vector<Path> files = malformedFiles();
    if (files.empty()) GTEST_SKIP() << "no reference data at " << malformedFolder();
    int refused = 0, wrong = 0, wrongRefused = 0, rightRefused = 0;
    const bool tell = std::getenv("SHOAL_VERBOSE") != nullptr;
    for (const Path& file : files) {
        SCOPED_TRACE(file.string());
        const auto start = std::chrono::steady_clock::now();
        const Result<Model> model = loadModel(file);
        const std::chrono::duration<double, std::milli> took_ms = std::chrono::steady_clock::now() - start;
        std::string codes;
        const bool hasErrors = validatorErrors(file, codes) > 0;
        wrong += hasErrors;
        const std::string name = file.lexically_relative(malformedFolder()).string();
        if (model) {
            expectSound(*model);
            if (tell && hasErrors) std::cout << "accepted: " << name << codes << '\n';
        } else {
            ++refused;
            (hasErrors ? wrongRefused : rightRefused) += 1;
            EXPECT_EQ(model.error().path, file.string());
            EXPECT_FALSE(model.error().reason.empty());
            EXPECT_EQ(model.error().reason.find('\n'), std::string::npos);
            EXPECT_FALSE(model.error().reason.ends_with('.'));
            if (tell)
                std::cout << (hasErrors ? "refused: " : "REFUSED: ") << name << ": " << model.error().reason
                          << " |" << codes << '\n';
        }
        if (tell && took_ms.count() > 100) std::cout << name << " took " << took_ms.count() << " ms\n";
    }
    std::cout << files.size() << " files, " << refused << " refused: " << wrongRefused << " of the " << wrong
              << " in which the Khronos validator finds errors, and " << rightRefused << " others\n";
}

} // namespace
} // namespace shoal::scene
