#include "game/ui/Pictures.h"

#include "engine/core/Log.h"

#include <stb_image.h>

#include <algorithm>
#include <memory>

namespace shoal::app {

Result<ImageRgba8> readSmallPicture(const Path& file) {
    const auto bytes = readFile(file, 1u << 20);
    if (!bytes) return bytes.error();
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes->data(), static_cast<int>(bytes->size()), &width, &height, &channels, 4),
        stbi_image_free);
    if (!pixels) return Error{file, "is not a picture that can be read"};
    ImageRgba8 image(width, height);
    std::copy_n(pixels.get(), image.pixels.size(), image.pixels.begin());
    return image;
}

void Pictures::Picture::show(const ImageRgba8& image) {
    if (!texture) texture = gl::makeTexture(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, texture.name());
    size = {image.width, image.height};
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 image.pixels.data());
}

const Pictures::Picture& Pictures::get(const std::string& file) {
    const auto [entry, isNew] = read_.try_emplace(file);
    Picture& picture = entry->second;
    if (!isNew) return picture;
    const auto image = readSmallPicture(dataRoot() / "content" / file);
    if (!image) {
        log::warn("{}", image.error().message());
        return picture;
    }
    picture.show(*image);
    return picture;
}

} // namespace shoal::app
