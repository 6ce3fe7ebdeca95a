"""Painting on arrays: noise, masks, colours, height to normals, and encoding. Colours are sRGB in 0..1."""

import io

import numpy as np
from PIL import Image


def step(low, high, x):
    """Smooth step from 0 at low to 1 at high; low may be above high."""
    t = np.clip((np.asarray(x, float) - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def mix(a, b, t):
    t = np.asarray(t, float)
    a, b = np.asarray(a, float), np.asarray(b, float)
    return a + (b - a) * (t[..., None] if max(a.ndim, b.ndim) > t.ndim or a.shape[-1:] == (3,) else t)


def rgb(text):
    """'#rrggbb'."""
    return np.array([int(text[i:i + 2], 16) / 255 for i in (1, 3, 5)])


def _hash(seed, *whole):
    h = np.full(np.broadcast(*whole).shape, (seed * 374761393 + 668265263) & 0xffffffff, np.uint32)
    with np.errstate(over='ignore'):
        for k, w in zip((0x9e3779b1, 0x85ebca77, 0xc2b2ae3d), whole):
            h = (h ^ (w.astype(np.int64) & 0xffffffff).astype(np.uint32)) * np.uint32(k)
            h ^= h >> np.uint32(15)
        h = (h ^ (h >> np.uint32(13))) * np.uint32(0x27d4eb2f)
        h ^= h >> np.uint32(16)
    return h.astype(float) / 4294967296.0


def scatter(seed, *whole):
    """A number in 0..1 for each tuple of whole numbers."""
    return _hash(seed, *[np.asarray(w) for w in whole])


def noise(seed, *x):
    """Value noise in -1..1 of one feature per unit, in as many dimensions as arguments."""
    x = np.broadcast_arrays(*[np.asarray(v, float) for v in x])
    base = [np.floor(v).astype(np.int64) for v in x]
    f = [v - b for v, b in zip(x, base)]
    f = [t * t * t * (t * (6 * t - 15) + 10) for t in f]
    total = 0.0
    for corner in range(2 ** len(x)):
        weight, cell = 1.0, []
        for k in range(len(x)):
            bit = corner >> k & 1
            weight = weight * (f[k] if bit else 1 - f[k])
            cell.append(base[k] + bit)
        total = total + weight * _hash(seed, *cell)
    return total * 2 - 1


def fbm(seed, *x, octaves=4):
    total, scale, size = 0.0, 1.0, 0.0
    for k in range(octaves):
        total = total + scale * noise(seed + 17 * k, *[np.asarray(v) * 2.03 ** k + 11.3 * k for v in x])
        size += scale
        scale *= 0.5
    return total / size


def cells(seed, x, y, jitter=0.7):
    """Distances to the nearest and second nearest of points scattered one to a unit cell, every other row shifted as
    in a honeycomb, and a random number of the nearest."""
    first, second = np.full(np.shape(x), 9.0), np.full(np.shape(x), 9.0)
    which = np.zeros(np.shape(x))
    row = np.floor(y)
    for dy in (-1, 0, 1):
        j = row + dy
        shift = (j % 2) * 0.5
        for dx in (-1, 0, 1):
            i = np.floor(x - shift) + dx
            cx = i + shift + 0.5 + jitter * (scatter(seed, i, j) - 0.5)
            cy = j + 0.5 + jitter * (scatter(seed + 1, i, j) - 0.5)
            d = np.hypot(x - cx, y - cy)
            nearer = d < first
            second = np.where(nearer, first, np.minimum(second, d))
            which = np.where(nearer, scatter(seed + 2, i, j), which)
            first = np.minimum(first, d)
    return first, second, which


def line(distance, half_width, soft):
    """1 on a line, 0 beyond half_width + soft."""
    return 1 - step(half_width, half_width + soft, np.abs(distance))


def bump(distance, width):
    return np.exp(-(np.asarray(distance) / width) ** 2)


def normal_map(height, metres_u, metres_v):
    """Tangent-space normals (OpenGL's green: up) of a height field in metres; metres_*: size of a texel."""
    du = np.gradient(height, axis=1) / metres_u
    dv = np.gradient(height, axis=0) / metres_v
    n = np.stack([-du, dv, np.ones_like(du)], -1)
    return n / np.linalg.norm(n, axis=-1, keepdims=True) * 0.5 + 0.5


def bytes_of(picture):
    return np.clip(np.asarray(picture) * 255 + 0.5, 0, 255).astype(np.uint8)


def png(picture):
    out = io.BytesIO()
    Image.fromarray(bytes_of(picture)).save(out, 'PNG', optimize=True)
    return out.getvalue()


def jpeg(picture, quality=92):
    out = io.BytesIO()
    Image.fromarray(bytes_of(picture)).save(out, 'JPEG', quality=quality, subsampling=0, optimize=True)
    return out.getvalue()


def shrink(picture, times):
    h, w = picture.shape[0] // times, picture.shape[1] // times
    return picture[:h * times, :w * times].reshape(h, times, w, times, *picture.shape[2:]).mean((1, 3))


def bled(picture):
    """RGBA: what was never painted takes the mean colour, so that smaller mip levels do not darken at edges."""
    empty = (picture == 0).all(-1)
    out = picture.copy()
    out[empty, :3] = picture[~empty, :3].mean(0)
    return out
