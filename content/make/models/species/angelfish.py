"""Emperor angelfish, Pomacanthus imperator: a tall disc, blue-violet with fine yellow lines, dark mask, yellow tail."""

import numpy as np

import paint
from animal import Animal
from body import Body
from eyes import fish_eye
from fins import median_fin, membrane, paired_fin, tail_fin, with_mirror
from motion import flap, thrash, wave
from paint import bump, line, mix, rgb, step
from skin import Skin

LENGTH, END = 0.25, 0.80
EYE = (0.138, 0.072, 0.0245)
BLUE, NIGHT, YELLOW, SKY = '#20308f', '#0d1030', '#ffdd3a', '#4a9cf5'


def displace(s, h, v):
    gill = 0.006 * bump(s - 0.23, 0.05) * bump(v - 0.55, 0.25)
    socket = 0.005 * bump(np.hypot(s - EYE[0], h - EYE[1]), 0.032)
    lips = 0.010 * bump(s - 0.012, 0.012) * bump(v - 0.5, 0.5)
    return gill + socket + lips


def make_body():
    return Body(
        LENGTH, END,
        upper=[(0, 0.0), (0.015, 0.026), (0.05, 0.080), (0.10, 0.155), (0.16, 0.222), (0.24, 0.274), (0.34, 0.300),
               (0.46, 0.290), (0.58, 0.245), (0.68, 0.165), (0.75, 0.090), (END, 0.072)],
        lower=[(0, -0.010), (0.015, -0.034), (0.05, -0.070), (0.10, -0.124), (0.16, -0.182), (0.24, -0.238),
               (0.34, -0.268), (0.46, -0.272), (0.58, -0.232), (0.68, -0.150), (0.75, -0.082), (END, -0.068)],
        width=[(0, 0.0), (0.015, 0.022), (0.05, 0.040), (0.10, 0.056), (0.16, 0.068), (0.24, 0.078), (0.34, 0.080),
               (0.46, 0.072), (0.58, 0.055), (0.68, 0.035), (0.75, 0.019), (END, 0.003)],
        widest=[(0, 0.5), (0.15, 0.44), (0.3, 0.42), (END, 0.5)], keel=1.3, displace=displace)


def smooth_least(a, b, k):
    """The smaller of two distances, rounded where they meet."""
    t = np.maximum(k - np.abs(a - b), 0) / k
    return np.minimum(a, b) - t * t * k / 4


def lines_of(s, h):
    """1 on a yellow line. Lines start behind the gill, rise a little towards the back's rear and meet the tail."""
    bend = h - 0.03 + 0.16 * (s - 0.30) * step(-0.05, 0.30, h) + 0.10 * (s - 0.3) * step(0.0, -0.3, h) * -1
    squeeze = bend / (1 - 0.30 * step(0.35, 0.80, s))
    t = squeeze / 0.0225 + 0.20 * paint.noise(41, s * 9, h * 6) + 0.05 * paint.noise(42, s * 24, h * 24)
    f = np.abs(t % 1.0 - 0.5)
    return 1 - step(0.15, 0.22, f)


