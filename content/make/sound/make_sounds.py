#!/usr/bin/python3
"""Makes every sound of the game into content/sounds: 48 kHz (music 24), 16 bit, FLAC, the same bytes each time.

    make_sounds.py            rebuilds all (half a minute)
    make_sounds.py --check    rebuilds elsewhere and compares the samples; 1: something differs, 77: cannot tell
    make_sounds.py --list     loudness and peak of each

Wants python3-numpy and ffmpeg. Each sound is a function below, named as its file; LEVELS says how loud each leaves.
Beds, music and `struggle` loop without a seam: whatever they are made of is periodic. Beds and music are stereo; every
sound that has a place in the water is mono. music.py makes the music; synth.py holds what all are made of, master.py the
loudness (BS.1770).
"""
import os
import shutil
import subprocess
import sys
import tempfile
import wave

try:
    import numpy as np
except ImportError:
    print("python3-numpy is missing")
    sys.exit(77)

from master import loudness, master
from music import CALM, TENSION
from synth import RATE, add, answer, band, bubbles_at, fade, noise, phrase, swish, time, unit

HERE = os.path.dirname(os.path.abspath(__file__))
OUT = os.path.join(HERE, "..", "..", "sounds")


def empty(seconds):
    return np.zeros(len(time(seconds)))


def swell(seconds, seed, depth):
    """Slow, never the same twice within the loop, and whole turns in it."""
    t = time(seconds) / seconds
    random = np.random.default_rng(seed)
    x = sum(np.sin(2 * np.pi * (turns * t + random.random())) / turns ** 0.5 for turns in (2, 3, 5, 7))
    return np.exp(depth * x / 2)


def both(make):
    """Two channels that share `make`'s seed parts and differ in the rest."""
    return [make(side) for side in (0, 1)]


def snaps(seconds, count, seed, which, low, high, near=0.1):
    """Shrimps that snap their claws, each somewhere: its side by level, its distance, from `near` to 1, by a power law.
    low, high: pitch, radians a sample."""
    random = np.random.default_rng(seed)
    out = empty(seconds)
    for _ in range(count):
        at, pan = random.uniform(0, seconds), random.random()
        level = random.uniform(near, 1) ** -1.5 * (1 if random.random() < 0.5 else -1)
        click = np.exp(-np.arange(200) / 16) * np.sin(np.arange(200) * random.uniform(low, high))
        add(out, click * level * (np.cos if which == 0 else np.sin)(pan * np.pi / 2), at, wrap=True)
    return out


def bed_open():
    """The sea over a reef: deep rumble, surf far above, the crackle of snapping shrimps, a bubble now and then."""
    seconds = 24

    def side(which):
        deep = unit(band(noise(seconds, 1), 35, 130)) * swell(seconds, 2, 0.35)  # too long a wave to differ at two ears
        surf = unit(band(noise(seconds, 3 + which), 180, 620, 1.7)) * swell(seconds, 5 + which, 0.6)
        x = deep + 0.38 * surf
        crackle = snaps(seconds, 260, 7, which, 0.3, 0.6)
        x += 0.06 * answer(band(crackle, 1500, 7000), 0.2, 900, 5000, 0.3, 8 + which, wrap=True)
        x += 0.5 * band(snaps(seconds, 1100, 15, which, 0.4, 1.5, 0.4), 1800, 14000, 1.0)  # bright, dry, none too near
        times = np.random.default_rng(10).uniform(0, seconds, 22)
        near = bubbles_at(np.zeros(len(x)), times[which::2], 11 + which, 0.002, 0.007, wrap=True)
        return x + 0.45 * answer(near, 0.5, 200, 1800, 0.5, 13 + which, wrap=True)

    return both(side)


