// Makes content/models/hand_*.occlusion.json: make_occlusion MODELS. Same program, same bytes.
#include "content/make/models/occlusion/HandOcclusion.h"

#include <cstdio>

int main(int count, char** arguments) {
    using namespace shoal;
    if (count != 2) return std::fputs("make_occlusion FOLDER: of the hands' models\n", stderr), 2;
    std::vector<occlusion::BodyPart> parts;
    for (const hands::Side side : {hands::Side::Right, hands::Side::Left}) {
        const char* name = side == hands::Side::Left ? "hand_left" : "hand_right";
        auto hand = make::loadHand(arguments[1], side);
        if (!hand) return std::fprintf(stderr, "%s\n", hand.error().message().c_str()), 1;
        std::printf("%s: ellipsoids\n", name), std::fflush(stdout);
        parts = parts.empty() ? make::fitHand(*hand) : make::mirrored(parts);
        std::printf("%s: self-occlusion\n", name), std::fflush(stdout);
        const std::string text = make::written(make::selfOccludeHand(std::move(*hand), parts));
        const Path file = render::bakedOcclusionBeside(Path(arguments[1]) / (std::string(name) + ".glb"));
        if (const Status kept = writeFileWhole(file, text); !kept)
            return std::fprintf(stderr, "%s\n", kept.error().message().c_str()), 1;
        std::printf("%s: %zu ellipsoids, %.0f kB\n", file.filename().c_str(), parts.size(),
                    static_cast<double>(text.size()) / 1e3);
    }
}
