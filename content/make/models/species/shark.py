"""Grey reef shark, Carcharhinus amblyrhynchos: grey-bronze above, white below, a jaw that opens, teeth."""

import numpy as np

import paint
from animal import Animal
from body import Body
from eyes import slit_eye
from fins import median_fin, paired_fin, tail_fin, with_mirror
from mesh import Part, facing, grid_triangles, join, mirrored, quaternion, tangent_frame, unit, without_slivers
from motion import wave
from paint import bump, line, mix, rgb, step
from skin import Skin

LENGTH, END = 1.8, 0.775
EYE = (0.088, 0.002, 0.0078)
MOUTH_FRONT, MOUTH_CORNER, CORNER_V = 0.066, 0.118, 0.70
HINGE = (0.128, -0.018)  # s, h
MOUTH_RING = 14


def displace(s, h, v):
    brow = 0.003 * bump(s - EYE[0], 0.03) * bump(v - 0.40, 0.08)
    gills = 0.002 * bump(s - 0.215, 0.05) * bump(v - 0.58, 0.18)
    return brow + gills


def mouth_s(v):
    """Returns s of the mouth at V; above the mouth's corner the line goes on as a plain ring."""
    t = np.clip((1 - v) / (1 - CORNER_V), 0, 1)
    return MOUTH_FRONT + (MOUTH_CORNER - MOUTH_FRONT) * t ** 1.7


class SharkBody(Body):
    def grid(self, rings, around):
        """U and V of the left side's vertices; the ring MOUTH_RING bends along the mouth, those near it follow."""
        ring_u = np.linspace(0, 1, rings)
        # a mouth corner ring among the evenly spaced ones
        base = self.u_of(MOUTH_CORNER)
        head = np.linspace(0, 1, MOUTH_RING + 1) * base
        rest = base + (1 - base) * np.linspace(0, 1, rings - MOUTH_RING)[1:]
        ring_u = np.concatenate([head, rest])
        v = np.linspace(0, 1, around)
        k = np.argmin(np.abs(v - CORNER_V))
        v = v + (CORNER_V - v[k]) * bump(v - v[k], 0.1)
        target = self.u_of(mouth_s(v))
        j = np.arange(rings)[:, None]
        ahead = ring_u[:, None] * (target / base)[None]
        fade = step(18, 0, j - MOUTH_RING)
        behind = ring_u[:, None] + (target - base)[None] * fade
        u = np.where(j <= MOUTH_RING, ahead, behind)
        return u, np.broadcast_to(v, u.shape), int(k)

    def jaw(self, s, v):
        """How much skin behind the mouth follows the jaw."""
        return step(CORNER_V, CORNER_V + 0.10, v) * step(HINGE[0] + 0.055, HINGE[0] - 0.01, s)

    def part(self, rings, around):
        u, v, corner = self.grid(rings, around)
        du, dv = self.derivatives(u, v)
        n = -np.cross(du, dv)
        n[:, [0, -1], 0] = 0
        n = unit(n)
        n[0] = unit(np.mean(n[1], 0) * [0, 1, 1])
        p, t = self.point(u, v), tangent_frame(n, du, -dv)
        jaw = np.where(np.arange(rings)[:, None] > MOUTH_RING, self.jaw(self.s_of(u), v), 0.0)
        triangles = grid_triangles(rings, around)
        # the lower lip: the mouth ring once more, for the rows behind it
        lower = np.arange(corner + 1, around)
        new = rings * around + np.arange(len(lower))
        rename = np.arange(rings * around + len(lower))
        rename[MOUTH_RING * around + lower] = new
        behind = triangles.max(1) >= (MOUTH_RING + 1) * around
        triangles = np.where(behind[:, None], rename[triangles], triangles)

        def doubled(a):
            return np.concatenate([a.reshape(rings * around, -1), a[MOUTH_RING, lower].reshape(len(lower), -1)])
        uv = doubled(np.stack([u, v], -1))
        left = Part(doubled(p), doubled(n), doubled(t), uv, triangles)
        left = facing(without_slivers(left))
        jaw = np.concatenate([jaw.reshape(-1), self.jaw(self.s_of(uv[new, 0]), uv[new, 1])])
        whole = join([left, mirrored(left)])
        whole.follow = {'jaw': np.concatenate([jaw, jaw])}
        return whole

    def lips(self, count):
        """Points along the mouth from the left corner over the front to the right one, and their jaw weights."""
        v = np.concatenate([np.linspace(CORNER_V, 1, count), np.linspace(1, CORNER_V, count)[1:]])
        side = np.concatenate([np.ones(count), -np.ones(count - 1)])
        u = self.u_of(mouth_s(v))
        p = self.point(u, v)
        p[:, 0] *= side
        return p, self.jaw(mouth_s(v), v)


