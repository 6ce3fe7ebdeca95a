"""Both arms: a wetsuit's sleeve from the cuff around the wrist to a rounded end at the shoulder, skinned to seven joints.

At rest the right arm lies straight along +Z behind its wrist, which is the origin, with the back of the hand up. The left one
is its mirror image in x. game/views/ArmPose poses the joints by name.
"""

import numpy as np

import paint
from glb import Glb
from mesh import Curve, Part, facing, grid_triangles, mirrored, strongest_four, tangent_frame, unit, without_slivers
from paint import bump, mix, rgb, step

ELBOW, SHOULDER = 0.27, 0.57  # metres behind the wrist; game/views/ArmPose.cpp knows both lengths
# Joint and its place behind the wrist. Two joints in one place turn differently: the wrist as the hand does, forearm_end along
# the forearm; forearm and upper_arm_end along their bones, and elbow half way between them.
JOINTS = (('wrist', 0.0), ('forearm_end', 0.0), ('forearm_middle', ELBOW / 2), ('forearm', ELBOW), ('elbow', ELBOW),
          ('upper_arm_end', ELBOW), ('upper_arm', SHOULDER))
POINT = np.array([0.6, -0.8])  # x, y of the direction in which the tip of the elbow points, at rest
# Metres behind the wrist, half widths across and up. It starts inside the skin of the wrist, runs forward to the hem and back.
CUFF = np.array([(0.0215, 0.0250, 0.0175), (0.0150, 0.0286, 0.0205), (0.0106, 0.0301, 0.0222), (0.0112, 0.0309, 0.0231),
                 (0.0135, 0.0315, 0.0238), (0.0180, 0.0318, 0.0241), (0.0230, 0.0314, 0.0238), (0.0290, 0.0309, 0.0234)])
# A slender arm: it covers less of the picture.
ACROSS = Curve([(0.029, 0.0309), (0.06, 0.0313), (0.10, 0.0325), (0.16, 0.0348), (0.21, 0.0353), (0.255, 0.0340), (0.29, 0.0335),
                (0.36, 0.0350), (0.46, 0.0385), (0.54, 0.0430), (0.60, 0.0440)])
UP = Curve([(0.029, 0.0234), (0.06, 0.0252), (0.10, 0.0280), (0.16, 0.0314), (0.21, 0.0332), (0.255, 0.0330), (0.29, 0.0336),
            (0.36, 0.0366), (0.46, 0.0402), (0.54, 0.0443), (0.60, 0.0452)])
AROUND = 20
WIDTH, HEIGHT = 1024, 512  # texels along and around


def rings():
    """z, half width across, half width up of each ring."""
    z = np.concatenate([np.linspace(0.038, 0.19, 9), np.linspace(0.200, 0.340, 18), np.linspace(0.375, 0.585, 5)])
    tube = np.stack([z, ACROSS(z), UP(z)], -1)
    turn = np.linspace(0, np.pi / 2, 5)[1:]  # the rounded end
    end = np.stack([0.585 + 0.05 * np.sin(turn), 0.0437 * np.maximum(np.cos(turn), 0.001), 0.0450 * np.maximum(np.cos(turn), 0.001)], -1)
    return np.concatenate([CUFF, tube, end])


def folds(z, x, y):
    """Height of folds above the smooth sleeve, metres: cloth gathers inside the elbow and behind the cuff. x, y: on a circle."""
    inside = step(-0.5, 0.7, -(x * POINT[0] + y * POINT[1]))
    wave = np.sin(2 * np.pi * (z / 0.0215 + 0.22 * paint.noise(401, x * 1.3, y * 1.3, z * 25)) + 0.9 * x - 0.7 * y)
    near = np.exp(-((z - ELBOW) / 0.042) ** 2)
    ripple = np.sin(2 * np.pi * (z / 0.027 + 0.35 * paint.noise(402, x * 1.1, y * 1.1, z * 12)) + 1.3 * y)
    return near * (0.0007 + 0.0021 * inside) * wave + 0.0005 * ripple * step(0.03, 0.06, z) * step(0.55, 0.45, z) * (1 - near)


def point_of_elbow(z, x, y):
    """Metres that the bone lifts the cloth by."""
    return 0.0075 * np.exp(-((z - ELBOW - 0.004) / 0.026) ** 2) * step(0.45, 1.0, x * POINT[0] + y * POINT[1])


def texture_u():
    """u of each ring: by length, but the inside of the hem has few texels and the upper arm half as many as the forearm."""
    rows = rings()
    length = np.hypot(np.diff(rows[:, 0]), np.diff(rows[:, 1]))
    length[:2] *= 0.4
    length = np.where(rows[1:, 0] > 0.36, 0.5 * length, length)
    along = np.concatenate([[0], np.cumsum(length)])
    return along / along[-1]