def paint_body(body, pectoral):
    skin = Skin(body)
    at = skin.at
    tone = paint.fbm(51, at.s * 7, at.h * 7, octaves=3)
    skin.colour = mix(rgb(BLUE), rgb('#3a2f8c'), step(-0.4, 0.6, tone) * 0.6)
    skin.tint('#1d57b5', 0.35 * step(0.35, 0.8, at.v))
    skin.tint('#17205f', 0.5 * step(0.30, 0.0, at.v))
    trunk = step(0.27, 0.31, at.s + 0.10 * (at.h - 0.02))
    skin.tint(YELLOW, 0.93 * lines_of(at.s, at.h) * trunk)
    skin.tint('#e9d45a', 0.7 * step(0.745, 0.79, at.s))
    # head: pale throat and snout, dark mask through the eye edged in bright blue, a dark bar behind the gill
    head = skin.curve([(-0.30, 0.255), (-0.15, 0.232), (0.0, 0.250), (0.10, 0.252), (0.22, 0.235), (0.30, 0.215)])
    face = step(0.004, -0.010, head)
    skin.tint('#3b56b8', 0.95 * face)
    skin.tint('#c9d2da', 0.92 * face * step(0.065, 0.02, at.s + 0.25 * np.abs(at.h + 0.01)))
    skin.tint('#8fa6dc', 0.55 * face * step(-0.06, -0.20, at.h))
    forehead = face * step(0.08, 0.14, at.h + 0.2 * at.s)
    skin.tint('#7f93cf', 0.55 * forehead)
    mask = skin.curve([(-0.06, 0.155), (0.0, 0.118), (0.06, 0.112), (0.12, 0.122), (0.20, 0.160), (0.28, 0.220)])
    back = skin.curve([(-0.06, 0.168), (0.0, 0.172), (0.06, 0.168), (0.12, 0.176), (0.20, 0.212), (0.28, 0.262)])
    inside = np.minimum(mask, -back)
    inside = smooth_least(inside, (at.h + 0.055) * 0.6, 0.02)
    skin.tint(SKY, 0.95 * step(-0.0105, -0.0075, inside))
    skin.tint(NIGHT, 0.97 * step(-0.003, 0.001, inside))
    bar = np.minimum(head - 0.002, -(head - 0.062 - 0.02 * bump(at.h + 0.03, 0.10)))
    bar = smooth_least(bar, (0.13 - at.h) * 0.45, 0.03)
    skin.tint('#3f7fe0', 0.9 * step(-0.0085, -0.006, bar))
    skin.tint('#0b0d26', 0.96 * step(-0.002, 0.002, bar))
    skin.scales(58, 0.00013, 0.35 + 0.65 * step(0.15, 0.22, at.s), edge=0.20, variety=0.16, metal=0.20)
    skin.mottle(53, 0.05, 0.07)
    skin.gill([(-0.20, 0.205), (-0.10, 0.236), (0.0, 0.252), (0.08, 0.248), (0.14, 0.225)], dark=0.30)
    skin.gill([(-0.14, 0.150), (-0.075, 0.182), (0.0, 0.190), (0.05, 0.182)], dark=0.15, relief=0.002)
    # the cheek spine of its family
    spine = np.hypot(np.maximum(np.abs(at.s - 0.215) - 0.028, 0), (at.h + 0.128 + 0.2 * (at.s - 0.215)) * 1.0)
    skin.tint('#9db8ea', 0.6 * line(spine, 0.0025, 0.003))
    skin.height += 0.0006 * bump(spine, 0.005)
    skin.lateral_line([(0.26, 0.13), (0.40, 0.205), (0.55, 0.185), (0.68, 0.10), (0.76, 0.03), (0.79, 0.01)], 0.10)
    skin.iridescence(54, ('#5a4fd0', '#2b8fd8'), 0.25, 1 - trunk * 0.5)
    skin.mottle(55, 0.02, 0.10)
    skin.socket(EYE[0], EYE[1], EYE[2], '#07081a', 0.7)
    skin.mouth((0.042, -0.024), tip_h=-0.006, droop=0.002, width=0.0022, lip=0.008, lip_colour='#dfe4e6')
    skin.nostril(0.085, 0.052, 0.003)
    skin.countershade(0.80, 1.12)
    skin.grain()
    skin.beneath_fin(pectoral)
    return skin.pictures()


def fin_paint(kind, rays, spiny=0.0, seed=1):
    def picture(a, b):
        clear = dict(pectoral=0.14, dorsal=0.86, tail=0.66).get(kind, 0.80)
        ray, alpha = membrane(a, b, rays, spiny, clear, 0.95, seed, 0.07)
        wob = 0.02 * paint.noise(seed, a * rays, b * 4)
        if kind == 'dorsal':
            stripes = 1 - step(0.13, 0.24, np.abs((b * 4.2 - a * 5.5 + 0.5) % 1.0 - 0.5))
            colour = mix(rgb('#27318f'), rgb(YELLOW), 0.85 * stripes * step(0.85, 0.55, b))
            colour = mix(colour, rgb('#e8a53a'), 0.75 * step(0.60, 0.95, a) * step(0.2, 0.6, b))
            colour = mix(colour, rgb('#58b4f2'), 0.8 * step(0.91, 0.945, b + wob))
        elif kind == 'anal':
            stripes = 1 - step(0.10, 0.2, np.abs((b * 5.0) % 1.0 - 0.5))
            colour = mix(rgb('#131a55'), rgb('#3f86dd'), 0.8 * stripes)
            colour = mix(colour, rgb('#4fb0f5'), 0.85 * step(0.90, 0.94, b + wob))
        elif kind == 'tail':
            colour = mix(rgb('#e7c935'), rgb('#f7e680'), step(0.2, 1.0, b))
            colour = mix(colour, rgb('#c98d12'), 0.45 * ray)
        elif kind == 'pelvic':
            colour = mix(rgb('#1c2a7c'), rgb('#4f9be8'), step(0.25, 0.0, a) * 0.8)
        else:
            colour = mix(rgb('#b9a87a'), rgb('#d9d0a8'), b) * np.ones(a.shape + (3,))
            colour = mix(colour, rgb('#2a2c50'), step(0.25, 0.0, b))
        colour = mix(colour, colour * 0.62, 0.55 * ray)
        return colour, alpha, 0.00028 * ray
    return picture


