"""Eyes: domes that stand out of the skin a little, and the pictures on them, as seen from the front."""

import numpy as np

import paint
from mesh import Part, facing, grid_triangles, tangent_frame, unit, without_slivers


def eye_part(centre, outward, radius, bulge=0.55, rings=5, around=14):
    """Half an ellipsoid that looks along `outward`; its uv spans 0..1 as seen from the front."""
    n = unit(outward)
    right = unit(np.cross([0, 1, 0], n))
    up = np.cross(n, right)
    f, g = np.meshgrid(np.linspace(0, np.pi / 2, rings), np.linspace(0, 2 * np.pi, around + 1), indexing='ij')
    x, y, z = np.sin(f) * np.cos(g), np.sin(f) * np.sin(g), np.cos(f)
    p = centre + radius * (x[..., None] * right + y[..., None] * up + bulge * z[..., None] * n)
    m = unit(x[..., None] * right + y[..., None] * up + z[..., None] / bulge * n)
    uv = np.stack([0.5 + 0.5 * x, 0.5 - 0.5 * y], -1)
    t = tangent_frame(m, np.broadcast_to(right, m.shape), np.broadcast_to(up, m.shape))
    return facing(without_slivers(Part(p.reshape(-1, 3), m.reshape(-1, 3), t.reshape(-1, 4), uv.reshape(-1, 2),
                                       grid_triangles(rings, around + 1))))


def disc(size):
    """x right, y down, radius and angle of a picture's texels; the radius is 1 at its edge."""
    y, x = (np.mgrid[0:size, 0:size] + 0.5) / size * 2 - 1
    return x, y, np.hypot(x, y), np.arctan2(y, x)


def catch_light(colour, x, y):
    """Adds the mirror image of the bright water above in a wet cornea: filtered light cannot show so small a spot."""
    sky = paint.step(0.35, -0.75, y) * paint.step(0.95, 0.7, np.hypot(x, y)) * paint.step(-0.95, -0.3, y)
    spot = paint.step(0.17, 0.07, np.hypot(x - 0.20, (y + 0.36) * 1.2))
    return paint.mix(paint.mix(colour, paint.rgb('#86a9bd'), 0.16 * sky), paint.rgb('#f4fbff'), 0.85 * spot)


def fish_eye(iris, ring, pupil=0.50, seed=5, size=128):
    """A pupil that is longer towards the front, a bright ring, an iris with fine spokes, darker above and at its rim."""
    x, y, r, g = disc(size)
    tear = np.hypot(x - 0.06 * np.maximum(x, 0), y * 1.06)
    spokes = paint.fbm(seed, np.cos(g) * 7, np.sin(g) * 7, r * 2.5, octaves=3)
    c = paint.mix(paint.rgb(ring), paint.rgb(iris), paint.step(pupil + 0.01, pupil + 0.16, r))
    c = c * (1 + 0.34 * spokes[..., None])
    c = paint.mix(c, c * 0.40, paint.step(0.10, -0.75, y) * paint.step(pupil, pupil + 0.25, r))
    c = paint.mix(c, c * 0.30, paint.step(0.80, 0.98, r))
    c = paint.mix(paint.rgb('#030405'), c, paint.step(pupil - 0.02, pupil + 0.03, tear))
    return paint.shrink(catch_light(c, x, y), 2)


def slit_eye(iris, depth, seed=131, size=128, lid=None):
    """The eye of a shark or a ray: an upright slit in an iris that darkens outwards. lid: colour of the third eyelid's edge."""
    x, y, r, g = disc(size)
    spokes = paint.fbm(seed, np.cos(g) * 6, np.sin(g) * 6, r * 3, octaves=3)
    c = paint.mix(paint.rgb(iris), paint.rgb(depth), paint.step(0.30, 0.80, r)) * (1 + 0.2 * spokes)[..., None]
    c = paint.mix(paint.rgb('#040506'), c, paint.step(0.90, 1.08, np.hypot(x / 0.30, y / 0.66)))
    c = paint.mix(c, paint.rgb('#101416'), paint.step(0.80, 0.95, r))
    if lid:
        fold = y - 0.62 + 0.35 * x * x
        c = paint.mix(paint.mix(c, paint.rgb('#050606'), 0.8 * paint.bump(fold, 0.09)), paint.rgb(lid), paint.step(0.0, 0.10, fold))
    return paint.shrink(catch_light(c, x, y), 2)
