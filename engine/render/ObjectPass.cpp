#include "engine/render/ObjectPass.h"

#include "engine/light/Lookup.h"
#include "engine/math/Brdf.h"
#include "engine/math/SphericalHarmonics.h"
#include "shaders/render/Attributes.glsl"

#include <algorithm>
#include <cstring>
#include <optional>

namespace shoal::render {

namespace {

// Shader features that a primitive may need, named as in the shader; each set is compiled when it is first
// needed. Those from SHOW_NORMALS on are in the order of ShownQuantity.
#define SHOAL_FEATURES(F)                                                                                    \
    F(SKINNED), F(BASE_COLOUR_MAP), F(METALLIC_ROUGHNESS_MAP), F(NORMAL_MAP), F(OCCLUSION_MAP),              \
        F(EMISSIVE_MAP), F(ALPHA_MASK), F(ALPHA_BLEND), F(PHONG_RINGS), F(MIRRORS), F(WATER),                \
        F(SCALED_LIGHT), F(LEAN), F(VERTEX_DIFFUSE), F(VERTEX_LIT), F(OCCLUDED), F(VERTEX_COLOURS),          \
        F(SECOND_UV), F(LAYERS), F(LAYERS_THESIS), F(UNLIT), F(DIELECTRIC), F(CLEARCOAT), F(FILM_DEPTH),     \
        F(SHOW_NORMALS), F(SHOW_ROUGHNESS), F(SHOW_OCCLUSION), F(SHOW_DIFFUSE), F(SHOW_DEPTH)
#define SHOAL_BIT(name) name##_BIT
enum FeatureIndex { LAST_TONE_BIT = kToneFeatures - 1, SHOAL_FEATURES(SHOAL_BIT) };
#define SHOAL_FEATURE(name) name = 1u << name##_BIT
enum Feature : unsigned { SHOAL_FEATURES(SHOAL_FEATURE) };
#define SHOAL_NAME(name) #name
constexpr std::array kObjectDefines = {SHOAL_TONE_DEFINES, SHOAL_FEATURES(SHOAL_NAME)};

// A map of a material. Programs with the feature sample it; a white texture replaces a map that the material
// lacks.
struct MaterialMap {
    unsigned feature;
    scene::TextureUse scene::Material::*use;
    GLuint unit;
    const char *sampler, *uvSet;
    bool isColour =
        false; // whether the sampler decodes sRGB; the base colour's only if reflectances are linear
};
using scene::Material;
constexpr std::array kMaps = std::to_array<MaterialMap>({
    {BASE_COLOUR_MAP, &Material::baseColour, UNIT_BASE_COLOUR, "baseColourMap", "baseColourUv", true},
    {METALLIC_ROUGHNESS_MAP, &Material::metallicRoughness, UNIT_METALLIC_ROUGHNESS, "metallicRoughnessMap",
     "metallicRoughnessUv"},
    {NORMAL_MAP, &Material::normal, UNIT_NORMAL, "normalMap", "normalUv"},
    {OCCLUSION_MAP, &Material::occlusion, UNIT_OCCLUSION, "occlusionMap", "occlusionUv"},
    {EMISSIVE_MAP, &Material::emissive, UNIT_EMISSIVE, "emissiveMap", "emissiveUv", true},
    {DIELECTRIC, &Material::specular, UNIT_SPECULAR, "specularMap", "specularUv"},
    {DIELECTRIC, &Material::specularColour, UNIT_SPECULAR_COLOUR, "specularColourMap", "specularColourUv",
     true},
    {CLEARCOAT, &Material::coat, UNIT_COAT, "coatMap", "coatUv"},
    {CLEARCOAT, &Material::coatRoughness, UNIT_COAT_ROUGHNESS, "coatRoughnessMap", "coatRoughnessUv"},
});

unsigned featuresOf(const scene::Material& material, const PrimitiveGpu& primitive) {
    unsigned features = 0;
    if (primitive.skinned) features |= SKINNED;
    if (primitive.coloured) features |= VERTEX_COLOURS;
    for (const MaterialMap& map : kMaps) {
        const scene::TextureUse& use = material.*map.use;
        if (use.texture < 0) continue;
        features |= map.feature;
        if (use.texCoord == 1) features |= SECOND_UV;
    }
    if (material.dielectricF0 != glm::vec3(0.04f) || material.dielectricF90 != 1) features |= DIELECTRIC;
    features = material.clearcoat > 0 ? features | CLEARCOAT : features & ~CLEARCOAT;
    if (material.alphaMode == scene::AlphaMode::Mask) features |= ALPHA_MASK;
    if (material.alphaMode == scene::AlphaMode::Blend) features |= ALPHA_BLEND;
    return features;
}

// Returns the greatest size in world metres that cannot be seen at this distance.
float toleranceAt(float distance_m, const View& view, Detail detail) {
    if (view.heightPixels <= 0) return 0;
    const float unseen_px = detail == Detail::Lean ? 1.6f : 0.5f;
    constexpr float kNearest_m = 0.2f; // distance at which an eye within a sphere sees, say, its own arm
    return std::max(distance_m, std::max(view.near_m, kNearest_m)) * 2 * view.halfExtent().y /
           static_cast<float>(view.heightPixels) * unseen_px;
}

// Returns whether relief may be left out and light be computed by the vertex. Over a whole picture of a dive,
// hands included, that differs by 0.1 % root mean square; only objects so near that they fill the picture
// show their relief. slope: radius by distance.
bool isSmall(float slope, const View& view) {
    constexpr float kSmall = 0.42f; // radius, of the picture's height
    return view.heightPixels > 0 && slope < kSmall * 2 * view.halfExtent().y;
}

gl::Texture makeDfgTable() {
    constexpr int kSize = 64;
    const std::vector<float> scaleBias = math::makeDfgTable(kSize);
    gl::Texture texture = gl::makeTexture(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RG16F, kSize, kSize, 0, GL_RG, GL_FLOAT, scaleBias.data());
    return texture;
}

// Returns a matte surface's light from the harmonics of radiance: multiplies each by its basis function's
// factor and by the cosine lobe's factor for its band, over pi (Ramamoorthi and Hanrahan 2001).
depth::LightHarmonics matteFactors(const depth::LightHarmonics& radiance) {
    depth::LightHarmonics matte;
    for (size_t i = 0; i < matte.size(); ++i) {
        const size_t band = i == 0 ? 0 : i < 4 ? 1 : 2;
        matte[i] = static_cast<float>(math::kShFactors[i] * math::kShCosine[band] / math::kShCosine[0]) *
                   radiance[i];
    }
    return matte;
}

gl::Texture makeWhite() {
    gl::Texture texture = gl::makeTexture(GL_NEAREST, GL_NEAREST, GL_REPEAT, GL_REPEAT);
    constexpr std::array<uint8_t, 4> kWhite{255, 255, 255, 255};
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, kWhite.data());
    return texture;
}

// Returns whether a material has maps that only the fragment shader reads.
bool hasLayerMaps(const scene::Material& material) {
    return material.specular.texture >= 0 || material.specularColour.texture >= 0 ||
           material.coat.texture >= 0 || material.coatRoughness.texture >= 0;
}

void setSmoothLight(const gl::Program& program, const occlusion::SmoothLight& light) {
    program.setArray("radianceAhead[0]", light.ahead);
    program.setArray("radianceBehind[0]", light.behind);
    program.setArray("evenLight[0]", light.even);
    program.set("dominantTowards", occlusion::dominantDirections(light));
    program.set("dominantRadiance", light.dominantRadiance);
    program.set("dominantShare", light.dominantShare);
}

} // namespace