def bed_tunnel():
    """Between walls: lower, closer, a few notes of the hollow, bubbles that creep along the roof and echo."""
    seconds = 24

    def side(which):
        x = unit(band(noise(seconds, 21), 28, 95)) * swell(seconds, 22, 0.3)
        for i, note in enumerate((61, 92, 139, 171)):
            mode = unit(band(noise(seconds, 30 + 2 * i + which), note * 0.985, note * 1.015, 5))
            x += mode * 0.34 / (1 + 0.5 * i) * swell(seconds, 40 + i, 0.5)
        x += 0.1 * unit(band(noise(seconds, 50 + which), 150, 420, 1.5)) * swell(seconds, 52 + which, 0.7)
        creep = np.zeros(len(x))
        for k, start in enumerate((1.8, 8.1, 13.4, 20.2)):
            times = start + np.cumsum(np.random.default_rng(60 + k).exponential(0.11, 7))
            bubbles_at(creep, times % seconds, 64 + k, 0.003, 0.009, wrap=True)
        x += 0.13 * answer(creep, 1.8, 120, 1100, 1.0, 70 + which, wrap=True)
        outside = snaps(seconds, 500, 17, which, 0.3, 1.2, 0.4)  # shrimps before the walls and in their cracks
        return x + 0.25 * band(outside, 1500, 9000, 1.0)

    return both(side)


def fish_pass_small():
    x = swish(0.75, 0.3, ((140, 480, 0.14, 1), (450, 1500, 0.085, 0.6), (1400, 3200, 0.05, 0.22)), 101)
    t = time(0.75)
    return fade(x * (1 + 0.35 * np.sin(2 * np.pi * 11 * t)), 0.02, 0.15)  # eleven strokes of a small tail a second


def fish_pass_large():
    x = swish(1.9, 0.75, ((28, 80, 0.42, 1.5), (70, 240, 0.34, 1), (220, 700, 0.2, 0.4)), 102)
    t = time(1.9)
    return fade(x * (1 + 0.3 * np.sin(2 * np.pi * 2.2 * t)), 0.1, 0.4)


def touch():
    """Something smooth and firm brushes a finger: a soft thud and a slip."""
    t = time(0.22)
    thud = np.sin(2 * np.pi * (185 * t - 260 * t * t)) * np.exp(-t / 0.032)
    slip = swish(0.22, 0.03, ((500, 1900, 0.035, 0.16), (180, 600, 0.05, 0.2)), 103)
    return fade(thud + slip, 0.002, 0.06)


def catch():
    """G major up a marimba under water, and the bubbles of joy."""
    seconds = 1.9
    x = phrase(seconds, ((0, 196.0, 0.7), (0.0, 392.0, 0.8), (0.085, 493.9, 0.85), (0.17, 587.3, 0.9), (0.29, 784.0, 1)), 1.5)
    x = answer(band(x, 60, 3800, 1.5), 1.2, 150, 2200, 0.35, 104)
    times = 0.1 + np.cumsum(np.random.default_rng(105).exponential(0.045, 16))
    return fade(x + 0.22 * bubbles_at(empty(seconds), times, 106, 0.0018, 0.0045, rise=0.25), 0.002, 0.5)


def struggle():
    """Loops: a tail that beats six times a second, never quite evenly, and what it stirs up."""
    seconds = 3.0
    out = empty(seconds)
    random = np.random.default_rng(107)
    for k in range(18):
        at = (k + random.uniform(-0.16, 0.16)) / 6
        force = random.uniform(0.55, 1)
        beat = swish(0.24, 0.07, ((130, 520, 0.045, 1), (500, 1700 + 900 * force, 0.03, 0.5 * force)), 110 + k)
        t = time(0.24)
        beat += 0.9 * np.sin(2 * np.pi * 78 * t) * np.exp(-((t - 0.07) / 0.035) ** 2)
        add(out, fade(beat, 0.02, 0.06) * force, at % seconds, wrap=True)
    return out + 0.35 * bubbles_at(empty(seconds), random.uniform(0, seconds, 16), 108, 0.0012, 0.003, wrap=True)


def release():
    """The hand opens; it swims away upwards."""
    seconds = 1.0
    x = 0.5 * swish(seconds, 0.16, ((150, 500, 0.12, 1), (450, 1400, 0.09, 0.5)), 130)
    x += 0.5 * band(phrase(seconds, ((0.03, 392.0, 0.7), (0.14, 587.3, 0.8)), 0.8), 60, 2500)
    times = 0.1 + np.cumsum(np.random.default_rng(131).exponential(0.06, 8))
    return fade(x + 0.3 * bubbles_at(empty(seconds), times, 132, 0.002, 0.004, rise=0.2), 0.004, 0.3)


