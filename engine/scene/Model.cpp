#include "engine/scene/Model.h"

#include <algorithm>

namespace shoal::scene {

namespace {

template <class List> int findNamed(const List& list, const std::string& name) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const auto& each) { return each.name == name; });
    return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

} // namespace

int Model::findAnimation(const std::string& name) const { return findNamed(animations, name); }
int Model::findNode(const std::string& name) const { return findNamed(nodes, name); }

const Material& Model::materialOf(const Primitive& primitive) const {
    static const Material kDefault;
    return primitive.material < 0 ? kDefault : materials[static_cast<size_t>(primitive.material)];
}

const ImageRgba8* Model::imageOf(const TextureUse& use) const {
    const int image = use.texture < 0 ? -1 : textures[static_cast<size_t>(use.texture)].image;
    return image < 0 ? nullptr : &images[static_cast<size_t>(image)];
}

} // namespace shoal::scene
