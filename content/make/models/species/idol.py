"""Moorish idol, Zanclus cornutus: a thin tall disc in black, white and yellow, a tubular snout, a long white streamer."""

import numpy as np

import paint
from animal import Animal
from body import Body
from eyes import fish_eye
from fins import median_fin, membrane, paired_fin, tail_fin, with_mirror
from mesh import Curve
from motion import flap, thrash, wave
from paint import bump, mix, rgb, step
from skin import Skin

LENGTH, END = 0.19, 0.82
EYE = (0.168, 0.070, 0.0215)
WHITE, YELLOW, BLACK = '#f4f1e2', '#ffd83a', '#100f12'


def displace(s, h, v):
    gill = 0.004 * bump(s - 0.245, 0.04) * bump(v - 0.55, 0.2)
    socket = 0.004 * bump(np.hypot(s - EYE[0], h - EYE[1]), 0.028)
    lips = 0.005 * bump(s - 0.010, 0.010)
    return gill + socket + lips


def make_body():
    return Body(
        LENGTH, END,
        upper=[(0, 0.0), (0.012, 0.014), (0.05, 0.028), (0.09, 0.052), (0.13, 0.102), (0.18, 0.176), (0.24, 0.240),
               (0.33, 0.288), (0.44, 0.294), (0.55, 0.256), (0.65, 0.182), (0.72, 0.110), (0.77, 0.064), (END, 0.056)],
        lower=[(0, -0.010), (0.012, -0.024), (0.05, -0.040), (0.09, -0.060), (0.13, -0.094), (0.18, -0.146),
               (0.25, -0.212), (0.35, -0.262), (0.46, -0.264), (0.57, -0.222), (0.66, -0.150), (0.73, -0.088),
               (0.78, -0.056), (END, -0.054)],
        width=[(0, 0.0), (0.012, 0.011), (0.05, 0.020), (0.09, 0.028), (0.15, 0.044), (0.24, 0.060), (0.36, 0.064),
               (0.48, 0.056), (0.60, 0.042), (0.70, 0.026), (0.77, 0.014), (END, 0.003)],
        widest=[(0, 0.5), (0.2, 0.46), (END, 0.5)], keel=1.25, displace=displace)


# The bands' edges, s of h. They run on over the fins.
FIRST = (Curve([(-0.50, 0.31), (-0.28, 0.245), (-0.12, 0.185), (0.0, 0.150), (0.08, 0.146), (0.16, 0.170), (0.30, 0.245), (0.60, 0.44)]),
         Curve([(-0.50, 0.48), (-0.28, 0.395), (-0.12, 0.340), (0.0, 0.318), (0.10, 0.318), (0.20, 0.338), (0.32, 0.375), (0.60, 0.50)]))
SECOND = (Curve([(-0.50, 0.66), (-0.26, 0.622), (-0.1, 0.632), (0.0, 0.640), (0.1, 0.632), (0.28, 0.622), (0.60, 0.70)]),
          Curve([(-0.50, 0.80), (-0.26, 0.745), (-0.1, 0.738), (0.0, 0.742), (0.1, 0.738), (0.28, 0.745), (0.60, 0.82)]))


def pattern(s, h):
    """Colour of body and fins at s, h, and how black it is."""
    wob = 0.0025 * paint.noise(221, s * 60, h * 60)
    sun = step(0.36, 0.60, s + 0.05 * paint.fbm(222, s * 8, h * 8, octaves=3))
    colour = mix(rgb(WHITE), rgb(YELLOW), 0.22 + 0.75 * sun)
    colour = mix(colour, rgb(WHITE), 0.9 * bump(s - FIRST[1](h) - 0.015, 0.030))
    colour = mix(colour, rgb(WHITE), 0.7 * bump(s - SECOND[1](h) - 0.012, 0.012))

    def inside(pair):
        return np.minimum(s - pair[0](h), pair[1](h) - s) + wob
    one, two = inside(FIRST), inside(SECOND)
    black = np.maximum(step(-0.003, 0.004, one), step(-0.003, 0.004, two))
    colour = mix(colour, rgb(BLACK), 0.97 * black)
    edge = bump(s - SECOND[0](h) - 0.022, 0.0035) * 0.5  # a fine pale line within the second band
    return mix(colour, rgb('#b9cbe6'), edge), black