def weights(z):
    """Weights along the arm are linear between joints, so that cloth stretches evenly; wrist and elbow bend over a short part."""
    z = np.asarray(z, float)
    w = np.zeros((len(z), len(JOINTS)))
    hand = step(0.072, 0.024, z)
    upper = step(ELBOW - 0.050, ELBOW + 0.050, z)
    half = 1 - np.abs(2 * upper - 1)  # of the elbow, which turns half way
    t = np.clip(z / ELBOW, 0, 1)
    end, middle, low = np.clip(1 - 2 * t, 0, 1), 1 - np.abs(2 * t - 1), np.clip(2 * t - 1, 0, 1)
    fore = np.clip(1 - 2 * upper, 0, 1)
    s = np.clip((z - ELBOW) / (SHOULDER - ELBOW), 0, 1)
    back = np.clip(2 * upper - 1, 0, 1)
    w[:, 0] = hand
    for k, share in ((1, end), (2, middle), (3, low)):
        w[:, k] = (1 - hand) * fore * share
    w[:, 4] = half
    w[:, 5], w[:, 6] = back * (1 - s), back * s
    return w


def sleeve():
    """The right arm's mesh; its uv runs 0..1 along and around."""
    z, a, b = (column[:, None] for column in rings().T)
    g = np.linspace(0, 2 * np.pi, AROUND + 1)
    x, y = np.cos(g), np.sin(g)
    out = np.where(z > 0.03, folds(z, x, y) + point_of_elbow(z, x, y), 0) * step(0.62, 0.585, z)
    p = np.stack([(a + out) * x, (b + out) * y - 0.0012 * step(0.10, 0.03, z), z + 0 * g], -1)
    p[:, -1] = p[:, 0]
    du, dv = np.gradient(p, axis=0), np.gradient(p, axis=1)
    dv[:, [0, -1]] = (p[:, [1]] - p[:, [-2]]) / 2
    n = unit(np.cross(dv, du))
    n = n * np.sign(np.sum(n[12] * np.stack([x, y, 0 * g], -1)))  # outward
    n[-1] = [0, 0, 1]
    uv = np.stack(np.broadcast_arrays(texture_u()[:, None], g / (2 * np.pi)), -1)
    part = facing(without_slivers(Part(p.reshape(-1, 3), n.reshape(-1, 3), tangent_frame(n, du, -dv).reshape(-1, 4),
                                       uv.reshape(-1, 2), grid_triangles(*p.shape[:2]))))
    part.joints, part.weights = strongest_four(weights(part.positions[:, 2]))
    return part


