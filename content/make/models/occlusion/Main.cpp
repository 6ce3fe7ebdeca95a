// shoal-occlusion: makes the occlusion of a model, or of all models of the game. Same program, same bytes.
#include "content/make/models/occlusion/HandOcclusion.h"
#include "engine/core/WriteFile.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace {

using namespace shoal;

Status write(const Path& model, const render::BakedOcclusion& baked) {
    const std::string text = make::written(baked);
    const Path file = render::bakedOcclusionBeside(model);
    std::printf("%s: %zu ellipsoids, %.1f kB\n", file.filename().c_str(), baked.parts.size(),
                static_cast<double>(text.size()) / 1e3);
    std::fflush(stdout);
    return writeFileWhole(file, text);
}

Status makeOne(const Path& model, const Path& file) {
    const auto baked = make::fitCreature(model);
    return baked ? writeFileWhole(file, make::written(*baked)) : Status(baked.error());
}

Status makeAll(const Path& models) {
    std::vector<Path> files;
    for (const auto& entry : std::filesystem::directory_iterator(models))
        if (entry.path().extension() == ".glb") files.push_back(entry.path());
    std::ranges::sort(files);
    for (const Path& file : files) {
        if (file.stem().string().starts_with("hand_")) continue;
        const auto baked = make::fitCreature(file);
        if (!baked) return baked.error();
        if (Status kept = write(file, *baked); !kept) return kept;
    }
    std::vector<occlusion::BodyPart> parts;
    for (const hands::Side side : {hands::Side::Right, hands::Side::Left}) {
        auto hand = make::loadHand(models, side);
        if (!hand) return hand.error();
        parts = parts.empty() ? make::fitHand(*hand) : make::mirrored(parts);
        const char* name = side == hands::Side::Left ? "hand_left.glb" : "hand_right.glb";
        if (Status kept = write(models / name, make::selfOccludeHand(*hand, parts)); !kept) return kept;
    }
    return Done{};
}

} // namespace

int main(int count, char** arguments) {
    if (count < 2 || count > 3 || *arguments[1] == '-') {
        std::fputs("shoal-occlusion MODEL FILE: makes the occlusion of a glTF model; Shoal reads it from\n"
                   "NAME.occlusion.json beside NAME.glb\n"
                   "shoal-occlusion FOLDER: makes that of all models of the game, in a folder such as\n"
                   "content/models\n",
                   stderr);
        return 2;
    }
    const Status made = count == 3 ? makeOne(arguments[1], arguments[2]) : makeAll(arguments[1]);
    if (!made) std::fprintf(stderr, "shoal-occlusion: %s\n", made.error().message().c_str());
    return made ? 0 : 1;
}