def paint_body(body, pectoral):
    skin = Skin(body)
    at = skin.at
    skin.colour, black = pattern(at.s, at.h)
    snout = step(0.125, 0.10, at.s + 0.25 * np.abs(at.h + 0.005))
    skin.tint(WHITE, 0.9 * snout)
    saddle = np.hypot((at.s - 0.085) / 0.034, (at.h - 0.045) / 0.028)
    skin.tint(BLACK, 0.9 * step(1.25, 1.05, saddle))
    skin.tint('#f08a1e', 0.95 * step(1.0, 0.82, saddle))
    skin.tint(BLACK, 0.92 * step(-0.024, -0.032, at.h - 0.10 * at.s) * step(0.105, 0.085, at.s))
    skin.tint('#dfe9f2', 0.55 * bump(at.s - 0.150 - 0.3 * np.maximum(0.07 - at.h, 0), 0.004) * step(0.02, 0.05, at.h) * step(0.20, 0.16, at.h))
    trunk = step(0.22, 0.27, at.s)
    skin.scales(64, 0.00007, 0.35 + 0.65 * trunk, edge=0.10, variety=0.12, metal=0.22)
    skin.metal += 0.10 * (1 - black)
    skin.iridescence(223, ('#cfd8ff', '#ffe9b0'), 0.18, 1 - black)
    skin.iridescence(224, ('#2b3150', '#30243a'), 0.5, black)
    skin.mottle(225, 0.03, 0.06)
    skin.gill([(-0.13, 0.205), (-0.06, 0.246), (0.0, 0.258), (0.06, 0.250), (0.10, 0.236)], dark=0.30)
    skin.lateral_line([(0.27, 0.15), (0.40, 0.215), (0.54, 0.17), (0.66, 0.07), (0.76, 0.008), (0.81, 0.0)], 0.12)
    skin.socket(EYE[0], EYE[1], EYE[2], '#050507', 0.5)
    skin.mouth((0.030, -0.014), tip_h=-0.006, width=0.0020, lip=0.006, lip_colour='#d9cdb4')
    skin.nostril(0.118, 0.052, 0.0026)
    skin.countershade(0.86, 1.04)
    skin.grain(0.000015, 0.035)
    skin.beneath_fin(pectoral, 0.35, 0.016)
    return skin.pictures()


def fin_paint(place, rays, spiny=0.0, clear=0.80, seed=1, scallop=0.06):
    """place(a, b): s and h there, so that the bands go on."""
    def picture(a, b):
        ray, alpha = membrane(a, b, rays, spiny, clear, 0.95, seed, scallop)
        colour, _ = pattern(*place(a, b))
        return mix(colour, colour * 0.70, 0.6 * ray), alpha, 0.0002 * ray
    return picture


def over(which, body, s0, s1, lengths, leans):
    """s and h of a median fin's points."""
    sign, lean, length = (1 if which == 'upper' else -1), Curve(leans), Curve(lengths)

    def place(a, b):
        s = s0 + (s1 - s0) * a
        return (s + length(a) * b * np.sin(lean(a)), body.profile(which, s) + sign * length(a) * b * np.cos(lean(a)))
    return place


def tail_paint(a, b):
    ray, alpha = membrane(a, b, 17, 0, 0.88, 0.95, 6)
    colour = mix(rgb(BLACK), rgb('#2a2a30'), 0.4 * ray)
    colour = mix(rgb(YELLOW), colour, step(0.16, 0.24, b + 0.03 * np.sin(a * 9)))
    return mix(colour, rgb('#e8eef2'), step(0.86, 0.90, b)), alpha * (1 - 0.5 * step(0.88, 0.95, b)), 0.0002 * ray


def streamer_paint(a, b):
    soft = step(0.0, 0.08, a) * step(1.0, 0.92, a)
    colour = mix(rgb('#fbf8ea'), rgb('#cfc9b4'), 0.5 * bump(a - 0.5, 0.12))
    alpha = soft * (0.97 - 0.12 * b)
    return colour, alpha, 0.0001 * bump(a - 0.5, 0.2)


def pale_paint(dark):
    def picture(a, b):
        ray, alpha = membrane(a, b, 13 if not dark else 6, 0, 0.80 if dark else 0.12, 0.9, 8)
        colour = mix(rgb(BLACK if dark else '#cfc4a0'), rgb('#23232a' if dark else '#f1ecd6'), b)
        return mix(colour, colour * 0.6, 0.5 * ray), alpha, 0.0002 * ray
    return picture


