// A 16-bit WAV, written by hand.
#pragma once

#include "engine/core/Files.h"
#include "tests/TestPaths.h"

#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace shoal {

inline std::string wavOf(uint16_t channels, uint32_t rate_Hz, const std::vector<int16_t>& samples) {
    std::string out;
    const auto put = [&](const auto value) {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        out.append(bytes, sizeof value);
    };
    const auto size = static_cast<uint32_t>(samples.size() * 2);
    out += "RIFF";
    put(uint32_t{36 + size});
    out += "WAVEfmt ";
    put(uint32_t{16});
    put(uint16_t{1});
    put(channels);
    put(rate_Hz);
    put(uint32_t{rate_Hz * channels * 2});
    put(static_cast<uint16_t>(channels * 2));
    put(uint16_t{16});
    out += "data";
    put(size);
    out.append(reinterpret_cast<const char*>(samples.data()), samples.size() * 2);
    return out;
}

// A file in a folder of its own, deleted at the end of its scope.
struct TemporaryFile {
    tests::ScratchFolder folder;
    Path path;
    TemporaryFile(const std::string& name, const std::string& bytes) : path(folder / name) {
        std::ofstream(path, std::ios::binary) << bytes;
    }
};

} // namespace shoal
