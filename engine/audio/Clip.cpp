#include "engine/audio/Audio.h"

#include <memory>
#include <sndfile.h>

namespace shoal::audio {

Result<Clip> readClip(const Path& file) {
    SF_INFO info{};
    std::error_code code;
    if (!std::filesystem::is_regular_file(file, code)) return Error{file.string(), "there is no such sound"};
    const std::unique_ptr<SNDFILE, int (*)(SNDFILE*)> sound(sf_open(file.c_str(), SFM_READ, &info), sf_close);
    if (!sound) return Error{file.string(), "is not a sound that can be read"};
    if (info.channels < 1 || info.channels > 2)
        return Error{file.string(), "has neither one nor two channels"};
    if (info.samplerate < 8000 || info.samplerate > 192000)
        return Error{file.string(), "has an unusable sample rate"};
    if (info.frames < 1 || info.frames > static_cast<sf_count_t>(info.samplerate) * kMaxClip_s)
        return Error{file.string(), "is empty or longer than a minute"};
    Clip clip{info.samplerate, info.channels, {}};
    clip.samples.resize(static_cast<size_t>(info.frames) * static_cast<size_t>(info.channels));
    if (sf_readf_short(sound.get(), clip.samples.data(), info.frames) != info.frames)
        return Error{file.string(), "is damaged or cut short"};
    return clip;
}

} // namespace shoal::audio
