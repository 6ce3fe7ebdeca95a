// engine/occlusion/Octahedral.h

vec2 squareFromDirection(vec3 direction) {
    vec3 a = abs(direction);
    vec2 flat_ = direction.xy / (a.x + a.y + a.z);
    if (direction.z >= 0.0) return flat_;
    return (1.0 - abs(flat_.yx)) * vec2(flat_.x < 0.0 ? -1.0 : 1.0, flat_.y < 0.0 ? -1.0 : 1.0);
}

vec3 directionFromSquare(vec2 square) {
    vec3 v = vec3(square, 1.0 - abs(square.x) - abs(square.y));
    float wrap = max(-v.z, 0.0);
    v.x -= v.x < 0.0 ? -wrap : wrap;
    v.y -= v.y < 0.0 ? -wrap : wrap;
    return normalize(v);
}

uint packDirection(vec3 direction, int bits) {
    float top = float((1 << (bits - 1)) - 1);
    ivec2 steps = ivec2(round(squareFromDirection(direction) * top));
    uint mask = (1u << bits) - 1u;
    return (uint(steps.x) & mask) | (uint(steps.y) & mask) << bits;
}

vec3 unpackDirection(uint packed_, int bits) {
    float top = float((1 << (bits - 1)) - 1);
    ivec2 steps = ivec2(bitfieldExtract(int(packed_), 0, bits), bitfieldExtract(int(packed_), bits, bits));
    return directionFromSquare(vec2(steps) / top);
}