def pictures():
    """Colour, normal map, roughness: u (along) to the right, v (around) down."""
    rows = rings()
    u, v = np.meshgrid((np.arange(WIDTH) + 0.5) / WIDTH, (np.arange(HEIGHT) + 0.5) / HEIGHT)
    rows_u = texture_u()
    z = np.interp(u, rows_u, rows[:, 0])
    x, y = np.cos(2 * np.pi * v), np.sin(2 * np.pi * v)
    wide = 0.5 * (np.interp(u, rows_u, rows[:, 1]) + np.interp(u, rows_u, rows[:, 2]))  # mean radius, metres
    around = 2 * np.pi * wide  # metres that v spans
    inside = step(rows_u[2], 0.0, u)
    wear = paint.fbm(411, z * 55, x * 2.2, y * 2.2, octaves=4)
    fine = paint.noise(412, z * 1500, v * 430)

    def apart(centre):  # metres from a line along the arm at v = centre
        return ((v - centre + 0.5) % 1 - 0.5) * around

    def seam_at(distance_m):  # a flat seam: a groove with thread over it from side to side
        groove = bump(distance_m, 0.0007)
        thread = bump(np.abs(distance_m) - 0.0016, 0.0006) + 0.7 * bump(distance_m, 0.0022) * step(0.3, 0.8, np.sin(z * 2 * np.pi / 0.0024))
        return groove, np.clip(thread, 0, 1)

    on_arm = step(0.046, 0.048, z)
    # a coloured panel along the thumb's side, which widens towards the elbow, and a fine line beside it
    panel_half = 0.0045 + 0.0055 * step(0.05, 0.20, z)  # metres
    panel_distance = np.abs(apart(0.36)) - panel_half
    stripe = step(0.0008, -0.0008, panel_distance) * on_arm * step(0.55, 0.54, z)
    piping = bump(apart(0.20), 0.0011) * on_arm * step(0.55, 0.54, z)
    groove, thread = seam_at(panel_distance)
    under_groove, under_thread = seam_at(apart(0.80))
    groove = np.maximum(groove * step(0.55, 0.54, z), under_groove) * on_arm
    thread = np.maximum(thread * step(0.55, 0.54, z), under_thread) * on_arm
    ring = np.maximum(bump(z - 0.047, 0.0008), bump(z - 0.372, 0.0010))
    ring_thread = np.maximum(bump(np.abs(z - 0.047) - 0.0017, 0.0006), bump(np.abs(z - 0.372) - 0.0018, 0.0007)) \
        * step(-0.2, 0.4, np.sin(v * around * 2 * np.pi / 0.0026))
    groove, thread = np.maximum(groove, ring), np.maximum(thread, ring_thread)
    # the patch that guards the elbow
    towards = x * POINT[0] + y * POINT[1]
    patch = step(-0.03, 0.03, 1 - ((z - ELBOW) / 0.062) ** 2 - ((1 - towards) / 0.55) ** 2)
    first, second, _ = paint.cells(413, v * 34, z * 34 / 0.27, jitter=0.0)
    ridges = step(0.06, 0.20, second - first)
    # cloth
    creased = paint.fbm(414, z * 130 + 9 * v, x * 2.0, y * 2.0, octaves=3)
    diagonal = paint.noise(415, z * 95 + 3.2 * np.sin(2 * np.pi * v), x * 1.4 + z * 14, y * 1.4)
    tight = 0.35 + 0.65 * np.exp(-((z - ELBOW) / 0.055) ** 2) + 0.5 * np.exp(-((z - 0.055) / 0.02) ** 2)
    height = (0.00018 * creased + 0.00035 * diagonal) * tight * on_arm * (1 - 0.6 * patch) + 0.000022 * fine * (1 - patch)
    height = height + 0.00045 * patch + 0.00030 * patch * ridges - 0.00055 * groove + 0.00022 * thread + 0.0003 * piping
    height = height - 0.0006 * bump(z - 0.0265, 0.0012) * (1 - inside)  # the cuff's stitched hem
    cuff = step(0.0478, 0.0465, z)
    grip = np.clip(np.sin(z * 2 * np.pi / 0.0042), 0, 1) * step(0.028, 0.031, z) * step(0.046, 0.043, z)  # ribs of the cuff
    height = height + 0.0004 * grip
    c = mix(rgb('#2b3238'), rgb('#38424a'), step(-0.45, 0.6, wear))
    c = mix(c, rgb('#1d5a75') * (1 + 0.12 * wear)[..., None], 0.92 * stripe)
    c = mix(c, rgb('#5c7482'), 0.7 * piping)
    c = mix(c, rgb('#1b2024') * (1 + 0.1 * wear)[..., None], np.maximum(0.85 * cuff, 0.9 * patch))
    c = mix(c, rgb('#30373d'), 0.6 * patch * ridges)
    c = mix(c, rgb('#27708d'), 0.9 * step(0.0205, 0.0212, z) * step(0.0252, 0.0245, z) * (1 - inside))  # the band
    c = mix(c, rgb('#0d0f11'), 0.75 * groove)
    c = mix(c, rgb('#7e8d94'), 0.55 * thread)
    c = c * (1 + 0.05 * fine + 0.10 * creased * tight * on_arm)[..., None]
    c = c * (1 - 0.8 * inside)[..., None]
    rough = np.clip(0.60 + 0.05 * fine - 0.10 * patch - 0.06 * stripe + 0.04 * wear, 0.35, 0.8)
    # metres that a texel spans along u: the length of the rings' profile, of which the hem runs across, per u
    along = np.interp(u[0], 0.5 * (rows_u[1:] + rows_u[:-1]), np.hypot(np.diff(rows[:, 0]), np.diff(rows[:, 1])) / np.diff(rows_u)) / WIDTH
    normal = paint.normal_map(height * (1 - inside), along[None, :], around / HEIGHT)
    return np.clip(c, 0, 1), normal, np.stack([np.ones_like(u), rough, 0 * u], -1)


def write(folder, names):
    right = sleeve()
    colour, normal, gloss = pictures()
    encoded = paint.jpeg(colour, 90), paint.jpeg(normal, 88), paint.jpeg(paint.shrink(gloss, 4), 90)
    for name in names:
        part = right
        if name == 'arm_left':
            part = mirrored(right)
            part.joints, part.weights = right.joints, right.weights
        glb = Glb()
        glb.material('wetsuit', *(glb.texture(each) for each in encoded), metal=0.0)
        # all are children of the first joint: the program that poses them sets the place of each in the world
        nodes, binds = [], np.tile(np.eye(4), (len(JOINTS), 1, 1))
        for k, (joint, z) in enumerate(JOINTS):
            nodes.append(glb.node(joint, nodes[0] if nodes else None, [0, 0, z]))
            binds[k, 2, 3] = -z
        skin = glb.skin(nodes, binds, nodes[0])
        glb.node(name, mesh=glb.mesh(name, [glb.primitive(part, 0)]), skin=skin)
        yield name, glb.save(folder / f'{name}.glb'), len(part.triangles), len(part.positions)
