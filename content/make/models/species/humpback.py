"""Humpback whale, Megaptera novaeangliae: knobbed head, grooved throat, flippers a third as long as the body, flukes that beat up
and down."""

import numpy as np

import paint
from animal import Animal
from body import Body
from eyes import fish_eye
from fins import Fin, median_fin, paired_fin, with_mirror
from mesh import Curve, quaternion, unit
from motion import wave
from paint import bump, line, mix, rgb, step
from skin import Skin

LENGTH, END = 12.0, 0.90
EYE = (0.205, -0.030, 0.0042)
KNOBS = [(0.020 + 0.034 * k, 0.20 + 0.10 * (k % 3), 0.0055) for k in range(6)] + [(0.05 + 0.04 * k, 0.02, 0.006) for k in range(4)]


def displace(s, h, v):
    brow = 0.004 * bump(s - EYE[0], 0.035) * bump(v - 0.52, 0.07)
    chin = 0.006 * bump(s - 0.035, 0.03) * bump(v - 0.95, 0.15)
    jaw = 0.007 * bump(v - 0.50 - 0.10 * s, 0.03) * step(0.21, 0.15, s)
    return brow + chin + jaw


def make_body():
    return Body(
        LENGTH, END,
        upper=[(0, 0.0), (0.02, 0.020), (0.07, 0.034), (0.14, 0.046), (0.22, 0.062), (0.34, 0.080), (0.46, 0.078), (0.60, 0.060),
               (0.70, 0.044), (0.80, 0.027), (0.86, 0.018), (END, 0.014)],
        lower=[(0, -0.012), (0.02, -0.036), (0.07, -0.060), (0.14, -0.078), (0.22, -0.092), (0.34, -0.104), (0.46, -0.096),
               (0.60, -0.068), (0.70, -0.046), (0.80, -0.026), (0.86, -0.018), (END, -0.014)],
        width=[(0, 0.0), (0.02, 0.030), (0.07, 0.052), (0.14, 0.068), (0.22, 0.080), (0.34, 0.092), (0.46, 0.086), (0.60, 0.060),
               (0.70, 0.040), (0.80, 0.022), (0.86, 0.014), (END, 0.009)],
        widest=[(0, 0.5), (0.10, 0.42), (0.3, 0.50), (END, 0.5)], displace=displace)


BACK, BELLY = '#27313a', '#d8dcd6'


def paint_body(body):
    skin = Skin(body, 1024, 576)
    at, arc = skin.at, skin.at.arc
    tone = paint.fbm(611, at.s * 12, arc * 12, octaves=4)
    skin.colour = mix(rgb('#37434d'), rgb(BACK), step(-0.35, 0.35, tone))
    skin.mottle(612, 0.06, 0.14)
    skin.mottle(613, 0.012, 0.08)
    # the belly, blotched
    border = at.v - 0.80 + 0.10 * paint.fbm(614, at.s * 14, arc * 14, octaves=4) + 0.25 * step(0.45, 0.60, at.s)
    skin.tint(BELLY, 0.85 * step(-0.02, 0.05, border))
    # grooves from the chin to the navel
    throat = step(0.56, 0.60, at.v) * step(0.52, 0.44, at.s) * step(0.015, 0.04, at.s)
    groove = 0.5 + 0.5 * np.cos(2 * np.pi * at.v * 44 + 0.5 * paint.noise(615, at.s * 20))
    cut = step(0.35, 0.0, groove) * throat
    skin.height += LENGTH * 0.0026 * (groove - 0.5) * throat
    skin.tint('#10161b', 0.70 * cut)
    # knobs of head and jaw, each with a hair
    for s0, v0, r in KNOBS + [(0.03 + 0.03 * k, 0.60 + 0.02 * (k % 2), 0.005) for k in range(5)]:
        a0 = np.interp(v0, at.v[:, 0], arc[:, int(body.u_of(s0) * 1023)])
        d = np.hypot(at.s - s0, arc - a0)
        skin.height += LENGTH * 0.0036 * bump(d, r)
        skin.shade(1 + 0.22 * bump(d, r))
    # the mouth: from the snout's tip down behind the eye
    t = np.clip(at.s / 0.215, 0, 1)
    lip = at.h + 0.006 + 0.030 * t + 0.016 * np.sin(np.pi * t) * -1 + 0.018 * step(0.8, 1.0, t)
    mouth = step(0.220, 0.210, at.s)
    skin.tint('#0a0d10', 0.85 * line(lip, 0.0008, 0.0016) * mouth)
    skin.height -= LENGTH * 0.0012 * bump(lip, 0.0022) * mouth
    # barnacles and the pale rings they leave; scratches
    for k in range(90):
        s0, a0 = 0.01 + 0.55 * paint.scatter(616, k) ** 2, -0.12 + 0.26 * paint.scatter(617, k)
        d = np.hypot(at.s - s0, arc - a0)
        r = 0.0016 + 0.0022 * paint.scatter(618, k)
        skin.tint('#c8c6b6', (0.75 if k % 3 else 0.35) * line(d - (0 if k % 3 else r), r * 0.5, r * 0.5))
        if k % 3:
            skin.height += LENGTH * 0.0012 * bump(d, r)
    for k in range(26):
        s0, a0, angle = 0.15 + 0.6 * paint.scatter(621, k), -0.09 + 0.18 * paint.scatter(622, k), 1.2 * paint.scatter(623, k) - 0.6
        x, y = at.s - s0, arc - a0
        along, off = x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
        skin.tint('#8f9aa0', 0.5 * bump(off, 0.0008) * step(0.06, 0.02, np.abs(along)))
    fine = paint.noise(624, at.s * 300, arc * 300)
    skin.height += 0.002 * fine + 0.006 * paint.fbm(625, at.s * 40, arc * 90, octaves=3)
    skin.shade(1 + 0.03 * fine)
    skin.socket(EYE[0], EYE[1], EYE[2], '#0c1013', 0.7)
    skin.countershade(0.86, 1.03)
    skin.rough[:] = 0.42 + 0.05 * fine
    return skin.pictures()


