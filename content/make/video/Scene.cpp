#include "content/make/video/Scene.h"

#include <toml++/toml.h>

#include <numbers>
#include <sstream>

namespace shoal::reef {

namespace {

// Exception of the reading functions below: the first required key that is missing or wrong.
struct Missing {
    std::string what;
};

const toml::node& must(const toml::table& table, std::string_view key) {
    const toml::node* node = table.get(key);
    if (!node) throw Missing{"wants \"" + std::string(key) + "\""};
    return *node;
}

float number(const toml::node& node) {
    const auto value = node.value<double>();
    if (!value) throw Missing{"wants a number where it has something else"};
    return static_cast<float>(*value);
}

float number(const toml::table& table, std::string_view key) { return number(must(table, key)); }

template <int kCount> glm::vec<kCount, float> vec(const toml::node& node) {
    const toml::array* list = node.as_array();
    if (!list || list->size() != kCount)
        throw Missing{"wants " + std::to_string(kCount) + " numbers in a list"};
    glm::vec<kCount, float> out;
    for (int i = 0; i < kCount; ++i) out[i] = number(*list->get(static_cast<size_t>(i)));
    return out;
}

const toml::array& list(const toml::table& table, std::string_view key) {
    const toml::array* out = must(table, key).as_array();
    if (!out) throw Missing{"wants a list \"" + std::string(key) + "\""};
    return *out;
}

const toml::table& part(const toml::table& table, std::string_view key) {
    const toml::table* out = must(table, key).as_table();
    if (!out) throw Missing{"wants a table \"" + std::string(key) + "\""};
    return *out;
}

vec3 refractedDown(const vec3& toSunAir) {
    const vec3 down = glm::refract(-toSunAir, vec3(0, 1, 0), 1 / kWaterIndex);
    return -glm::normalize(down);
}

Rock rock(const toml::table& table) {
    Rock out;
    out.voxel = number(table, "voxel");
    for (const toml::node& node : list(table, "blobs")) {
        const auto six = node.as_array();
        if (!six || six->size() != 6) throw Missing{"wants six numbers for a blob"};
        Blob blob;
        for (int i = 0; i < 3; ++i) {
            blob.centre[i] = number(*six->get(static_cast<size_t>(i)));
            blob.radius[i] = number(*six->get(static_cast<size_t>(i + 3)));
        }
        out.blobs.push_back(blob);
    }
    for (const toml::node& tube : list(table, "carve")) {
        auto& joints = out.carve.emplace_back();
        if (!tube.as_array()) throw Missing{"wants a list of joints for a tube"};
        for (const toml::node& joint : *tube.as_array()) joints.push_back(vec<4>(joint));
    }
    return out;
}

Growth growth(const toml::table& table) {
    return {.kind = must(table, "kind").value_or(std::string()),
            .count = static_cast<int>(number(table, "count")),
            .size = vec<2>(must(table, "size")),
            .light = vec<2>(must(table, "light")),
            .up = number(table, "up"),
            .clear = table["clear"].value_or(0.0f),
            .glow = table.contains("glow") ? vec<3>(must(table, "glow")) : vec3(0),
            .onSand = table["on"].value_or(std::string("rock")) == "sand"};
}

Lamp lamp(const toml::table& table) {
    constexpr float kRadians = std::numbers::pi_v<float> / 180;
    Lamp out;
    out.place = vec<3>(must(table, "place"));
    out.towards = glm::normalize(vec<3>(must(table, "towards")));
    out.cosInner = std::cos(number(table, "inner") * kRadians);
    out.cosOuter = std::cos(number(table, "outer") * kRadians);
    out.intensity = vec<3>(must(table, "intensity"));
    out.carried = table["carried"].value_or(false);
    return out;
}

// Merges `over` into `under`; its values take precedence.
void join(toml::table& under, const toml::table& over) {
    for (const auto& [key, node] : over) {
        toml::table* was = under[key].as_table();
        const toml::table* now = node.as_table();
        if (was && now)
            join(*was, *now);
        else
            under.insert_or_assign(key, node);
    }
}

toml::table withBase(const Path& file) {
    toml::table own = toml::parse_file(file.string());
    const auto base = own["base"].value<std::string>();
    if (!base) return own;
    toml::table joined = withBase(file.parent_path() / *base);
    join(joined, own);
    return joined;
}

// Hashes all but the film's and the camera's data, which do not change the light, and the base file's name.
uint64_t keyOf(toml::table root) {
    root.erase("base");
    root.erase("film");
    root.erase("camera");
    std::ostringstream text;
    text << root;
    return std::hash<std::string>()(text.str());
}

Scene fromTable(const toml::table& root) {
    constexpr float kRadians = std::numbers::pi_v<float> / 180;
    Scene scene;
    const toml::table& film = part(root, "film");
    scene.film = {static_cast<int>(number(film, "frames")), static_cast<int>(number(film, "fps")),
                  static_cast<int>(number(film, "width")),  static_cast<int>(number(film, "drawn")),
                  static_cast<int>(number(film, "start")),  static_cast<int>(number(film, "every"))};
    for (const toml::node& node : list(part(root, "path"), "places")) scene.path.push_back(vec<3>(node));
    const toml::table& water = part(root, "water");
    scene.water = {vec<3>(must(water, "attenuation")), vec<3>(must(water, "scattered")),
                   number(water, "forward"), number(water, "forward_share")};
    const toml::table& sun = part(root, "sun");
    const float high = number(sun, "elevation") * kRadians, round = number(sun, "azimuth") * kRadians;
    scene.sun.toSunAir = {std::cos(high) * std::sin(round), std::sin(high),
                          -std::cos(high) * std::cos(round)};
    scene.sun.toSunWater = refractedDown(scene.sun.toSunAir);
    scene.sun.irradiance = vec<3>(must(sun, "irradiance"));
    scene.sun.sky = vec<3>(must(sun, "sky"));
    scene.sun.horizon = sun.contains("horizon")
                            ? vec<3>(must(sun, "horizon"))
                            : vec3(1.35f * glm::dot(scene.sun.sky, vec3(0.2126f, 0.7152f, 0.0722f)));
    const toml::table& waves = part(root, "waves");
    scene.waves = {number(waves, "tile"), number(waves, "rms_slope"), number(waves, "longest"),
                   number(waves, "shortest"), number(waves, "wind") * kRadians};
    const toml::table& camera = part(root, "camera");
    scene.camera = {.exposure = number(camera, "exposure"),
                    .adaptation = number(camera, "adaptation"),
                    .noise = number(camera, "noise"),
                    .mean = camera["mean"].value<float>(),
                    .white = vec<3>(must(camera, "white")),
                    .snow = static_cast<int>(number(camera, "snow"))};
    const toml::table& sand = part(root, "sand");
    scene.sandHeight = number(sand, "height");
    scene.sandAlbedo = vec<3>(must(sand, "albedo"));
    for (const toml::node& node : list(root, "rock")) scene.rocks.push_back(rock(*node.as_table()));
    for (const toml::node& node : list(root, "growth")) scene.growths.push_back(growth(*node.as_table()));
    if (root.contains("lamp"))
        for (const toml::node& node : list(root, "lamp")) scene.lamps.push_back(lamp(*node.as_table()));
    if (root.contains("plankton")) {
        const toml::table& plankton = part(root, "plankton");
        scene.plankton = {static_cast<int>(number(plankton, "count")), vec<3>(must(plankton, "radiance"))};
    }
    scene.key = keyOf(root);
    return scene;
}

} // namespace

float Water::phase(float cosine) const {
    const float g = forward, denominator = 1 + g * g - 2 * g * cosine;
    const float lobe = (1 - g * g) / (denominator * std::sqrt(denominator));
    return (forwardShare * lobe + (1 - forwardShare)) * 0.25f * std::numbers::inv_pi_v<float>;
}

Result<Scene> readScene(const Path& file) {
    try {
        return fromTable(withBase(file));
    } catch (const toml::parse_error& error) {
        return Error{file.string(), std::string(error.description())};
    } catch (const Missing& missing) {
        return Error{file.string(), missing.what};
    }
}

} // namespace shoal::reef