def mouth_inside(body):
    """A pouch behind the lips: palate, floor and throat."""
    lip, jaw = body.lips(13)
    throat = np.array([0, HINGE[1] * LENGTH, (0.5 - HINGE[0] - 0.03) * LENGTH])
    rows, jaws = [], []
    for t in (0.0, 0.12, 0.35, 0.7, 1.0):  # along the palate to the throat
        lift = np.array([0, 0.022, 0]) * np.sin(np.pi * min(t * 1.4, 1)) ** 0.7
        rows.append(lip * (1 - t) + (throat + [0, 0.006, 0]) * t + lift * (1 - t * 0.5))
        jaws.append(0 * jaw + 0.25 * t * t)
    for t in (1.0, 0.7, 0.35, 0.12, 0.0):  # and along the floor back to the lower lip
        drop = np.array([0, 0.006, 0]) * np.sin(np.pi * t)
        rows.append(lip * (1 - t) + (throat - [0, 0.004, 0]) * t + drop)
        jaws.append(jaw * (1 - 0.5 * t * t) * (1 - t) + 0.25 * t * t)
    p, jaw = np.stack(rows), np.stack(jaws)
    dv, du = np.gradient(p, axis=0), np.gradient(p, axis=1)
    n = np.cross(dv, du)
    n = unit(np.where(np.linalg.norm(n, axis=-1, keepdims=True) < 1e-12, [0.0, 0, 1], n))  # the throat is one point
    n = n * -np.sign(n[1:4, ..., 1].mean())  # seen from inside: the palate looks down
    r, c = p.shape[:2]
    depth = np.repeat([0.0, 0.25, 0.6, 0.9, 1, 1, 0.9, 0.55, 0.2, 0.0], c)
    flat = np.tile([0.5, 0.5], (r * c, 1))
    flat[:, 1] = depth
    part = facing(without_slivers(Part(
        p.reshape(-1, 3), n.reshape(-1, 3), tangent_frame(n, *np.gradient(p, axis=(1, 0))).reshape(-1, 4), flat,
        grid_triangles(r, c))))
    part.follow = {'jaw': jaw.reshape(-1)}
    return part


def mouth_picture():
    """Gums to throat, downwards."""
    depth = np.linspace(0, 1, 32)[:, None] * np.ones((1, 24))
    gums = mix(rgb('#a8615c'), rgb('#5a211f'), step(0.02, 0.22, depth))
    return mix(gums, rgb('#0c0404'), step(0.16, 0.50, depth))


def teeth(body):
    lip, jaw = body.lips(60)
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(lip, axis=0), axis=1))])
    parts, jaws = [], []
    # the rows in use, above and below, and behind them the rows that will replace them
    for count, size, inward, upper, behind in ((24, 0.0175, 0.0135, True, 0.0), (23, 0.0140, 0.0035, False, 0.0),
                                               (14, 0.0120, 0.0150, True, 0.011), (11, 0.0105, 0.0010, False, 0.011)):
        for k in range(count):
            where = along[-1] * (0.06 + 0.88 * (k + 0.5) / count)
            c = np.array([np.interp(where, along, lip[:, i]) for i in range(3)])
            ahead = np.array([np.interp(where + 1e-3, along, lip[:, i]) for i in range(3)])
            across = unit(ahead - c)
            inner = unit(np.array([0, -0.01, (0.5 - 0.13) * LENGTH]) - c)
            up = unit(np.array([0, 1.0, 0]) - inner * 0.0)
            grade = 0.65 + 0.35 * np.sin(np.pi * (k + 0.5) / count)
            tall, wide = size * grade * (0.92 + 0.16 * paint.scatter(8, k)), 0.0064 * grade * (1 if upper else 0.72)
            if upper:
                root = c + inner * (0.005 + behind) + up * (inward + 0.001 * paint.scatter(7, k))
                tip = root - up * tall + inner * 0.004 + across * 0.003 * np.sign(k - count / 2)
            else:
                root = c + inner * (0.006 + behind) + up * 0.0005
                tip = root + up * tall * 0.8 + inner * 0.002
            deep = inner * 0.0022
            points = np.array([root - across * wide - deep, root + across * wide - deep, root + across * wide + deep,
                               root - across * wide + deep, tip])
            faces = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
            out = unit(points - points.mean(0))
            parts.append(facing(Part(points, out, tangent_frame(out, np.broadcast_to(across, out.shape),
                                                                np.broadcast_to(up, out.shape)),
                                     np.array([[0.5, 0.08]] * 4 + [[0.5, 0.92]]), faces)))
            jaws.append(np.full(5, 0.0 if upper else np.interp(where, along, jaw)))
    whole = join(parts)
    whole.follow = {'jaw': np.concatenate(jaws)}
    return whole