Result<ObjectPass> ObjectPass::make(Detail detail, bool occlusion, ShownQuantity shown) {
    ObjectPass pass;
    pass.detail_ = detail;
    pass.occlusion_ = occlusion;
    pass.shown_ = shown;
    pass.dfg_ = makeDfgTable();
    pass.white_ = makeWhite();
    pass.matrixBuffer_ = gl::Buffer::make();
    GLint alignment = 256;
    glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
    pass.matrixAlignment_ = static_cast<size_t>(std::max(alignment, 16));
    // Compiled now, so that a broken shader is reported at the start and not when the first object appears.
    pass.programs_ = gl::Variants("render/Object", kObjectDefines);
    if (auto program = pass.programFor(0); !program) return program.error();
    return pass;
}

void ObjectPass::begin() {
    objects_.clear();
    parts_.clear();
    items_.clear();
    matrices_.clear();
    near_.clear();
    inRoom_.clear();
    drawCount_ = triangleCount_ = 0;
    uploaded_ = 0;
}

void ObjectPass::add(const Object& object) {
    const std::span<const Sphere> parts = object.parts.empty() ? std::span(&object.bound, 1) : object.parts;
    objects_.push_back({.bound = object.bound,
                        .firstPart = parts_.size(),
                        .partCount = parts.size(),
                        .matteDifference = object.lightDifference ? matteFactors(*object.lightDifference)
                                                                  : depth::LightHarmonics{},
                        .body = -1,
                        .albedo = object.body ? object.body->albedo : glm::vec3(0),
                        .opacity = object.opacity,
                        .highlight = object.highlight,
                        .isInRoom = object.isInRoom});
    parts_.insert(parts_.end(), parts.begin(), parts.end());
    if (object.body) {
        const size_t added = near_.add(*object.body, object.pose, object.worldFromModel, object.bound);
        inRoom_.push_back(object.isInRoom);
        if (occlusion_) objects_.back().body = static_cast<int>(added);
    }
    const scene::Model& model = object.model;
    const glm::mat4& worldFromModel = object.worldFromModel;
    for (const int index : model.order) {
        const scene::Node& node = model.nodes[index];
        if (node.mesh < 0) continue;
        const MeshGpu& mesh = object.gpu.meshes[node.mesh];
        const bool skinned = node.skin >= 0;
        if (skinned)
            scene::skinMatrices(model, node.skin, object.pose, joints_);
        else
            joints_.assign(1, object.pose.modelFromNode[index]);
        for (glm::mat4& joint : joints_) joint = worldFromModel * joint;
        const size_t bytes = std::min<size_t>(joints_.size(), MAX_JOINTS) * sizeof(glm::mat4);
        const size_t offset = append(joints_.data(), bytes);
        const float scale = glm::length(glm::vec3((skinned ? worldFromModel : joints_[0])[0]));
        const bool mirrored = glm::determinant(glm::mat3(joints_[0])) < 0;
        for (const PrimitiveGpu& primitive : mesh)
            items_.push_back({.gpu = &object.gpu,
                              .primitive = &primitive,
                              .object = objects_.size() - 1,
                              .matrixOffset = offset,
                              .scale = scale,
                              .mirrored = mirrored});
    }
}