def escape():
    """Slips through the fingers: a flick, a glide downwards, bubbles in its wake."""
    seconds = 0.8
    t = time(seconds)
    x = swish(seconds, 0.07, ((180, 700, 0.06, 1), (650, 2600, 0.04, 0.7)), 133) + swish(seconds, 0.2, ((150, 600, 0.07, 0.5),), 134)
    x += 0.55 * np.sin(2 * np.pi * (290 * t - 210 * t * t)) * np.exp(-t / 0.16) * np.clip(t / 0.01, 0, 1)
    times = 0.12 + np.cumsum(np.random.default_rng(135).exponential(0.04, 9))
    return fade(x + 0.5 * bubbles_at(empty(seconds), times, 136, 0.0015, 0.004), 0.004, 0.25)


def startle():
    """Two strokes of a frightened tail."""
    x = swish(0.45, 0.05, ((160, 700, 0.035, 1), (600, 2800, 0.022, 0.8)), 137)
    return fade(x + 0.7 * swish(0.45, 0.15, ((200, 800, 0.045, 1), (700, 2400, 0.03, 0.5)), 138), 0.004, 0.15)


def closing(seconds):
    """A hand closes on water."""
    t = time(seconds)
    x = empty(seconds)
    add(x, swish(0.42, 0.1, ((90, 320, 0.075, 1), (300, 900, 0.05, 0.35)), 139), 0)
    return x + 0.5 * np.sin(2 * np.pi * 95 * t) * np.exp(-((t - 0.13) / 0.04) ** 2)


def miss():
    return fade(closing(0.42), 0.01, 0.15)


def miss_too_far():
    """And two notes that rise and go away: farther."""
    notes = phrase(0.85, ((0.13, 293.7, 1), (0.29, 440.0, 0.7)), 0.5)
    x = 0.6 * closing(0.85) + 0.55 * answer(band(notes, 60, 2500), 0.8, 150, 2200, 0.6, 155)
    return fade(x, 0.01, 0.3)


def miss_behind():
    """And two notes that fall and come back: nearer."""
    notes = phrase(0.7, ((0.13, 440.0, 0.7), (0.29, 293.7, 1)), 0.4)
    return fade(0.6 * closing(0.7) + 0.55 * band(notes, 60, 2500), 0.01, 0.25)


def miss_too_fast():
    """Three strokes of water in a fifth of a second, each quicker and brighter: a hand that hurries."""
    x = empty(0.5)
    for k, (at, high) in enumerate(((0.03, 700), (0.13, 1300), (0.2, 2400))):
        stroke = swish(0.2, 0.04, ((140, high, 0.028, 1), (high / 3, 1.4 * high, 0.018, 0.5)), 156 + k)
        add(x, fade(stroke, 0.01, 0.08) * (0.6 + 0.2 * k), at)
    return fade(x, 0.01, 0.15)


def miss_too_early():
    """The hand shuts with a knock; a rest; then the fish goes by."""
    seconds = 0.85
    knock = band(phrase(seconds, ((0.02, 220.0, 1), (0.02, 440.0, 0.3)), 0.3), 60, 1800) * np.exp(-time(seconds) / 0.06)
    late = swish(seconds, 0.5, ((150, 520, 0.1, 1), (450, 1500, 0.06, 0.5)), 159)
    return fade(0.9 * knock + 0.5 * late, 0.004, 0.2)


def shark_near():
    """Felt more than heard: two deep notes that beat, swelling; their overtones, so that small speakers tell of it too."""
    seconds = 3.6
    t = time(seconds)
    x = empty(seconds)
    for f in (36.7, 38.9):
        for overtone, gain in ((1, 1), (2, 0.55), (3, 0.3), (4, 0.16), (5, 0.08)):
            x += gain * np.sin(2 * np.pi * f * overtone * t)
    x += 0.8 * unit(band(noise(seconds, 140), 30, 90))
    return fade(x * np.sin(np.pi * (t / seconds) ** 1.4) ** 1.6, 0.3, 0.6)


