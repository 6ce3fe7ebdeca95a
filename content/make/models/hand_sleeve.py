"""The end of a wetsuit's sleeve: a short cuff around the wrist, hemmed at both ends, that opens behind into the dark."""

import numpy as np

import paint
from mesh import Part, facing, grid_triangles, tangent_frame, unit, without_slivers
from paint import bump, mix, rgb, step

# Along the tube: metres behind the wrist, and half widths across and up. It starts inside, between skin and hem,
# runs back to the open end, turns in over that hem's thickness and closes deep inside, behind the stub of the arm.
PROFILE = np.array([
    (0.0190, 0.0280, 0.0196), (0.0125, 0.0288, 0.0208), (0.0106, 0.0301, 0.0222), (0.0122, 0.0314, 0.0236), (0.0170, 0.0317, 0.0240),
    (0.0205, 0.0307, 0.0231), (0.0270, 0.0305, 0.0231), (0.0420, 0.0309, 0.0239), (0.0590, 0.0320, 0.0256), (0.0720, 0.0331, 0.0270),
    (0.0742, 0.0329, 0.0269), (0.0765, 0.0341, 0.0282), (0.0810, 0.0344, 0.0286), (0.0828, 0.0333, 0.0275), (0.0815, 0.0316, 0.0258),
    (0.0740, 0.0304, 0.0244), (0.0500, 0.0272, 0.0205), (0.0380, 0.0190, 0.0140), (0.0360, 0.0001, 0.0001)])
TURN = 14  # from this row on it is the inside, which needs few texels
AROUND = 22


def texture_u():
    """u of each row of the profile, in proportion to its length, but a third of that inside; and the metres that u spans."""
    length = np.hypot(np.diff(PROFILE[:, 0]), np.diff(PROFILE[:, 1]))
    length[TURN:] /= 3
    along = np.concatenate([[0], np.cumsum(length)])
    return along / along[-1], along[-1]


def tube():
    """The part; its uv runs 0..1 along (u) and around (v)."""
    u = texture_u()[0]
    g = np.linspace(0, 2 * np.pi, AROUND + 1)
    z, a, b = PROFILE[:, :1], PROFILE[:, 1:2], PROFILE[:, 2:]
    crease = 1 + 0.012 * np.sin(z * 260 + 0.9 * np.sin(2 * g)) * step(0.022, 0.035, z) * step(0.073, 0.060, z)
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
    rows, length_m = texture_u()
    z = np.interp(u, rows, PROFILE[:, 0])
    inside = np.maximum(step(0.06, 0.0, u), step(rows[TURN - 1], rows[TURN + 1], u))
    band = step(0.0275, 0.0285, z) * step(0.0345, 0.0335, z)
    c = mix(c, rgb('#2f7fa0') * (1 + 0.08 * wear)[..., None], 0.9 * band)
    rim = step(0.0750, 0.0762, z) * (1 - inside)  # the binding of the open end, paler, so that its thickness shows
    c = mix(c, rgb('#4a565e'), 0.8 * rim)
    stitch = (bump(z - 0.0222, 0.0009) + bump(z - 0.0730, 0.0009)) * (0.5 + 0.5 * np.sign(np.sin(v * 2 * np.pi * 60)))
    c = mix(c, rgb('#6f8087'), 0.5 * stitch)
    seam = bump((v - 0.75) * 0.2, 0.0012)
    c = mix(c, rgb('#0c0e10'), 0.7 * seam)
    c = c * (1 - 0.75 * inside * (1 + 0.25 * step(rows[TURN], rows[TURN + 2], u)))[..., None]  # no light finds its way in
    knit = paint.noise(312, u * 190, v * 240)
    height_m = 0.00005 * knit - 0.0005 * seam + 0.0002 * stitch - 0.0006 * (bump(z - 0.0205, 0.0012) + bump(z - 0.0742, 0.0012)) + 0.0003 * wear
    normal = paint.normal_map(height_m * (1 - inside), length_m / width, 0.18 / height)
    rough = mix(np.clip(0.56 + 0.05 * knit, 0.4, 0.7), 1.0, inside)
    return np.clip(c, 0, 1), normal, np.stack([np.ones_like(u), rough, 0 * u], -1)
