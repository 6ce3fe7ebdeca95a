// Pictures of menu pages as textures: animals of the field guide, dives.
#pragma once

#include "engine/core/Files.h"
#include "engine/core/Image.h"
#include "engine/core/Result.h"
#include "engine/gl/Objects.h"

#include <glm/vec2.hpp>

#include <map>
#include <string>

namespace shoal::app {

// Reads one of the program's own PNG (alpha not premultiplied) or JPEG files by stb_image. readPicture()
// would load OpenCV's codecs (engine/media/Codecs.h), and it drops alpha.
Result<ImageRgba8> readSmallPicture(const Path& file);

class Pictures {
  public:
    struct Picture {
        gl::Texture texture; // empty: there is no such picture
        glm::vec2 size{0};   // pixels

        void show(const ImageRgba8& image); // replaces the texture's image
    };
    // Returns a picture, read when it is first asked for. file: below content/. Needs the OpenGL context.
    const Picture& get(const std::string& file);

  private:
    std::map<std::string, Picture> read_;
};

} // namespace shoal::app