def whale_song():
    """A phrase of a humpback from far away: a moan that climbs, a cry that breaks downwards, a groan; the sea answers long
    after. Fundamentals of 90 to 600 Hz, as recorded songs have them (Payne and McVay 1971, "Songs of humpback whales")."""
    seconds = 8.0
    x = empty(seconds)

    def unit_of_song(at, length, pitches, overtones, rough, gain):
        t = time(length)
        f = np.exp(np.interp(t / length, np.linspace(0, 1, len(pitches)), np.log(pitches)))
        f *= 1 + 0.012 * np.sin(2 * np.pi * 5.3 * t) * np.clip(t / 0.6, 0, 1)
        phase = 2 * np.pi * np.cumsum(f) / RATE
        voice = sum(g * np.sin(k * phase + 0.7 * k) for k, g in enumerate(overtones, 1))
        voice *= 1 + rough * np.sin(2 * np.pi * 31 * t)
        add(x, gain * voice * np.sin(np.pi * (t / length) ** 0.8) ** 1.3, at)

    unit_of_song(0.1, 2.3, (110, 128, 190, 255), (1, 0.5, 0.22, 0.1), 0.10, 1.0)
    unit_of_song(2.3, 1.5, (330, 560, 470, 250), (1, 0.35, 0.15), 0.0, 0.75)
    unit_of_song(4.0, 2.2, (170, 120, 104, 92), (1, 0.7, 0.45, 0.3, 0.16), 0.30, 0.9)
    return fade(answer(x, 3.0, 70, 1400, 0.9, 155), 0.05, 1.5)


def shark_bite():
    """Jaws: teeth that meet within a twentieth of a second, the blow behind them, torn water."""
    seconds = 1.0
    t = time(seconds)
    x = empty(seconds)
    random = np.random.default_rng(141)
    for _ in range(26):
        n = np.arange(500)
        tooth = np.exp(-n / random.uniform(25, 90)) * np.sin(n * 2 * np.pi * random.uniform(500, 2300) / RATE)
        add(x, tooth * random.uniform(0.2, 0.7), 0.02 + abs(random.normal(0, 0.022)))
    x += 1.5 * np.sin(2 * np.pi * (88 * t - 45 * t * t)) * np.exp(-t / 0.13) * np.clip(t / 0.01, 0, 1)
    x += swish(seconds, 0.09, ((80, 350, 0.1, 0.9), (350, 1500, 0.06, 0.4)), 142)
    times = 0.1 + np.cumsum(random.exponential(0.025, 18))
    return fade(x + 0.5 * bubbles_at(empty(seconds), times, 143, 0.002, 0.006), 0.002, 0.3)


def shark_bump():
    """A heavy body against the hand: a blow that sinks, skin that drags."""
    seconds = 0.9
    t = time(seconds)
    x = 1.3 * np.sin(2 * np.pi * (82 * t - 34 * t * t)) * np.exp(-t / 0.17) * np.clip(t / 0.006, 0, 1)
    x += 0.45 * np.sin(2 * np.pi * 143 * t) * np.exp(-t / 0.06) * np.clip(t / 0.004, 0, 1)
    rough = unit(band(noise(seconds, 144), 250, 1300)) * (1 + 0.6 * np.sin(2 * np.pi * 37 * t))
    return fade(x + 0.16 * rough * np.exp(-((t - 0.16) / 0.12) ** 2), 0.003, 0.3)


def bubbles():
    """A breath let out: a burst of large ones, then fewer and smaller, rising away."""
    seconds = 2.2
    random = np.random.default_rng(145)
    times = 2.0 * random.random(70) ** 2.2
    x = empty(seconds)
    bubbles_at(x, times[:26] * 0.45, 146, 0.004, 0.011, rise=0.2)
    bubbles_at(x, times[26:] + 0.05, 147, 0.0018, 0.005, rise=0.2)
    return fade(band(x, 90, 2600, 1.5) + 0.3 * swish(seconds, 0.18, ((90, 380, 0.22, 1),), 148), 0.01, 0.6)


def countdown():
    """A knock on wood under water."""
    x = phrase(0.5, ((0, 440.0, 1), (0, 880.0, 0.3)), 0.45)
    return fade(x * np.exp(-time(0.5) / 0.12), 0.002, 0.15)


def dive_start():
    """Through the surface: the splash's brightness drowns, a cloud of bubbles rises past."""
    seconds = 2.8
    t = time(seconds)
    splash = empty(seconds)
    for high, decay in ((8000, 0.06), (3500, 0.13), (1500, 0.26), (600, 0.5), (220, 0.85)):
        splash += unit(band(noise(seconds, 149 + high), high / 4, high)) * np.exp(-t / decay)
    x = 0.4 * splash * np.clip(t / 0.012, 0, 1) + 0.9 * np.sin(2 * np.pi * (64 * t - 9 * t * t)) * np.exp(-t / 0.3)
    times = 2.5 * np.random.default_rng(150).random(170) ** 2.4 + 0.06
    return fade(x + 0.42 * bubbles_at(empty(seconds), times, 151, 0.0013, 0.009, rise=0.15), 0.004, 0.7)