def make_body():
    return SharkBody(
        LENGTH, END,
        upper=[(0, 0.0), (0.015, 0.013), (0.05, 0.028), (0.10, 0.045), (0.17, 0.065), (0.26, 0.083), (0.35, 0.088),
               (0.46, 0.075), (0.58, 0.050), (0.68, 0.031), (0.74, 0.024), (END, 0.025)],
        lower=[(0, -0.006), (0.015, -0.018), (0.05, -0.027), (0.10, -0.037), (0.17, -0.053), (0.26, -0.070),
               (0.35, -0.074), (0.46, -0.062), (0.58, -0.040), (0.68, -0.023), (0.74, -0.017), (END, -0.016)],
        width=[(0, 0.0), (0.015, 0.026), (0.05, 0.044), (0.10, 0.056), (0.17, 0.066), (0.26, 0.073), (0.35, 0.072),
               (0.46, 0.058), (0.58, 0.037), (0.68, 0.021), (0.74, 0.014), (END, 0.004)],
        widest=[(0, 0.45), (0.10, 0.40), (0.25, 0.42), (0.5, 0.5), (END, 0.5)], displace=displace)


GREY, DARK, PALE = '#75807f', '#414b4d', '#f1f2ed'


def scars(skin, arc):
    """Scratches, and two crescents of tooth marks such as sharks leave on each other; pale, with a dark rim."""
    at = skin.at
    marks = np.zeros_like(at.s)
    for k in range(16):
        s0, a0 = 0.14 + 0.52 * paint.scatter(131, k), -0.055 + 0.10 * paint.scatter(132, k)
        angle, long = 2.6 * paint.scatter(133, k) - 1.3, 0.010 + 0.030 * paint.scatter(134, k) ** 2
        x, y = at.s - s0, arc - a0
        along, off = x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
        off = off + 1.5 * along * along / long * (paint.scatter(135, k) - 0.5)
        marks = np.maximum(marks, bump(off, 0.00075) * step(long, 0.6 * long, np.abs(along)) * (0.5 + 0.5 * paint.scatter(136, k)))
    for s0, a0, radius, turn in ((0.30, -0.020, 0.030, 0.3), (0.46, 0.006, 0.022, 2.4)):
        for k in range(11):
            angle = turn + (k - 5) * 0.21
            d = np.hypot(at.s - s0 - radius * np.cos(angle), arc - a0 - radius * np.sin(angle))
            marks = np.maximum(marks, 0.9 * bump(d, 0.0011 + 0.0006 * paint.scatter(137, k)))
    skin.tint('#2c3436', 0.35 * step(0.02, 0.25, marks) * step(0.6, 0.3, marks))
    skin.tint('#c9c4bb', 0.62 * step(0.3, 0.8, marks))
    skin.height -= LENGTH * 0.0007 * marks


