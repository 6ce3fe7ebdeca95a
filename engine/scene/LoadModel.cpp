#include "engine/scene/LoadModel.h"

#include "engine/core/Log.h"
#include "engine/scene/Gltf.h"

#include <cmath>
#include <new>

namespace shoal::scene {

namespace {

// Checks that matrices are finite: the file's numbers are, but nested large scales may exceed floats.
void checkRestPose(const Model& model) {
    Pose pose;
    restPose(model, pose);
    for (const int node : model.order)
        for (int i = 0; i < 16; ++i)
            if (!std::isfinite(pose.modelFromNode[node][i / 4][i % 4]))
                fault(element("nodes", node), " lies infinitely far away");
}

} // namespace

std::string quoted(const std::string& untrusted, size_t maxLength) {
    std::string shown = untrusted.substr(0, maxLength);
    for (char& c : shown)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
    return untrusted.size() > maxLength ? shown + "..." : shown;
}

Result<Model> loadModel(const Path& path, const LoadLimits& limits) {
    GltfFile file{.path = path, .limits = limits};
    try {
        readDocument(file);
        Model model;
        readMaterials(file, model);
        readNodes(file, model);
        readMeshes(file, model);
        readAnimations(file, model);
        checkRestPose(model);
        for (const std::string& warning : file.warnings) log::warn("{}: {}", path.string(), warning);
        return model;
    } catch (const std::bad_alloc&) {
        return Error{path.string(), "needs more memory than there is"};
    } catch (const std::exception& problem) {
        return Error{path.string(), problem.what()};
    }
}

} // namespace shoal::scene