def dive_over():
    """Home to G: down the bars, and a chord that stays."""
    seconds = 3.2
    notes = ((0, 784.0, 0.7), (0.2, 587.3, 0.8), (0.4, 493.9, 0.85), (0.65, 392.0, 1), (0.65, 196.0, 0.9), (0.68, 293.7, 0.6))
    x = answer(band(phrase(seconds, notes, 2.4), 60, 3200, 1.5), 1.6, 120, 2000, 0.45, 152)
    times = 0.7 + np.cumsum(np.random.default_rng(153).exponential(0.09, 14))
    return fade(x + 0.18 * bubbles_at(empty(seconds), times, 154, 0.002, 0.006, rise=0.2), 0.003, 1.0)


def struck(seconds, seed, modes, length):
    """A hard thing struck: modes (frequency, gain, decay), and the grit of the touch, `length` seconds of it."""
    t = time(seconds)
    x = sum(gain * np.sin(2 * np.pi * f * t) * np.exp(-t / decay) for f, gain, decay in modes)
    grit = unit(band(noise(seconds, seed), 900, 4200)) * np.exp(-t / length)
    return (x + 0.35 * grit) * np.clip(t / 0.0008, 0, 1)


def crack():
    """A mussel's shell gives way: a snap, splinters within a twentieth of a second, the halves knock; a small bubble leaves."""
    seconds = 0.45
    x = empty(seconds)
    add(x, struck(0.2, 160, ((610, 0.8, 0.012), (1480, 0.7, 0.007), (2630, 0.5, 0.004)), 0.005), 0.004)
    random = np.random.default_rng(161)
    for at in 0.012 + 0.045 * random.random(11) ** 1.5:
        f = random.uniform(1400, 3800)
        add(x, struck(0.05, 162, ((f, 1, 0.0022), (0.43 * f, 0.5, 0.004)), 0.0015) * random.uniform(0.15, 0.6), at)
    add(x, struck(0.2, 163, ((330, 0.9, 0.022), (870, 0.4, 0.010)), 0.003) * 0.6, 0.062)
    x = answer(band(x, 150, 4500, 1.5), 0.25, 250, 2000, 0.15, 164)
    return fade(x + 0.9 * bubbles_at(empty(seconds), (0.12, 0.17), 165, 0.0022, 0.0032, rise=0.3), 0.002, 0.12)


def knock():
    """A stone or a bottle against rock: one dull hard blow, and the water's short answer."""
    x = empty(0.35)
    add(x, struck(0.3, 166, ((240, 0.9, 0.030), (690, 1, 0.017), (1310, 0.5, 0.010), (2240, 0.3, 0.006)), 0.003), 0.004)
    add(x, struck(0.2, 167, ((720, 0.5, 0.012), (1370, 0.3, 0.008)), 0.002) * 0.35, 0.047)
    return fade(answer(band(x, 110, 3000, 1.5), 0.3, 150, 1500, 0.25, 168), 0.002, 0.12)


def throw():
    """An arm sweeps forward through the water and lets go; a wake of a few small bubbles."""
    seconds = 0.75
    x = swish(seconds, 0.2, ((110, 420, 0.13, 1), (380, 1200, 0.085, 0.6), (1100, 2600, 0.05, 0.22)), 169)
    times = 0.26 + np.cumsum(np.random.default_rng(170).exponential(0.06, 5))
    return fade(x + 0.16 * bubbles_at(empty(seconds), times, 171, 0.0015, 0.003), 0.03, 0.3)


def feed():
    """Small mouths at flesh: soft quick clicks, a few at once, each with the sip of water that it takes in."""
    seconds = 0.75
    x = empty(seconds)
    random = np.random.default_rng(172)
    for at in 0.02 + np.cumsum(random.uniform(0.018, 0.062, 14)):
        f = random.uniform(700, 1700)
        nibble = struck(0.09, 173, ((f, 1, 0.006), (2.1 * f, 0.3, 0.003)), 0.003)
        sip = swish(0.09, 0.02, ((500, 1800, 0.014, 0.14),), random.integers(174, 400))
        add(x, fade(nibble + sip, 0.001, 0.03) * random.uniform(0.35, 1), at)
    return fade(answer(band(x, 200, 3200, 1.5), 0.2, 300, 2000, 0.2, 173), 0.003, 0.1)


