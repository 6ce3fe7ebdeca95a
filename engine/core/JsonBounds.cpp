#include "engine/core/JsonBounds.h"

namespace shoal {

std::string exceededBound(std::string_view json, const JsonBounds& bounds) {
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