def paint_body(body):
    skin = Skin(body, 1024, 576)
    at = skin.at
    arc = at.arc
    tone = paint.fbm(111, at.s * 10, at.v * 6, octaves=4)
    wave_line = 0.60 + 0.035 * np.sin(at.s * 17) + 0.02 * tone - 0.10 * step(0.14, 0.0, at.s) + 0.04 * step(0.6, 0.75, at.s)
    skin.colour = mix(rgb(GREY), rgb(DARK), step(0.46, 0.04, at.v + 0.07 * tone))
    skin.tint('#8b8a7c', 0.40 * bump(at.v - 0.47, 0.09))
    # dapples of the back, larger and paler down the flank
    dapple = paint.fbm(118, at.s * 42, arc * 42, octaves=3)
    skin.shade(1 - 0.20 * step(0.05, 0.40, dapple) * step(0.56, 0.30, at.v))
    skin.shade(1 + 0.16 * step(0.10, 0.45, -dapple) * step(0.12, 0.40, at.v) * step(0.64, 0.52, at.v))
    # the border with the belly, frayed and with islands on either side
    border = at.v - wave_line + 0.020 * paint.fbm(112, at.s * 60, arc * 60, octaves=4) + 0.008 * paint.noise(117, at.s * 230, arc * 230)
    skin.tint(PALE, step(-0.016, 0.020, border))
    # a faint pale wedge on the flank
    wedge = (at.s - 0.50) * 0.55
    skin.tint('#b9bdb8', 0.40 * step(0.0, 0.03, at.s - 0.46) * line(at.v - 0.56 + wedge * 0.2, 0.02, 0.03) * step(0.66, 0.58, at.s))
    skin.mottle(113, 0.10, 0.10)
    skin.mottle(114, 0.02, 0.07)
    skin.mottle(119, 0.006, 0.05)
    # skin teeth too small to see one by one, in rows along the body, and folds of the skin
    grain = paint.noise(115, at.s * 420, arc * 900) + 0.7 * paint.noise(116, at.s * 700, arc * 1500)
    folds = paint.fbm(120, at.s * 26, arc * 150, octaves=3)
    skin.height += 0.00022 * grain + 0.00060 * folds
    skin.shade(1 + 0.040 * grain + 0.05 * folds)
    scars(skin, arc)
    # five gill slits
    for k in range(5):
        s0 = 0.192 + 0.0145 * k
        low, high = 0.41 + 0.014 * k, 0.69 - 0.014 * abs(k - 1.5)
        span = step(low, low + 0.03, at.v) * step(high, high - 0.03, at.v)
        bow = s0 + 0.006 * ((at.v - 0.56) / 0.12) ** 2 * -1 + 0.004
        d = at.s - bow
        skin.height += LENGTH * (0.0022 * bump(d + 0.0035, 0.0035) - 0.0034 * bump(d, 0.0018)) * span
        skin.tint('#0d0c0c', 0.95 * line(d, 0.0010, 0.0016) * span)
        skin.tint('#6b3f3c', 0.35 * bump(d - 0.0022, 0.0010) * span)  # a glimpse of the gill
        skin.shade(0.70, bump(d - 0.0045, 0.004) * span)
        skin.shade(1.16, bump(d + 0.004, 0.0025) * span)
    # nostrils, lips, eyes
    nostril = np.hypot((at.s - 0.045) * 1.0, (at.v - 0.80) * 0.09)
    slant = (at.s - 0.045) - (at.v - 0.80) * 0.05
    skin.tint('#2a2c2c', 0.9 * line(slant, 0.0011, 0.0012) * step(0.075, 0.05, np.abs(at.v - 0.80)))
    skin.height -= LENGTH * 0.0012 * bump(nostril, 0.004)
    lip = at.s - mouth_s(at.v)
    around = step(CORNER_V - 0.03, CORNER_V + 0.01, at.v)
    skin.tint('#a39a94', 0.55 * line(lip, 0.0015, 0.0035) * around)
    skin.tint('#2a1413', 0.85 * line(lip, 0.0006, 0.0014) * around)
    skin.height += LENGTH * 0.0012 * bump(np.abs(lip) - 0.004, 0.0025) * around
    fold = np.hypot(np.maximum(np.abs(at.s - MOUTH_CORNER - 0.006) - 0.008, 0), (at.v - CORNER_V + 0.012) * 0.1)
    skin.tint('#55504e', 0.6 * line(fold, 0.0004, 0.001))
    skin.socket(EYE[0], EYE[1], EYE[2], '#161a1a', 0.9)
    for k in range(130):  # pores that sense electricity, over the snout
        s0, v0 = 0.012 + 0.07 * paint.scatter(122, k) ** 0.8, 0.45 + 0.5 * paint.scatter(123, k)
        d = np.hypot(at.s - s0, (at.v - v0) * 0.10)
        skin.tint('#3a3e3e', 0.6 * line(d, 0.0003, 0.0005))
    skin.countershade(0.80, 1.04)
    skin.rough[:] = 0.46 + 0.04 * grain
    return skin.pictures()


