// shoal check: is this file usable, and if not, why? One line each.
#include "game/tools/Commands.h"

#include "engine/core/Files.h"
#include "engine/media/Check.h"
#include "engine/media/Pictures.h"
#include "engine/media/live/LivePlayer.h"
#include "engine/scene/Model.h"
#include "engine/sim/Recording.h"
#include "game/playthrough/Script.h"
#include "game/rules/Dive.h"

#include <cstdio>

namespace shoal::app {

using Verdict = Result<std::string>; // the kind of file, or why it is not usable

static std::string counted(size_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

// Returns whether the material is invisible whatever its textures hold.
static bool isTransparent(const scene::Material& material) {
    return (material.alphaMode == scene::AlphaMode::Blend && material.baseColourLin.a <= 0) ||
           (material.alphaMode == scene::AlphaMode::Mask && material.baseColourLin.a < material.alphaCutoff);
}

static Verdict checkModel(const Path& file) {
    auto model = scene::loadModel(file);
    if (!model) return model.error();
    size_t triangles = 0;
    bool seen = false;
    for (const scene::Mesh& mesh : model->meshes)
        for (const scene::Primitive& primitive : mesh.primitives) {
            triangles += primitive.indices.size() / 3;
            seen = seen || !isTransparent(model->materialOf(primitive));
        }
    return "a model of " + counted(triangles, "triangle", "triangles") + ", " +
           counted(model->materials.size(), "material", "materials") + ", " +
           counted(model->animations.size(), "animation", "animations") +
           (seen || triangles == 0 ? "" : "; all of it is wholly transparent: nothing will be seen");
}

// Checks a TOML file: its tables tell a dive, a playthrough or the species table.
static Verdict checkToml(const Path& file) {
    auto text = readText(file);
    if (!text) return text.error();
    const Path content = dataRoot() / "content";
    if (text->find("[[species]]") != std::string::npos) {
        auto species = game::loadSpecies(file);
        if (!species) return species.error();
        return "a table of " + counted(species->size(), "species", "species");
    }
    if (text->find("[[school]]") != std::string::npos) {
        auto species = game::loadSpecies(content / "species.toml");
        if (!species) return species.error();
        auto dive = game::loadDive(file, *species);
        if (!dive) return dive.error();
        return "a dive of " + std::to_string(static_cast<int>(dive->duration_s)) + " seconds, \"" +
               dive->title + "\"";
    }
    auto script = game::loadScript(file);
    if (!script) return script.error();
    return "a playthrough of " + counted(script->steps.size(), "step", "steps") + " and " +
           counted(script->expects.size(), "expectation", "expectations");
}

static Verdict checkReplay(const Path& file) {
    auto recording = sim::RecordingReader::open(file);
    if (!recording) return recording.error();
    if (const auto rules = game::rulesOf(recording->header()); !rules)
        return Error{file.string(), rules.error().reason};
    if (const auto dive = game::loadDiveFiles(recording->header().dive); !dive)
        return Error{file.string(), "its dive cannot be played: " + dive.error().message()};
    const uint64_t ticks = recording->ticks();
    while (!recording->atEnd())
        if (const auto tick = recording->next(); !tick) return tick.error();
    return "a replay of " + counted(ticks, "tick", "ticks") + " in the dive " + recording->header().dive +
           (recording->complete() ? "" : "; it is cut short, or damaged after these");
}

static Verdict checkFile(const Path& file, const std::string& layer) {
    const auto live = media::liveAddress(file.string());
    if (!live) return live.error();
    if (*live && !layer.empty()) return Error{file.string(), media::kNoLayers};
    if (*live) return media::checkLive(**live);
    if (!layer.empty()) return media::checkMedia(file, layer);
    const auto bytes = readFileBegin(file, 64 << 10);
    if (!bytes) return bytes.error();
    const std::string begin(bytes->begin(), bytes->end());
    if (begin.starts_with("SHOALRE")) return checkReplay(file);
    const size_t text = begin.find_first_not_of(" \t\r\n");
    if (begin.starts_with("glTF") || (text != begin.npos && begin[text] == '{')) return checkModel(file);
    const bool isNamedToml = extensionOf(file) == ".toml" && begin.find('\0') == begin.npos;
    return isNamedToml ? checkToml(file) : media::checkMedia(file);
}

int check(const CheckOptions& options) {
    bool allUsable = true;
    for (const std::string& file : options.files) {
        Verdict verdict = checkFile(file, options.layer);
        if (verdict)
            std::printf("usable: %s: %s\n", file.c_str(), verdict->c_str());
        else
            std::fprintf(stderr, "not usable: %s\n", verdict.error().message().c_str());
        allUsable &= verdict.ok();
    }
    return allUsable ? 0 : 1;
}

} // namespace shoal::app