size_t ObjectPass::append(const void* block, size_t bytes) {
    const size_t offset = (matrices_.size() + matrixAlignment_ - 1) / matrixAlignment_ * matrixAlignment_;
    matrices_.resize(offset + bytes);
    std::memcpy(matrices_.data() + offset, block, bytes);
    return offset;
}

// Finds what occludes each object in view. A second eye sees few objects that the first did not.
void ObjectPass::shadeVisible(const glm::mat3& envFromWorld) {
    for (Placed& object : objects_) {
        if (object.body < 0 || object.shade.isKnown || !object.seen.any) continue;
        const auto [occluders, own, ownStrength] = near_.near(static_cast<size_t>(object.body), envFromWorld);
        object.shade = {occluders.empty() ? 0 : append(occluders.data(), occluders.size_bytes()),
                        static_cast<int>(occluders.size()), static_cast<int>(own), ownStrength, true};
    }
    if (uploaded_ == matrices_.size()) return;
    // The shader's blocks have room for MAX_JOINTS; the bound range must cover them for the last object too.
    static_assert(MAX_JOINTS * sizeof(glm::mat4) >= MAX_OCCLUDERS * sizeof(PackedOccluder));
    matrices_.resize(matrices_.size() + MAX_JOINTS * sizeof(glm::mat4));
    uploaded_ = matrices_.size();
    glBindBuffer(GL_UNIFORM_BUFFER, matrixBuffer_.name());
    glBufferData(GL_UNIFORM_BUFFER, static_cast<GLsizeiptr>(matrices_.size()), matrices_.data(),
                 GL_STREAM_DRAW);
}

Result<const gl::Program*> ObjectPass::programFor(unsigned features) {
    auto program = programs_.get(features, features & LAYERS ? occlusion::kStorageGlsl : 330);
    if (!program) return program;
    (*program)->bindBlock("JointBlock", BLOCK_JOINTS);
    (*program)->bindBlock("OccluderBlock", BLOCK_OCCLUDERS);
    return program;
}

std::span<const Sphere> ObjectPass::partsOf(const Placed& object) const {
    return std::span(parts_).subspan(object.firstPart, object.partCount);
}

