// A glTF model in OGRE, lit by a 360-degree video: the picture that `shoal view --light thesis` draws.
#include <Ogre.h>
#include <ShoalLight.h>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <tiny_gltf.h>

using namespace Ogre;

static cv::Mat frameAt(const std::string& video, double time_s) {
    cv::VideoCapture capture(video);
    cv::Mat frame;
    capture.set(cv::CAP_PROP_POS_FRAMES, std::floor(time_s * capture.get(cv::CAP_PROP_FPS) + 1e-6));
    if (!capture.read(frame)) throw std::runtime_error(video + ": has no such frame");
    // OpenCV 4.6 decodes all video by BT.601's matrix; high definition wants BT.709's.
    const cv::Matx33f bt709(1066, -28, -14, 60, 865, 99, -14, -74, 1112);
    if (frame.cols >= 1280) cv::transform(frame, frame, bt709 * (1 / 1024.0f));
    return frame;
}

static TexturePtr load(const std::string& name, int width, int height, PixelFormat format, const void* data) {
    Image image;
    image.loadDynamicImage((uchar*)data, width, height, format);
    return TextureManager::getSingleton().loadImage(name, "General", image);
}

// All that changes with a video: one texture and a few numbers.
static void lightBy(const ShoalLightMaps& maps) {
    const auto [rgba, width, height] = maps.lightMap;
    const PixelBox pixels(width, height, 1, PF_FLOAT16_RGBA, (void*)rgba);
    TextureManager::getSingleton().getByName("light")->getBuffer()->blitFromMemory(pixels);
    const auto numbers = GpuProgramManager::getSingleton().getSharedParameters("LightNumbers");
    numbers->setNamedConstant("lightPlaces", maps.lightPlaces, 4 * maps.mapCount);
    numbers->setNamedConstant("smoothestMap", float(maps.mapCount - 1));
}

// The first mesh of a .glb that has tangents and all three maps.
static ManualObject* loadModel(const std::string& file, SceneManager& scene) {
    tinygltf::Model model;
    std::string error, warning;
    if (!tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, file))
        throw std::runtime_error(file + ": " + error);
    const auto bytesOf = [&](int index) {
        const tinygltf::Accessor& accessor = model.accessors.at(index);
        const tinygltf::BufferView& view = model.bufferViews.at(accessor.bufferView);
        return model.buffers.at(view.buffer).data.data() + view.byteOffset + accessor.byteOffset;
    };
    const auto put = [&](const auto& use, TextureUnitState* unit) {
        const tinygltf::Texture& texture = model.textures.at(use.index);
        const tinygltf::Image& map = model.images.at(texture.source);
        const std::string name = std::to_string(use.index);
        unit->setTexture(load(name, map.width, map.height, PF_BYTE_RGBA, map.image.data()));
        const int wrap = texture.sampler < 0 ? 0 : model.samplers[texture.sampler].wrapS;
        if (wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) unit->setTextureAddressingMode(TAM_CLAMP);
    };
    ManualObject* object = scene.createManualObject();
    for (tinygltf::Primitive& primitive : model.meshes.at(0).primitives) {
        const tinygltf::Material& from = model.materials.at(primitive.material);
        const MaterialPtr material = MaterialManager::getSingleton().getByName("Lit")->clone(from.name);
        Pass* pass = material->getTechnique(0)->getPass(0);
        put(from.pbrMetallicRoughness.baseColorTexture, pass->getTextureUnitState(2));
        put(from.pbrMetallicRoughness.metallicRoughnessTexture, pass->getTextureUnitState(3));
        put(from.normalTexture, pass->getTextureUnitState(4));
        const auto at = [&](const char* name, size_t index) {
            return (const float*)bytesOf(primitive.attributes.at(name)) + index;
        };
        object->begin(material);
        for (size_t v = 0; v < model.accessors.at(primitive.attributes.at("POSITION")).count; ++v) {
            object->position(Vector3(at("POSITION", 3 * v)));
            object->normal(Vector3(at("NORMAL", 3 * v)));
            object->textureCoord(Vector2(at("TEXCOORD_0", 2 * v)));
            object->textureCoord(Vector4(at("TANGENT", 4 * v)));
        }
        const auto* indices = (const uint16_t*)bytesOf(primitive.indices);
        for (size_t i = 0; i < model.accessors.at(primitive.indices).count; ++i) object->index(indices[i]);
        object->end();
    }
    return object;
}

