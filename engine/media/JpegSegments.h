// Internal to this room.
#pragma once

#include "engine/media/Bytes.h"

namespace shoal::media {

// JPEG, ITU T.81 annex B: calls visit(marker, payload) for each segment until it returns true or the
// compressed data begins. Returns the offset reached.
template <class Visit> size_t walkJpeg(ByteSpan b, Visit&& visit) {
    size_t at = 2;
    while (at + 4 <= b.size()) {
        if (b[at] != 0xff) break;
        const uint8_t marker = b[at + 1];
        if (marker == 0xff) { // fill byte
            ++at;
            continue;
        }
        if (marker == 0x01 || (marker >= 0xd0 && marker <= 0xd7)) { // markers without payload
            at += 2;
            continue;
        }
        const size_t length = big16(b, at + 2);
        if (marker == 0xd9 || length < 2 || length > b.size() - at - 2) break;
        if (visit(marker, b.subspan(at + 4, length - 2))) break;
        at += 2 + length;
        if (marker == 0xda) break;
    }
    return at;
}

} // namespace shoal::media
