// Twins of the functions in engine/occlusion/Directions.h.

vec3 directionFromSquare(vec2 square) {
    vec3 v = vec3(square, 1.0 - abs(square.x) - abs(square.y));
    float wrap = max(-v.z, 0.0);
    v.x -= v.x < 0.0 ? -wrap : wrap;
    v.y -= v.y < 0.0 ? -wrap : wrap;
    return normalize(v);
}

vec3 unpackDirection(uint packed_, int bits) {
    float top = float((1 << (bits - 1)) - 1);
    ivec2 steps = ivec2(bitfieldExtract(int(packed_), 0, bits), bitfieldExtract(int(packed_), bits, bits));
    return directionFromSquare(vec2(steps) / top);
}