def fin_paint(kind, seed):
    def picture(a, b):
        grain = paint.noise(seed, a * 190, b * 150) + 0.6 * paint.fbm(seed + 1, a * 8, b * 8, octaves=4)
        colour = mix(rgb(DARK), rgb('#727978'), 0.5 + 0.25 * grain)
        fringe = step(0.45, 1.0, a) * 0.10
        if kind == 'tail':
            edge = step(0.80, 0.96, b + 0.03 * grain + 0.10 * step(0.1, 0.6, a))
            colour = mix(colour, rgb('#1b1e1f'), 0.90 * edge)
            # at its root the body's own colours, so that no seam shows
            skin = mix(mix(rgb(GREY), rgb(DARK), step(0.46, 0.04, a)), rgb(PALE), step(0.61, 0.69, a))
            colour = mix(colour, skin * (1 + 0.1 * grain)[..., None], step(0.40, 0.10, b))
        elif kind == 'dorsal':
            colour = mix(colour, rgb('#9aa09c'), 0.5 * step(0.88, 1.0, b + 0.02 * grain) + 0.3 * step(0.93, 1, a))
        else:
            colour = mix(colour, rgb('#23282a'), 0.80 * step(0.80, 0.95, b + 0.06 * grain))
        colour = colour * (1 - fringe * 0.3)[..., None] * (0.92 + 0.08 * step(0, 0.3, b))[..., None]
        cloth = np.sin(a * 110 + 3 * b) * step(0.2, 0.8, b)
        return colour, np.ones(a.shape), 0.0003 * grain + 0.0001 * cloth
    return picture


def under_paint(seed):
    def picture(a, b):
        grain = paint.fbm(seed, a * 14, b * 14, octaves=4)
        colour = mix(rgb(PALE), rgb('#c3c7c2'), 0.5 + 0.5 * grain)
        dusk = np.maximum(step(0.86, 0.94, b + 0.06 * grain), 0.8 * step(0.93, 0.98, a + 0.03 * grain) * step(0.55, 0.8, b))
        return mix(colour, rgb('#2c3133'), 0.8 * dusk), np.ones(a.shape), 0.0002 * grain
    return picture


def jaw_clip(angle):
    return lambda phase: {'jaw': quaternion([1, 0, 0], angle(phase))}


def both(*makers):
    return lambda phase: {k: v for maker in makers for k, v in maker(phase).items()}


def steer(rest, swing):
    def clip(phase):
        left = quaternion([0, 0, 1], rest + swing * np.sin(2 * np.pi * phase + 0.5))
        return {'pectoral_left': left, 'pectoral_right': left * [1, -1, -1, 1]}
    return clip