def fin_paint(seed, pale):
    """Dark, or the pale underside with a dark, ragged edge."""
    def picture(a, b):
        grain = paint.fbm(seed, a * 10, b * 10, octaves=4)
        fine = paint.noise(seed + 1, a * 160, b * 160)
        dark = mix(rgb(BACK), rgb('#3a4650'), 0.5 + 0.5 * grain)
        if pale:
            edge = np.maximum(step(0.80, 0.93, b + 0.14 * grain), step(0.12, 0.03, a + 0.06 * grain))
            spots = step(0.30, 0.45, grain) * 0.8
            dark = mix(mix(rgb(BELLY), rgb('#aab2b2'), 0.5 + 0.5 * grain), dark, np.maximum(edge, spots))
        rings = step(0.55, 0.75, paint.noise(seed + 2, a * 26, b * 26)) * step(0.5, 0.9, b)
        return mix(dark, rgb('#b8b8aa'), 0.5 * rings), np.ones(a.shape), 0.004 * grain + 0.002 * fine
    return picture


def flukes(body):
    """A level tail of two pointed halves with a notch between them."""
    a = np.linspace(0, 1, 65)
    s = END - 0.035
    half = float(body.profile('width', s))
    root = np.stack([half * (1 - 2 * a), 0 * a + 0.5 * (body.profile('upper', s) + body.profile('lower', s)), 0.5 - s + 0 * a], -1) * LENGTH
    angle = 1.18 * (1 - 2 * a) * (0.8 + 0.2 * np.abs(1 - 2 * a))
    direction = np.stack([np.sin(angle), 0 * a, -np.cos(angle)], -1)
    reach = Curve([(0, 0.190), (0.06, 0.178), (0.18, 0.142), (0.34, 0.118), (0.47, 0.104), (0.5, 0.092), (0.53, 0.104), (0.66, 0.118),
                   (0.82, 0.142), (0.94, 0.178), (1, 0.190)])(a)
    reach = reach * (1 - s) / np.max(reach * np.cos(angle))
    return Fin('flukes', root, direction, reach * LENGTH, (0.012, 0.655, 0.40, 0.160), fin_paint(631, False),
               thickness=0.017 * LENGTH, foil='lens', columns=25, rows=7, under=(0.012, 0.832, 0.28, 0.150),
               paint_under=fin_paint(634, True))


def make():
    body = make_body()
    dorsal = median_fin(body, 'dorsal', 'upper', 0.625, 0.70, lengths=[(0, 0.004), (0.45, 0.022), (0.75, 0.026), (1, 0.012)],
                        leans=[(0, 0.7), (1, 1.35)], tile=(0.430, 0.655, 0.25, 0.160), sink=0.012, thickness=0.008, columns=8, rows=4,
                        foil='wing', paint=fin_paint(637, False))
    flipper = paired_fin(body, 'flipper', 0.270, (-0.036, -0.058),
                         lengths=[(0, 0.300), (0.10, 0.305), (0.16, 0.290), (0.30, 0.262), (0.38, 0.268), (0.55, 0.190), (0.8, 0.085), (1, 0.040)],
                         first=(0.72, -0.44, -0.54), last=(0.42, -0.26, -0.87), tile=(0.70, 0.655, 0.28, 0.160), slant=0.050,
                         sink=0.014, thickness=0.012, joint='pectoral_left', paint=fin_paint(640, False), columns=13, rows=8,
                         foil='wing', under=(0.32, 0.832, 0.28, 0.150), paint_under=fin_paint(643, True))

    def steer(rest, swing):
        def clip(phase):
            left = quaternion(unit([0, 0.25, 1]), rest + swing * np.sin(2 * np.pi * phase + 0.8))
            return {'pectoral_left': left, 'pectoral_right': left * [1, -1, -1, 1]}
        return clip

    def beat(size):
        return lambda s, phase: -wave(size, 1.35)(s, phase)
    clips = [dict(name='swim', duration=1.6, keys=32, lateral=beat(0.75), upright=False, fins=steer(0.0, 0.10)),
             dict(name='dart', duration=1.2, keys=32, lateral=beat(1.0), upright=False, fins=steer(0.1, 0.12)),
             dict(name='struggle', duration=1.2, keys=32, lateral=beat(1.0), upright=False, fins=steer(0.1, 0.2))]
    return Animal('humpback', body, [dorsal, flukes(body), *with_mirror(flipper)], EYE, fish_eye('#3a2c22', '#57483a', 0.55),
                  paint_body(body), clips, height=1024, rings=46, around=21, thick_fins=True, fin_rough=0.45)