def make():
    body = make_body()
    sail = dict(lengths=[(0, 0.03), (0.06, 0.16), (0.14, 0.215), (0.28, 0.165), (0.5, 0.125), (0.75, 0.095), (0.93, 0.065), (1, 0.03)],
                leans=[(0, 0.50), (0.3, 0.80), (0.7, 1.10), (1, 1.25)])
    dorsal = median_fin(body, 'dorsal', 'upper', 0.285, 0.775, **sail, tile=(0.02, 0.03, 0.60, 0.40), columns=19, rows=6,
                        thickness=0.008, paint=fin_paint(over('upper', body, 0.285, 0.775, **sail), 38, 0.2, 0.84, 2))
    keel = dict(lengths=[(0, 0.03), (0.10, 0.17), (0.20, 0.225), (0.36, 0.165), (0.6, 0.115), (0.9, 0.07), (1, 0.03)],
                leans=[(0, 0.55), (0.3, 0.85), (0.7, 1.10), (1, 1.25)])
    anal = median_fin(body, 'anal', 'lower', 0.455, 0.778, **keel, tile=(0.02, 0.50, 0.44, 0.40), columns=13, rows=6,
                      thickness=0.007, paint=fin_paint(over('lower', body, 0.455, 0.778, **keel), 30, 0.1, 0.84, 4))
    streamer = median_fin(body, 'streamer', 'upper', 0.318, 0.352, lengths=[(0, 0.60), (1, 0.62)], leans=[(0, 0.56), (1, 0.64)],
                          tile=(0.95, 0.03, 0.03, 0.94), columns=4, rows=11, thickness=0.012, bend=np.array([0, -0.315, -0.328]) * LENGTH,
                          paint=streamer_paint)
    # it narrows to a ribbon, upright where it turns back, that is still a pixel wide a metre away: a thread breaks up into dashes
    middle = streamer.direction[32] * streamer.length[32] + streamer.root[32]
    across = (0.5 - np.linspace(0, 1, len(streamer.root)))[:, None] * np.array([0, 0.030 * LENGTH, 0])
    aim = middle + across - streamer.root
    streamer.length = np.linalg.norm(aim, axis=1)
    streamer.direction = aim / streamer.length[:, None]
    tail = tail_fin(body, lengths=[(0, 0.185), (0.08, 0.180), (0.5, 0.150), (0.92, 0.180), (1, 0.185)], spread=0.50,
                    tile=(0.50, 0.50, 0.24, 0.44), columns=13, paint=tail_paint)
    pectoral = paired_fin(body, 'pectoral', 0.285, (-0.035, -0.075),
                          lengths=[(0, 0.060), (0.15, 0.120), (0.4, 0.130), (0.75, 0.100), (1, 0.035)],
                          first=(0.50, 0.50, -0.75), last=(0.42, -0.90, -0.40), tile=(0.66, 0.03, 0.26, 0.40),
                          joint='pectoral_left', slant=0.01, columns=9, flesh=0.006, paint=pale_paint(False))
    pelvic = paired_fin(body, 'pelvic', 0.325, (-0.240, -0.252), lengths=[(0, 0.160), (0.3, 0.150), (1, 0.05)],
                        first=(0.16, -0.72, -0.68), last=(0.10, -0.35, -0.94), tile=(0.78, 0.50, 0.14, 0.44), slant=0.03,
                        columns=6, paint=pale_paint(True))
    beat = (0.15, 1.0, 0.30)
    clips = [
        dict(name='swim', duration=1.1, keys=28, lateral=wave(0.50, 1.1), fins=flap(beat, 2, 0.60, 0.15),
             lift=lambda p: 0.0016 * np.sin(4 * np.pi * p), roll=lambda p: 0.03 * np.sin(2 * np.pi * p)),
        dict(name='dart', duration=0.46, keys=20, lateral=wave(1.2, 1.0), fins=flap(beat, 1, 0.12, 0.45)),
        dict(name='struggle', duration=0.9, keys=32, lateral=thrash(0.8), fins=flap(beat, 6, 0.55),
             roll=lambda p: 0.30 * np.sin(2 * np.pi * 3 * p + 0.4))]
    return Animal('idol', body, [dorsal, anal, streamer, tail, *with_mirror(pectoral), *with_mirror(pelvic)], EYE,
                  fish_eye('#3c2c1c', '#c98c3a', 0.5), paint_body(body, pectoral), clips)
