#include "engine/media/Codecs.h"

#include "engine/core/Files.h"
#include "engine/media/Ffmpeg.h"

#include <dlfcn.h>

namespace shoal::media {

static Result<const Codecs*> load() {
    setUpDecoders();
    const Path built = SHOAL_CODECS;
    Path file = built;
    std::error_code code;
    for (const char* folder : {".", SHOAL_LIBRARY_FROM_PROGRAM}) {
        const Path there = (programFolder() / folder / built.filename()).lexically_normal();
        if (file == built && std::filesystem::exists(there, code)) file = there;
    }
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    const void* found = library ? dlsym(library, kCodecsName) : nullptr;
    if (!found) {
        const char* why = dlerror();
        return Error{"", std::string("pictures and cameras need a library of this program: ") +
                             (why ? why : "it is empty")};
    }
    return static_cast<const Codecs*>(found);
}

Result<const Codecs*> codecs() {
    static const Result<const Codecs*> loaded = load();
    return loaded;
}

} // namespace shoal::media