def collect():
    """A bottle for the collection: G and the D above it, softly on glass, whose partials lie apart as those of a plate do."""
    seconds = 1.5
    x = empty(seconds)
    for at, f, gain in ((0.0, 784.0, 0.8), (0.16, 1174.7, 1)):
        t = time(seconds - at)
        tone = sum(g * np.sin(2 * np.pi * ratio * f * t) * np.exp(-t / decay)
                   for ratio, g, decay in ((1, 1, 0.34), (1.004, 0.5, 0.40), (2.32, 0.22, 0.13), (4.25, 0.06, 0.05)))
        add(x, gain * tone * np.clip(t / 0.004, 0, 1), at)
    return fade(answer(band(x, 150, 5000, 1.5), 1.0, 300, 3000, 0.14, 175), 0.003, 0.5)


# LUFS: beds over all of it, other sounds their loudest 400 ms. What matters more to the player is louder.
LEVELS = {
    bed_open: -23, bed_tunnel: -23, struggle: -23,
    catch: -17, dive_start: -18, dive_over: -18, shark_bite: -18, shark_bump: -20, shark_near: -20, whale_song: -18, fish_pass_large: -23,
    escape: -22, release: -22, startle: -24, touch: -25, countdown: -24, bubbles: -24, fish_pass_small: -25, miss: -27,
    miss_too_far: -25, miss_behind: -25, miss_too_fast: -25, miss_too_early: -25,
    crack: -22, knock: -24, throw: -25, feed: -26, collect: -20,
    **dict.fromkeys(CALM, -32), **dict.fromkeys(TENSION, -30),
}
LOOPS = {bed_open, bed_tunnel, struggle, *CALM, *TENSION}


def made(make):
    x = make()
    return master(x if isinstance(x, list) else [x], LEVELS[make], make in LOOPS)


def write(folder, make):
    every = 2 if make in CALM + TENSION else 1  # music has nothing above 5 kHz
    channels = [x[::every] for x in made(make)]
    data = np.round(np.stack(channels, axis=1) * 32767).astype("<i2")
    name = make.__name__
    temporary = os.path.join(folder, f".{name}.wav")
    with wave.open(temporary, "wb") as out:
        out.setnchannels(len(channels))
        out.setsampwidth(2)
        out.setframerate(RATE // every)
        out.writeframes(data.tobytes())
    subprocess.run(["ffmpeg", "-loglevel", "error", "-y", "-i", temporary, "-bitexact", "-map_metadata", "-1", "-c:a", "flac",
                    "-compression_level", "12", os.path.join(folder, f"{name}.flac")], check=True)
    os.remove(temporary)


def samples(file):
    read = subprocess.run(["ffmpeg", "-loglevel", "error", "-i", file, "-f", "s16le", "-"], check=True, capture_output=True)
    return np.frombuffer(read.stdout, "<i2").astype(int)


def check():
    """The bytes are the same from one run to the next; samples, because another encoder may pack them otherwise, and
    another processor's sine may round one of a million to its neighbour."""
    if not shutil.which("ffmpeg"):
        print("ffmpeg is missing")
        return 77
    differ = 0
    with tempfile.TemporaryDirectory() as folder:
        for make in LEVELS:
            write(folder, make)
            name = f"{make.__name__}.flac"
            stored = os.path.join(OUT, name)
            fresh = samples(os.path.join(folder, name))
            old = samples(stored) if os.path.exists(stored) else ()
            if len(old) != len(fresh) or np.max(np.abs(old - fresh)) > 1:
                print(f"{name} is not what this program makes")
                differ = 1
    return differ


def main(arguments):
    if arguments == ["--check"]:
        return check()
    if arguments == ["--list"]:
        for make in LEVELS:
            x = made(make)
            peak = 20 * np.log10(max(np.max(np.abs(c)) for c in x))
            print(f"{make.__name__:20} {len(x[0]) / RATE:5.2f} s {loudness(x, make in LOOPS):6.1f} LUFS  peak {peak:5.1f} dB")
        return 0
    if arguments:
        print(__doc__)
        return 2
    os.makedirs(OUT, exist_ok=True)
    for make in LEVELS:
        write(OUT, make)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