def make():
    body = make_body()
    t, small = dict(columns=11, rows=6, foil='wing'), dict(columns=8, rows=4, foil='wing')
    first = median_fin(body, 'dorsal', 'upper', 0.315, 0.435,
                       lengths=[(0, 0.128), (0.12, 0.118), (0.3, 0.086), (0.55, 0.052), (0.8, 0.036), (1, 0.034)],
                       leans=[(0, 0.72), (0.3, 0.82), (0.7, 1.15), (1, 1.52)], tile=(0.430, 0.655, 0.25, 0.160), sink=0.016,
                       thickness=0.0075, paint=fin_paint('dorsal', 141), **t)
    second = median_fin(body, 'dorsal2', 'upper', 0.618, 0.668, lengths=[(0, 0.040), (0.3, 0.030), (0.7, 0.018), (1, 0.024)],
                        leans=[(0, 0.85), (0.5, 1.15), (1, 1.52)], tile=(0.62, 0.832, 0.16, 0.150), sink=0.008,
                        thickness=0.004, paint=fin_paint('dark', 143), **small)
    anal = median_fin(body, 'anal', 'lower', 0.625, 0.675, lengths=[(0, 0.044), (0.3, 0.032), (0.7, 0.017), (1, 0.024)],
                      leans=[(0, 0.80), (0.5, 1.1), (1, 1.52)], tile=(0.81, 0.832, 0.16, 0.150), sink=0.008,
                      thickness=0.004, paint=fin_paint('dark', 145), **small)
    tail = tail_fin(body, lengths=[(0, 0.290), (0.05, 0.242), (0.10, 0.200), (0.15, 0.166), (0.20, 0.138), (0.28, 0.104),
                                   (0.38, 0.078), (0.50, 0.064), (0.66, 0.068), (0.80, 0.092), (0.90, 0.115), (0.95, 0.128),
                                   (1, 0.160)],
                    spread=0.76, turn=-0.06, tile=(0.012, 0.655, 0.40, 0.160), overlap=0.045, columns=21, rows=7,
                    thickness=0.016, bend=(0, 0.02, -0.05), reach=0.972, paint=fin_paint('tail', 147))
    tail.flesh = 0.0  # a shark's skin goes on over its tail
    pectoral = paired_fin(body, 'pectoral', 0.232, (-0.034, -0.046), lengths=[(0, 0.190), (0.06, 0.186), (0.25, 0.140),
                                                                             (0.5, 0.088), (0.75, 0.058), (1, 0.050)],
                          first=(0.80, -0.36, -0.62), last=(0.30, -0.16, -0.95), tile=(0.70, 0.655, 0.28, 0.160),
                          slant=0.075, sink=0.016, thickness=0.0075, joint='pectoral_left', paint=fin_paint('dark', 149),
                          under=(0.012, 0.832, 0.28, 0.150), paint_under=under_paint(153), **t)
    pelvic = paired_fin(body, 'pelvic', 0.515, (-0.034, -0.042), lengths=[(0, 0.062), (0.3, 0.055), (0.7, 0.035), (1, 0.034)],
                        first=(0.70, -0.50, -0.55), last=(0.22, -0.15, -0.96), tile=(0.32, 0.832, 0.13, 0.150),
                        slant=0.040, sink=0.010, thickness=0.004, paint=fin_paint('dark', 151),
                        under=(0.47, 0.832, 0.13, 0.150), paint_under=under_paint(155), **small)
    hinge = np.array([0, HINGE[1] * LENGTH, (0.5 - HINGE[0]) * LENGTH])

    def snap(p):  # opens in the first half, closes fast, holds
        return 0.62 * (step(0.05, 0.42, p) - step(0.52, 0.66, p)) + 0.03
    clips = [
        dict(name='cruise', duration=1.6, keys=32, lateral=wave(0.75, 1.05),
             fins=both(steer(0.0, 0.05), jaw_clip(lambda p: 0.05 + 0.02 * np.sin(2 * np.pi * p)))),
        dict(name='lunge', duration=0.6, keys=24, lateral=wave(1.30, 0.95),
             fins=both(steer(-0.10, 0.05), jaw_clip(lambda p: 0.22 + 0.04 * np.sin(2 * np.pi * p)))),
        dict(name='bite', duration=0.8, keys=32, lateral=lambda s, p: wave(0.7, 1.0)(s, p) + 0.05 * (s - 0.3) * np.sin(
            4 * np.pi * p) * bump(p - 0.6, 0.15) * step(0.3, 0, s),
             fins=both(steer(-0.15, 0.04), jaw_clip(snap)))]
    inside, ivory = mouth_picture(), mix(rgb('#8f6258'), rgb('#f3efe3'), step(0.02, 0.30, np.linspace(0, 1, 24)[:, None] * np.ones((1, 24))))
    return Animal('shark', body, [first, second, anal, tail, *with_mirror(pectoral), *with_mirror(pelvic)], EYE,
                  slit_eye('#a8a06c', '#3a3b2c', lid='#b4b6ac'), paint_body(body), clips, height=1024, rings=48, around=21,
                  extra_joints=[('jaw', 0, hinge)], thick_fins=True, fin_rough=0.46,
                  extra_parts=[(mouth_inside(body), inside), (teeth(body), ivory)])