// Tests the parts: the sphere around an arm holds the eye, and reaches into views that the arm does not.
ObjectPass::Seen ObjectPass::seenIn(const Placed& object, const EyePicture& picture) const {
    const View& view = picture.view;
    Seen seen;
    if (!sees(view, object.bound)) return seen;
    const float middle = glm::distance(object.bound.centre, view.eyeWorld);
    const bool holdsEye = middle < object.bound.radius;
    if (!holdsEye) seen.slope = object.bound.radius / std::max(middle, view.near_m);
    for (const Sphere& part : partsOf(object)) {
        if (!sees(view, part)) continue;
        const float distance = glm::distance(part.centre, view.eyeWorld);
        seen.any = true;
        seen.nearest_m = std::min(seen.nearest_m, distance - part.radius);
        if (holdsEye) seen.slope = std::max(seen.slope, part.radius / std::max(distance, view.near_m));
    }
    if (seen.any && picture.surroundings != Surroundings::Room) seen.behind = behindFilm(object, picture);
    return seen;
}

// Compares an object's distances with the film's range within the caps that its parts cover, widened by the
// angle that an eye beside the film's camera may see past their edges.
ObjectPass::BehindFilm ObjectPass::behindFilm(const Placed& object, const EyePicture& picture) const {
    const depth::DepthRange* range = picture.environment.depth().range;
    if (!range) return BehindFilm::Nothing;
    const float beside = glm::length(picture.eyeInFilm);
    const auto behind = [&](const Sphere& part) {
        const glm::vec3 away = part.centre - picture.view.eyeWorld;
        const float distance = glm::length(away), radius = part.radius;
        // Distances from the film's camera and from the eye differ by at most the distance between these.
        if (distance + radius + beside <= depth::kNearest_m) return BehindFilm::Nothing;
        if (distance <= radius) return BehindFilm::Perhaps;
        const float halfAngle = std::asin(radius / distance) + beside / depth::kNearest_m;
        const auto film = range->around(picture.envFromWorld * (away / distance), halfAngle);
        if (film.max_perM * (distance + radius + beside) <= 1) return BehindFilm::Nothing;
        return film.min_perM * (distance - radius - beside) > 1 ? BehindFilm::All : BehindFilm::Perhaps;
    };
    if (const BehindFilm whole = behind(object.bound); whole != BehindFilm::Perhaps) return whole;
    const std::span<const Sphere> parts = partsOf(object);
    const BehindFilm first = behind(parts[0]);
    return std::ranges::all_of(parts, [&](const Sphere& part) { return behind(part) == first; })
               ? first
               : BehindFilm::Perhaps;
}

void ObjectPass::addVisible(const View& view, std::vector<Sphere>& out) const {
    for (const Placed& object : objects_)
        if (sees(view, object.bound))
            for (const Sphere& part : partsOf(object))
                if (sees(view, part)) out.push_back(part);
}

// Replaces order_ by the items that are in the view and not behind the film.
void ObjectPass::sortVisible(const EyePicture& picture, unsigned shared, Glossy glossy) {
    const bool inRoom = picture.surroundings == Surroundings::Room;
    order_.clear();
    for (size_t i = 0; i < items_.size(); ++i) {
        const Item& item = items_[i];
        const Placed& object = objects_[item.object];
        if (!object.seen.any || object.seen.behind == BehindFilm::All) continue;
        const bool blended = item.gpu->materialOf(*item.primitive).alphaMode == scene::AlphaMode::Blend;
        const Stage stage = inRoom && object.isInRoom ? Stage::DepthAlone
                            : blended                 ? Stage::Blended
                                                      : Stage::Opaque;
        const float distance = glm::distance(object.bound.centre, picture.view.eyeWorld);
        const bool fades = object.opacity < 1 && stage == Stage::Opaque;
        ToDraw next{stage, 0, distance, i, featuresFor(item, shared, picture, glossy)};
        if (fades) order_.push_back({Stage::FadedDepth, 0, distance, i, next.features});
        if (fades) next.stage = Stage::Blended;
        if (next.stage == Stage::Blended)
            next.order = -distance;
        else if (detail_ == Detail::Lean)
            next.program = next.features, next.order = 0;
        order_.push_back(next);
    }
    std::sort(order_.begin(), order_.end());
}

