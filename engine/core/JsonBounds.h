// Bounds of JSON text of unknown origin, checked before a parser takes memory for it. Hand-written because
// nlohmann's parser callback takes quadratic time: 193 s instead of 0.5 s for 600,000 small objects.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace shoal {

struct JsonBounds {
    int depth;       // levels of nesting: a parser's stack grows with them
    uint64_t values; // a parsed value costs up to some 100 bytes
    uint64_t objects;
};

// Returns a message about the bound that the text exceeds, such as "is nested deeper than 64 levels"; empty
// if none. It counts brackets and commas only, and leaves invalid JSON to the parser.
inline std::string exceededBound(std::string_view json, const JsonBounds& bounds) {
    uint64_t values = 1, objects = 0;
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (inString) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                inString = false;
            continue;
        }
        inString = c == '"';
        depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        objects += c == '{';
        values += c == '{' || c == '[' || c == ',';
        if (depth > bounds.depth) return "is nested deeper than " + std::to_string(bounds.depth) + " levels";
        if (objects > bounds.objects) return "has more than " + std::to_string(bounds.objects) + " objects";
        if (values > bounds.values) return "has more than " + std::to_string(bounds.values) + " values";
    }
    return {};
}

} // namespace shoal
