"""Implicit surfaces: distances to simple solids, smooth unions, and their polygons by surface nets."""

import numpy as np

from mesh import unit


def capsule(p, a, b, ra, rb, squash=None):
    """Distance (near enough) to a tapered capsule; squash: factors on x, y, z of the offset from its axis."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    axis = b - a
    t = np.clip((p - a) @ axis / (axis @ axis), 0, 1)
    off = p - a - t[:, None] * axis
    if squash is not None:
        off = off * squash
    return np.linalg.norm(off, axis=1) - (ra + (rb - ra) * t)


def ellipsoid(p, centre, radii, turn=None):
    """Distance (near enough) to an ellipsoid; turn: rotation matrix whose columns are its axes."""
    q = p - centre
    if turn is not None:
        q = q @ turn
    radii = np.asarray(radii, float)
    k0 = np.linalg.norm(q / radii, axis=1)
    k1 = np.linalg.norm(q / radii ** 2, axis=1)
    return k0 * (k0 - 1) / np.maximum(k1, 1e-9)


def smooth_min(a, b, k):
    """Union that fills the valley between a and b with a fillet of about k metres."""
    h = np.maximum(k - np.abs(a - b), 0) / k
    return np.minimum(a, b) - h * h * h * k / 6


def smooth_max(a, b, k):
    return -smooth_min(-a, -b, k)


def gradient(field, p, e=2e-4):
    g = np.empty_like(p)
    for i in range(3):
        d = np.zeros(3)
        d[i] = e
        g[:, i] = (field(p + d) - field(p - d)) / (2 * e)
    return g


def project(field, p, steps=3):
    for _ in range(steps):
        g = gradient(field, p)
        p = p - g * (field(p) / np.maximum((g * g).sum(1), 1e-6))[:, None]
    return p


def surface_nets(field, low, high, cell):
    """Vertices (n x 3) and triangles (m x 3, outward) of field = 0. cell: spacing in x, y, z."""
    axes = [np.arange(l, h + c, c) for l, h, c in zip(low, high, cell)]
    shape = tuple(len(a) for a in axes)
    grid = np.stack(np.meshgrid(*axes, indexing='ij'), -1).reshape(-1, 3)
    value = field(grid).reshape(shape)
    inside = value < 0
    cells = tuple(n - 1 for n in shape)
    total, count = np.zeros(cells + (3,)), np.zeros(cells)
    corners = [(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)]

    def corner(a, c):
        return a[c[0]:c[0] + cells[0], c[1]:c[1] + cells[1], c[2]:c[2] + cells[2]]
    for c in corners:
        for axis in range(3):
            if c[axis]:
                continue
            d = list(c)
            d[axis] = 1
            va, vb = corner(value, c), corner(value, d)
            cross = corner(inside, c) != corner(inside, d)
            t = np.where(cross, va / np.where(cross, va - vb, 1), 0)
            where = np.zeros(cells + (3,)) + np.array(c, float)
            where[..., axis] = t
            total += where * cross[..., None]
            count += cross
    used = count > 0
    index = np.full(cells, -1)
    index[used] = np.arange(used.sum())
    local = total[used] / count[used][:, None]
    points = np.stack(np.nonzero(used), -1) + local
    points = points * np.asarray(cell) + np.array([a[0] for a in axes])
    quads = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        first = [slice(1, n - 1) for n in shape]
        first[axis] = slice(0, shape[axis] - 1)
        second = list(first)
        second[axis] = slice(1, shape[axis])
        sa, sb = inside[tuple(first)], inside[tuple(second)]
        where = np.stack(np.nonzero(sa != sb), -1) + [f.start for f in first]

        def at(du, dv):
            w = where.copy()
            w[:, u] -= du
            w[:, v] -= dv
            return index[w[:, 0], w[:, 1], w[:, 2]]
        q = np.stack([at(1, 1), at(0, 1), at(0, 0), at(1, 0)], -1)
        leaves = inside[tuple(where.T)]  # inside first: the edge leaves the solid along +axis
        quads.append(np.where(leaves[:, None], q, q[:, ::-1]))
    quads = np.concatenate(quads)
    return points, quads


def split_quads(points, quads):
    """Two triangles of each quad, along its shorter diagonal."""
    p = points[quads]
    short = np.linalg.norm(p[:, 0] - p[:, 2], axis=1) <= np.linalg.norm(p[:, 1] - p[:, 3], axis=1)
    a = np.where(short[:, None], quads[:, [0, 1, 2]], quads[:, [0, 1, 3]])
    b = np.where(short[:, None], quads[:, [0, 2, 3]], quads[:, [1, 2, 3]])
    return np.concatenate([a, b])


def relax(field, points, quads, rounds=6):
    """Evens out the quads: each point moves to the middle of its neighbours, then back to the surface."""
    edges = np.concatenate([quads[:, [i, (i + 1) % 4]] for i in range(4)])
    edges = np.concatenate([edges, edges[:, ::-1]])
    degree = np.bincount(edges[:, 0], minlength=len(points))[:, None]
    for _ in range(rounds):
        middle = np.stack([np.bincount(edges[:, 0], points[edges[:, 1], i], len(points)) for i in range(3)], -1)
        step = middle / degree - points
        n = unit(gradient(field, points))
        points = points + 0.6 * (step - n * (step * n).sum(1, keepdims=True))
        points = project(field, points, 1)
    return points


# ---------------------------------------------------------------- an atlas for any mesh

def charts(points, triangles, normals, rounds=8):
    """A chart number for each triangle, and each chart's axis (0..5: +x -x +y -y +z -z): connected pieces that face
    one way, so that a plain projection along the axis unfolds them without overlaps or much stretch."""
    face = unit(normals[triangles].sum(1))
    score = np.concatenate([face, -face], 1)[:, [0, 3, 1, 4, 2, 5]]
    m = len(triangles)
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), 1)
    owner = np.tile(np.arange(m), 3)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    e, o = edges[order], owner[order]
    same = (e[1:] == e[:-1]).all(1)
    pairs = np.stack([o[:-1][same], o[1:][same]], -1)
    label = score.argmax(1)
    for _ in range(rounds):  # neighbours vote, so that borders run smoothly
        votes = score * 1.6
        for a, b in ((0, 1), (1, 0)):
            np.add.at(votes, (pairs[:, a], label[pairs[:, b]]), 0.45)
        label = np.where(score[np.arange(m), votes.argmax(1)] > 0.25, votes.argmax(1), score.argmax(1))
    chart = np.arange(m)
    for _ in range(2000):
        joined = pairs[label[pairs[:, 0]] == label[pairs[:, 1]]]
        before = chart.copy()
        np.minimum.at(chart, joined[:, 0], chart[joined[:, 1]])
        np.minimum.at(chart, joined[:, 1], chart[joined[:, 0]])
        chart = chart[chart]
        if (chart == before).all():
            break
    _, chart = np.unique(chart, return_inverse=True)
    axis = np.zeros(chart.max() + 1, int)
    axis[chart] = label
    return chart, axis


# Which way u and v run in the projection along each axis, so that u x up = outward (up: against v).
CHART_U = np.array([[0, 0, -1], [0, 0, 1], [1, 0, 0], [1, 0, 0], [1, 0, 0], [-1, 0, 0]], float)
CHART_UP = np.array([[0, 1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1], [0, 1, 0], [0, 1, 0]], float)


def unfold(points, triangles, normals, size, pad=3):
    """Splits vertices at chart borders and packs charts into a square of size texels.

    Returns (which old vertex each new one is, new triangles, uvs, u axis and up axis of each new vertex).
    """
    chart, axis = charts(points, triangles, normals)
    key = triangles + chart[:, None] * len(points)
    keys, new = np.unique(key.reshape(-1), return_inverse=True)
    old, of = keys % len(points), keys // len(points)
    flat = np.stack([(points[old] * CHART_U[axis[of]]).sum(1), -(points[old] * CHART_UP[axis[of]]).sum(1)], -1)
    count = chart.max() + 1
    low = np.stack([np.full(count, 1e9)] * 2, -1)
    high = -low
    np.minimum.at(low, of, flat)
    np.maximum.at(high, of, flat)
    span = high - low
    order = np.argsort(-span[:, 1], kind='stable')

    def pack(scale):
        """Shelves of charts, tallest first; texel corners, or None if they do not fit."""
        corner, x, y, shelf = np.zeros((count, 2)), 0, 0, 0
        for c in order:
            w, h = np.ceil(span[c] * scale) + 2 * pad
            if x + w > size:
                x, y, shelf = 0, y + shelf, 0
            if x + w > size or y + h > size:
                return None
            corner[c] = x + pad, y + pad
            x, shelf = x + w, max(shelf, h)
        return corner
    scale, best = 100.0, None
    while (placed := pack(scale)) is not None:
        best = scale, placed
        scale *= 1.01
    scale, corner = best
    uv = ((flat - low[of]) * scale + corner[of]) / size
    return old, new.reshape(-1, 3), uv, CHART_U[axis[of]], CHART_UP[axis[of]]


def bake(uv, triangles, values, size):
    """Spreads vertex values over the texels of their triangles and three texels beyond. Returns values, mask."""
    out = np.zeros((size, size, values.shape[1]))
    depth = np.full((size, size), -1e9)
    xy = uv * size - 0.5
    for t in triangles:
        a, b, c = xy[t]
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if abs(area) < 1e-9:
            continue
        x0, y0 = np.maximum(np.floor(np.minimum(np.minimum(a, b), c)).astype(int) - 2, 0)
        x1, y1 = np.minimum(np.ceil(np.maximum(np.maximum(a, b), c)).astype(int) + 3, size)
        x, y = np.meshgrid(np.arange(x0, x1), np.arange(y0, y1))
        w0 = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / area
        w1 = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / area
        w2 = 1 - w0 - w1
        inner = np.minimum(np.minimum(w0, w1), w2)
        longest = max(np.abs(b - a).max(), np.abs(c - a).max(), np.abs(c - b).max(), 1e-6)
        reach = inner * abs(area) / longest  # about: texels inside (+) or beyond (-) the nearest edge
        box = depth[y0:y1, x0:x1]
        take = (reach > -3) & (np.minimum(reach, 0) > box)
        w = np.stack([w0, w1, w2], -1)[take]
        out[y0:y1, x0:x1][take] = w @ values[t]
        box[take] = np.minimum(reach, 0)[take]
    return out, depth > -1e8