def make():
    body = make_body()
    dorsal = median_fin(
        body, 'dorsal', 'upper', 0.25, 0.765,
        lengths=[(0, 0.015), (0.06, 0.045), (0.30, 0.070), (0.55, 0.085), (0.75, 0.120), (0.86, 0.165), (0.93, 0.150),
                 (1, 0.050)],
        leans=[(0, 0.55), (0.4, 0.75), (0.75, 1.00), (0.9, 1.15), (1, 1.25)], tile=(0.02, 0.02, 0.96, 0.24),
        ripple=0.0015, waves=2.0, paint=fin_paint('dorsal', 34, 0.5, 2))
    anal = median_fin(
        body, 'anal', 'lower', 0.46, 0.762,
        lengths=[(0, 0.02), (0.10, 0.055), (0.45, 0.095), (0.75, 0.145), (0.88, 0.150), (1, 0.045)],
        leans=[(0, 0.5), (0.5, 0.85), (0.8, 1.1), (1, 1.25)], tile=(0.02, 0.29, 0.56, 0.22), ripple=0.0012, waves=1.5,
        columns=17, paint=fin_paint('anal', 22, 0.18, 4))
    tail = tail_fin(
        body, lengths=[(0, 0.180), (0.1, 0.192), (0.5, 0.200), (0.9, 0.192), (1, 0.180)], spread=0.36,
        tile=(0.62, 0.29, 0.36, 0.32), ripple=0.0015, waves=1.2, columns=15, paint=fin_paint('tail', 17, 0, 6))
    pectoral = paired_fin(
        body, 'pectoral', 0.278, (-0.040, -0.095),
        lengths=[(0, 0.070), (0.12, 0.135), (0.3, 0.158), (0.6, 0.150), (0.85, 0.100), (1, 0.035)],
        first=(0.55, 0.50, -0.75), last=(0.45, -0.90, -0.40), tile=(0.02, 0.55, 0.42, 0.26), bend=(0, 0, -0.006),
        joint='pectoral_left', slant=0.012, columns=13, flesh=0.010, paint=fin_paint('pectoral', 17, 0, 8))
    pelvic = paired_fin(
        body, 'pelvic', 0.32, (-0.238, -0.254), lengths=[(0, 0.170), (0.3, 0.160), (1, 0.06)],
        first=(0.16, -0.80, -0.58), last=(0.12, -0.40, -0.92), tile=(0.50, 0.66, 0.34, 0.30), slant=0.045,
        columns=11, paint=fin_paint('pelvic', 6, 0.16, 10))
    beat = (0.15, 1.0, 0.30)
    clips = [
        dict(name='swim', duration=1.2, keys=28, lateral=wave(0.50, 1.1), fins=flap(beat, 2, 0.60, 0.15),
             lift=lambda p: 0.0018 * np.sin(4 * np.pi * p), roll=lambda p: 0.03 * np.sin(2 * np.pi * p)),
        dict(name='dart', duration=0.48, keys=20, lateral=wave(1.2, 1.0), fins=flap(beat, 1, 0.12, 0.45)),
        dict(name='struggle', duration=0.9, keys=32, lateral=thrash(0.8), fins=flap(beat, 6, 0.55),
             roll=lambda p: 0.30 * np.sin(2 * np.pi * 3 * p + 0.4))]
    return Animal('angelfish', body, [dorsal, anal, tail, *with_mirror(pectoral), *with_mirror(pelvic)],
                  EYE, fish_eye('#4a3414', '#e0ac44'), paint_body(body, pectoral), clips)
