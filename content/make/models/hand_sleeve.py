"""The end of a wetsuit's sleeve: a tube around the wrist with a rolled hem, closed behind, so that no arm is cut off."""

import numpy as np

import paint
from mesh import Part, facing, grid_triangles, tangent_frame, unit, without_slivers
from paint import bump, mix, rgb, step

# Along the tube: metres behind the wrist, and half widths across and up. It starts inside, between skin and hem.
PROFILE = np.array([
    (0.0190, 0.0262, 0.0185), (0.0125, 0.0275, 0.0200), (0.0105, 0.0296, 0.0222), (0.0125, 0.0316, 0.0243), (0.0175, 0.0318, 0.0247),
    (0.0210, 0.0308, 0.0237), (0.0300, 0.0308, 0.0240), (0.0500, 0.0318, 0.0258), (0.0800, 0.0340, 0.0292), (0.1100, 0.0362, 0.0325),
    (0.1380, 0.0372, 0.0345), (0.1520, 0.0330, 0.0310), (0.1590, 0.0200, 0.0190), (0.1600, 0.0001, 0.0001)])
AROUND = 20


def tube():
    """The part; its uv runs 0..1 along (u) and around (v)."""
    along = np.concatenate([[0], np.cumsum(np.hypot(np.diff(PROFILE[:, 0]), np.diff(PROFILE[:, 1])))])
    u = along / along[-1]
    g = np.linspace(0, 2 * np.pi, AROUND + 1)
    z, a, b = PROFILE[:, :1], PROFILE[:, 1:2] * 1.07, PROFILE[:, 2:] * 1.07
    crease = 1 + 0.012 * np.sin(z * 260 + 0.9 * np.sin(2 * g)) * step(0.022, 0.035, z) * step(0.14, 0.12, z)
    p = np.stack([a * crease * np.cos(g), b * crease * np.sin(g) - 0.0012, z + 0 * g], -1)
    du, dv = np.gradient(p, axis=0), np.gradient(p, axis=1)
    dv[:, [0, -1]] = (p[:, [1]] - p[:, [-2]]) / 2
    n = np.cross(dv, du)
    uv = np.stack(np.broadcast_arrays(u[:, None], g / (2 * np.pi)), -1)
    n = unit(n)
    n = n * np.sign(np.sum(n[6] * np.stack([np.cos(g), np.sin(g), 0 * g], -1)))  # outward
    n[-1] = [0, 0, 1]
    return facing(without_slivers(Part(p.reshape(-1, 3), n.reshape(-1, 3), tangent_frame(n, du, -dv).reshape(-1, 4), uv.reshape(-1, 2),
                                       grid_triangles(*p.shape[:2]))))


def pictures(width, height):
    """Colour, normal map, roughness of the tube: u to the right, v down."""
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    around = np.cos(2 * np.pi * v), np.sin(2 * np.pi * v)
    wear = paint.fbm(311, u * 14, around[0] * 3, around[1] * 3, octaves=4)
    c = mix(rgb('#1d2226'), rgb('#2b3238'), step(-0.4, 0.6, wear))
    z = np.interp(u, np.concatenate([[0], np.cumsum(np.hypot(np.diff(PROFILE[:, 0]), np.diff(PROFILE[:, 1])))]) /
                  np.hypot(np.diff(PROFILE[:, 0]), np.diff(PROFILE[:, 1])).sum(), PROFILE[:, 0])
    band = step(0.034, 0.036, z) * step(0.046, 0.044, z)
    c = mix(c, rgb('#2f7fa0') * (1 + 0.08 * wear)[..., None], 0.9 * band)
    stitch = bump(z - 0.0225, 0.0009) * (0.5 + 0.5 * np.sign(np.sin(v * 2 * np.pi * 60)))
    c = mix(c, rgb('#6f8087'), 0.5 * stitch)
    seam = bump((v - 0.75) * 0.2, 0.0012)
    c = mix(c, rgb('#0c0e10'), 0.7 * seam)
    c = c * (1 - 0.75 * step(0.06, 0.0, u))[..., None]  # inside the hem
    knit = paint.noise(312, u * 190, v * 240)
    height_m = 0.00005 * knit - 0.0005 * seam + 0.0002 * stitch - 0.0006 * bump(z - 0.0205, 0.0012) + 0.0003 * wear
    normal = paint.normal_map(height_m, 0.19 / width, 0.19 / height)
    rough = np.clip(0.56 + 0.05 * knit, 0.4, 0.7)
    return np.clip(c, 0, 1), normal, np.stack([np.ones_like(u), rough, 0 * u], -1)
