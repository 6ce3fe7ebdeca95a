#include "engine/scene/LoadModel.h"

#include "engine/core/Log.h"
#include "engine/scene/Document.h"
#include "engine/scene/Loading.h"
#include "engine/scene/ReadAnimations.h"
#include "engine/scene/ReadMaterials.h"
#include "engine/scene/ReadMeshes.h"
#include "engine/scene/ReadNodes.h"

#include <cmath>
#include <new>

namespace shoal::scene {

namespace {

// Each number of the file is finite, but a chain of large scales may leave the range of floats.
void checkRestPose(const Model& model) {
    Pose pose;
    restPose(model, pose);
    for (const int node : model.order) {
        const glm::mat4& m = pose.modelFromNode[static_cast<size_t>(node)];
        for (int i = 0; i < 16; ++i)
            if (!std::isfinite(m[i / 4][i % 4])) fault(element("nodes", node), " lies infinitely far away");
    }
}

Model load(Loading& loading) {
    const Document document = readDocument(loading);
    Model model;
    readMaterials(loading, document, model);
    readNodes(loading, document, model);
    readMeshes(loading, document, model);
    readAnimations(loading, document, model);
    checkRestPose(model);
    return model;
}

} // namespace

std::string quoted(const std::string& untrusted, size_t maxLength) {
    std::string shown = untrusted.substr(0, maxLength);
    for (char& c : shown)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
    return untrusted.size() > maxLength ? shown + "..." : shown;
}

Result<Model> loadModel(const Path& file, const LoadLimits& limits) {
    Loading loading{.file = file, .limits = limits, .warnings = {}};
    try {
        Model model = load(loading);
        for (const std::string& warning : loading.warnings) log::warn("{}: {}", file.string(), warning);
        return model;
    } catch (const std::bad_alloc&) {
        return Error{file.string(), "needs more memory than there is"};
    } catch (const std::exception& problem) {
        return Error{file.string(), problem.what()};
    }
}

} // namespace shoal::scene
