#include "engine/media/Codecs.h"

#include "engine/media/Ffmpeg.h"

#include <dlfcn.h>

#include <filesystem>

namespace shoal::media {

static Result<const Codecs*> load() {
    setUpDecoders();
    const std::filesystem::path built = SHOAL_CODECS;
    std::error_code code;
    const auto beside =
        std::filesystem::read_symlink("/proc/self/exe", code).replace_filename(built.filename());
    const auto& file = std::filesystem::exists(beside, code) ? beside : built;
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