int main(int count, char** words) try {
    if (count != 8) throw std::runtime_error("ogre_light MODEL.glb VIDEO SECONDS THETA PHI RADIUS OUT.png");
    LogManager log;
    log.createLog("", true, false, true); // silent
    Root root("", "", "");
    root.loadPlugin(OGRE_PLUGINS "/RenderSystem_GL3Plus");
    root.loadPlugin(OGRE_PLUGINS "/Codec_STBI"); // PNG
    root.setRenderSystem(root.getAvailableRenderers().at(0));
    root.initialise(false);
    root.createRenderWindow("", 16, 16, false); // OGRE wants one before any texture
    const cv::Mat frame = frameAt(words[2], std::atof(words[3]));
    const ShoalLightOptions options{SHOAL_LIGHT_STILL, 0.1f, 2048}; // SHOAL_LIGHT_VIDEO while a video plays
    const ShoalLightFrame pixels{frame.data, frame.cols, frame.rows, 0, SHOAL_LIGHT_BGR8};
    ShoalLightMaker* maker = nullptr;
    ShoalLight* light = nullptr;
    std::vector<float> table(2 * 64 * 64);
    if (shoalLightMakerCreate(&options, &maker) || shoalLightCreate(&light) ||
        shoalLightMake(maker, &pixels, light) || shoalLightSurfaceTable(64, table.data()))
        throw std::runtime_error(shoalLightError());
    ShoalLightMaps maps;
    shoalLightMaps(light, &maps);
    load("light", maps.lightMap.width, maps.lightMap.height, PF_FLOAT16_RGBA, maps.lightMap.rgba);
    load("dfg", 64, 64, PF_FLOAT32_GR, table.data());
    load("frame", frame.cols, frame.rows, PF_BYTE_BGR, frame.data);
    auto& resources = ResourceGroupManager::getSingleton();
    resources.addResourceLocation(LIGHT_SHADERS, "FileSystem", "General", true);
    resources.addResourceLocation(EXAMPLE_FOLDER, "FileSystem", "General");
    resources.initialiseAllResourceGroups(); // Example.material names those textures
    lightBy(maps);
    SceneManager* scene = root.createSceneManager();
    SceneNode* world = scene->getRootSceneNode();
    ManualObject* model = loadModel(words[1], *scene);
    world->attachObject(model);
    SceneNode* eye = world->createChildSceneNode(model->getBoundingBox().getCenter());
    eye->yaw(Degree(std::atof(words[4])));
    eye->pitch(Degree(std::atof(words[5]) - 90));
    eye->translate(0, 0, std::atof(words[6]), Node::TS_LOCAL);
    Camera* camera = scene->createCamera("");
    camera->setFOVy(Degree(45));
    camera->setAspectRatio(1);
    camera->setNearClipDistance(0.01f);
    eye->attachObject(camera);
    Entity* sky = scene->createEntity(SceneManager::PT_CUBE); // 100 m around the eye
    sky->setMaterialName("Sky");
    world->createChildSceneNode(eye->getPosition())->attachObject(sky);
    const TexturePtr target = TextureManager::getSingleton().createManual(
        "target", "General", TEX_TYPE_2D, 768, 768, 0, PF_BYTE_RGB, TU_RENDERTARGET, nullptr, false, 4);
    RenderTexture* picture = target->getBuffer()->getRenderTarget();
    picture->addViewport(camera);
    picture->update();
    picture->writeContentsToFile(words[7]);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