// Returns the shader's features for one item; shared: those that all items of a picture have.
unsigned ObjectPass::featuresFor(const Item& item, unsigned shared, const EyePicture& picture,
                                 Glossy glossy) const {
    const Placed& object = objects_[item.object];
    const scene::Material& material = item.gpu->materialOf(*item.primitive);
    unsigned features = shared | featuresOf(material, *item.primitive);
    const bool lean = detail_ == Detail::Lean;
    const float smoothest = lean ? item.primitive->gloss.meanRoughness : item.primitive->gloss.minRoughness;
    if (glossy == Glossy::Prefiltered && smoothest < 0.99f * picture.environment.smoothestFiltered())
        features |= MIRRORS;
    if (lean) features &= ~METALLIC_ROUGHNESS_MAP;
    if (shown_ != ShownQuantity::Light) // needs what only the fragment shader knows
        features |= SHOW_NORMALS << (static_cast<unsigned>(shown_) - 1);
    else if (lean && isSmall(object.seen.slope, picture.view) && !hasLayerMaps(material))
        features = (features & ~(NORMAL_MAP | OCCLUSION_MAP | MIRRORS)) | VERTEX_LIT;
    else if (lean && !material.doubleSided)
        features |= VERTEX_DIFFUSE;
    const bool unlit = material.unlit && shown_ == ShownQuantity::Light;
    if (unlit) features = (features & ~(VERTEX_DIFFUSE | MIRRORS | PHONG_RINGS)) | VERTEX_LIT | UNLIT;
    if (occlusion_ && !layers_ && !material.unlit &&
        (item.primitive->withSelfOcclusion || object.shade.count > 0))
        features |= OCCLUDED;
    if (object.seen.behind == BehindFilm::Perhaps) features |= FILM_DEPTH; // nearer parts of it hide a part
    if (object.opacity < 1) features |= ALPHA_BLEND;
    if (layers_ && !unlit)
        features = (features & ~OCCLUSION_MAP) | LAYERS |
                   (layers_->method() == occlusion::LayerMethod::Thesis ? LAYERS_THESIS : 0u);
    return features;
}

// Sets the uniforms that all items drawn with the program in this picture share.
void ObjectPass::use(const gl::Program& program, unsigned features, const EyePicture& picture,
                     const water::Water& water) const {
    program.use();
    picture.bind(program, water, (features & FILM_DEPTH) != 0);
    program.setTexture("dfgTable", UNIT_DFG, dfg_.name());
    if (features & OCCLUDED) setSmoothLight(program, picture.environment.smoothLight());
    if (features & LAYERS) layers_->bind(program);
}

Status ObjectPass::draw(const EyePicture& picture, const water::Water& water, Glossy glossy) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA); // premultiplied
    const unsigned shared = toneFeatures(picture.exposure) |
                            (glossy == Glossy::PhongRings ? PHONG_RINGS : 0u) | (water.none() ? 0u : WATER) |
                            (detail_ == Detail::Lean ? LEAN : 0u) |
                            (picture.environment.lightIsScaled() ? SCALED_LIGHT : 0u);
    for (Placed& object : objects_) object.seen = seenIn(object, picture);
    shadeVisible(picture.envFromWorld);
    sortVisible(picture, shared, glossy);
    const gl::Program* current = nullptr;
    const Item* last = nullptr;
    // An object that swims behind a part of the film, or out from it, needs another program. These are
    // compiled in advance, one per picture: a graphics driver takes a quarter to half a second for one, in
    // which the game would stand still. Lean ones, for software renderers, take 20 ms.
    const bool filmHides = picture.environment.depth().map && picture.surroundings != Surroundings::Room;
    std::optional<unsigned> soon;
    for (const ToDraw& next : order_) {
        const unsigned features = next.features;
        if (const unsigned other = features ^ FILM_DEPTH;
            filmHides && detail_ == Detail::Full && !programs_.has(other))
            soon = other;
        auto program = programFor(features);
        if (!program) return program.error();
        const Item& item = items_[next.item];
        if (*program != current) use(**program, features, picture, water);
        if (*program != current || !last || last->primitive != item.primitive ||
            objects_[last->object].opacity != objects_[item.object].opacity)
            setMaterial(**program, item, features);
        current = *program;
        last = &item;
        const bool blended = next.stage == Stage::Blended;
        gl::setEnabled(GL_BLEND, blended || (features & FILM_DEPTH));
        glDepthMask(!blended);
        glDepthFunc(blended ? GL_LEQUAL : GL_LESS);
        const GLboolean coloured = next.stage != Stage::DepthAlone && next.stage != Stage::FadedDepth;
        glColorMask(coloured, coloured, coloured, coloured);
        drawItem(*current, item, features, picture);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        ++drawCount_;
    }
    glFrontFace(GL_CCW);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);
    glBindVertexArray(0);
    if (soon)
        if (const auto compiled = programFor(*soon); !compiled) return compiled.error();
    return Done{};
}

