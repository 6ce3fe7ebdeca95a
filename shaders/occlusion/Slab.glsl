// Intersects rays with slabs and with the cells of a grid (Amanatides and Woo 1987, "A Fast Voxel Traversal Algorithm for Ray
// Tracing"), and makes frames around them.

bool clipSlab(float origin, float direction, float low, float high, inout float from, inout float to) {
    if (direction == 0.0) return origin >= low && origin <= high && from <= to;
    float a = (low - origin) / direction, b = (high - origin) / direction;
    from = max(from, min(a, b));
    to = min(to, max(a, b));
    return from <= to;
}

// A walk through unit cells: start it, then take steps until `walkStep` says that the next cell is outside.
struct CellWalk {
    ivec2 cell, turn;
    vec2 next, perCell;
    float at, end, to; // the cell is crossed from `at` to `end`
};

const float kNever = 1e30;

CellWalk walkStart(vec2 origin, vec2 direction, float from, float to, ivec2 low, ivec2 high) {
    CellWalk walk;
    walk.turn = ivec2(direction.x < 0.0 ? -1 : 1, direction.y < 0.0 ? -1 : 1);
    walk.cell = clamp(ivec2(floor(origin + direction * from)), low, high - 1);
    for (int k = 0; k < 2; ++k) {
        walk.perCell[k] = direction[k] == 0.0 ? kNever : 1.0 / abs(direction[k]);
        walk.next[k] = direction[k] == 0.0
                           ? kNever
                           : (float(walk.cell[k] + (walk.turn[k] > 0 ? 1 : 0)) - origin[k]) / direction[k];
    }
    walk.at = from;
    walk.to = to;
    walk.end = max(from, min(min(walk.next.x, walk.next.y), to));
    return walk;
}

bool walkStep(inout CellWalk walk, ivec2 low, ivec2 high) {
    int k = walk.next.x < walk.next.y ? 0 : 1;
    if (walk.next[k] >= walk.to) return false;
    walk.at = walk.end;
    walk.cell[k] += walk.turn[k];
    walk.next[k] += walk.perCell[k];
    walk.end = max(walk.at, min(min(walk.next.x, walk.next.y), walk.to));
    return walk.cell[k] >= low[k] && walk.cell[k] < high[k];
}

// Returns a right-handed frame around a unit vector, as columns. Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
mat3 frameAround(vec3 n) {
    float side = n.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (side + n.z), b = n.x * n.y * a;
    return mat3(vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x), vec3(b, side + n.y * n.y * a, -n.y), n);
}
