// The lat-long map. Twin of engine/math/LatLong.h, whose first lines have a drawing of it.
const float kPi = 3.14159265358979;

// dir: unit length, env frame. u wraps; explicit levels of detail keep the seam clean.
vec2 latLongFromDirection(vec3 dir) {
    return vec2(0.5 + atan(dir.x, -dir.z) * (0.5 / kPi), 0.5 - asin(clamp(dir.y, -1.0, 1.0)) / kPi);
}