void ObjectPass::setMaterial(const gl::Program& program, const Item& item, unsigned features) const {
    const scene::Material& material = item.gpu->materialOf(*item.primitive);
    if (features & PHONG_RINGS) {
        const auto rings = light::phongRings(material.roughness);
        std::array<glm::vec2, 6> packed;
        for (size_t r = 0; r < packed.size(); ++r)
            packed[r] = {static_cast<float>(rings[r].angle), static_cast<float>(rings[r].weight)};
        program.setArray("phongRings_angleWeight[0]", packed);
    }
    program.set("baseColourLin", material.baseColourLin * glm::vec4(1, 1, 1, objects_[item.object].opacity));
    program.set("emissiveLin", material.emissiveLin);
    const bool lean = detail_ == Detail::Lean;
    program.set("metallic", lean ? item.primitive->gloss.meanMetallic : material.metallic);
    program.set("roughness", lean ? item.primitive->gloss.meanRoughness : material.roughness);
    program.set("dielectricF0", material.dielectricF0);
    program.set("dielectricF90", material.dielectricF90);
    program.set("clearcoat", material.clearcoat);
    program.set("clearcoatRoughness", material.clearcoatRoughness);
    program.set("twoSided", material.doubleSided ? 1.0f : 0.0f);
    program.set("normalScale", material.normalScale);
    program.set("occlusionStrength", material.occlusionStrength);
    program.set("alphaCutoff", material.alphaCutoff);
    const bool linear = reflectanceFor(material, item.gpu->reflectance) == Reflectance::Linear;
    for (const MaterialMap& map : kMaps) {
        if (!(features & map.feature)) continue;
        const auto& [texture, texCoord] = material.*map.use;
        const bool decoded = map.isColour && (linear || map.feature != BASE_COLOUR_MAP);
        const auto& textures = decoded ? item.gpu->textures->colour : item.gpu->textures->data;
        program.setTexture(map.sampler, map.unit,
                           (texture < 0 ? white_ : textures[static_cast<size_t>(texture)]).name());
        program.set(map.uvSet, texCoord);
    }
    gl::setEnabled(GL_CULL_FACE, !material.doubleSided);
}

void ObjectPass::drawItem(const gl::Program& program, const Item& item, unsigned features,
                          const EyePicture& picture) {
    static constexpr depth::LightHarmonics kNone{};
    const Placed& object = objects_[item.object];
    const bool inRoom = picture.surroundings == Surroundings::Room;
    if (features & LAYERS) program.set("bodyAlbedo", object.albedo);
    program.setArray("lightDifference[0]", inRoom ? kNone : object.matteDifference);
    program.set("highlight", object.highlight);
    glFrontFace(item.mirrored ? GL_CW : GL_CCW);
    glBindBufferRange(GL_UNIFORM_BUFFER, BLOCK_JOINTS, matrixBuffer_.name(),
                      static_cast<GLintptr>(item.matrixOffset), MAX_JOINTS * sizeof(glm::mat4));
    if (features & OCCLUDED) {
        const Shade& shade = object.shade;
        program.set("selfOcclusionAlbedo", object.albedo);
        program.set("occluderCount", shade.count);
        program.set("ownCount", shade.own);
        program.set("ownStrength", shade.ownStrength);
        glBindBufferRange(GL_UNIFORM_BUFFER, BLOCK_OCCLUDERS, matrixBuffer_.name(),
                          static_cast<GLintptr>(shade.offset), MAX_OCCLUDERS * sizeof(PackedOccluder));
    }
    const DetailGpu& detail =
        item.primitive->detail(toleranceAt(object.seen.nearest_m, picture.view, detail_) / item.scale);
    glBindVertexArray(detail.vertexArray.name());
    triangleCount_ += detail.indexCount / 3;
    glDrawElements(GL_TRIANGLES, detail.indexCount, GL_UNSIGNED_INT, nullptr);
}

} // namespace shoal::render
