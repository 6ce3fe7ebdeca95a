#!/usr/bin/env python3
"""Makes every sound of the game into content/sounds, 48 kHz FLAC, the same bytes each time.

Wants python3-numpy and ffmpeg. Each sound is a function below, named as its file. Positioned sounds are mono; beds loop.
Loudness: beds at -30 dB RMS, other sounds peak at LEVELS dB below full scale.
"""
import os
import subprocess
import wave

import numpy as np

RATE = 48000
HERE = os.path.dirname(os.path.abspath(__file__))
OUT = os.path.join(HERE, "..", "..", "sounds")


def time(seconds):
    return np.arange(int(seconds * RATE)) / RATE


def noise(seconds, seed):
    return np.random.default_rng(seed).standard_normal(int(seconds * RATE))


def band(x, low, high, slope=2.0):
    """Band-pass in the frequency domain, periodic, so loops stay loops."""
    f = np.fft.rfftfreq(len(x), 1 / RATE)
    gain = 1 / (1 + (low / np.maximum(f, 1e-3)) ** (2 * slope)) / (1 + (f / high) ** (2 * slope))
    return np.fft.irfft(np.fft.rfft(x) * gain, len(x))


def fade(x, attack, release):
    n = len(x)
    t = np.arange(n) / RATE
    return x * np.clip(t / attack, 0, 1) * np.clip((n / RATE - t) / release, 0, 1)


def bubble(radius_mm, seconds, rise=0.25):
    """A bubble rings at 3.26 / radius hertz and metres (Minnaert 1933), dies away and rises in pitch as it nears the surface."""
    t = time(seconds)
    f = 3.26 / (radius_mm * 1e-3) * (1 + rise * t / seconds)
    decay = 0.13 / (3.26 / (radius_mm * 1e-3)) * 90
    return np.sin(2 * np.pi * np.cumsum(f) / RATE) * np.exp(-t / decay) * np.clip(t / 0.002, 0, 1)


def bubble_stream(seconds, count, seed, low_mm=1.5, high_mm=6.0, wrap=False):
    random = np.random.default_rng(seed)
    out = np.zeros(int(seconds * RATE))
    for _ in range(count):
        b = bubble(random.uniform(low_mm, high_mm), 0.12) * random.uniform(0.2, 1)
        at = random.integers(0, len(out) - (0 if wrap else len(b)))
        index = np.arange(at, at + len(b))
        out[index % len(out)] += b
    return out


def bed(seconds, seed, low, high, bubbles):
    swell = 1 + 0.35 * np.sin(2 * np.pi * 3 * time(seconds) / seconds) + 0.2 * np.sin(2 * np.pi * 5 * time(seconds) / seconds + 1)
    x = band(noise(seconds, seed), low, high) * swell
    x = x / np.std(x)
    return x + bubble_stream(seconds, bubbles, seed + 1, wrap=True) * 0.7


def bed_open():
    """The sea: a soft rumble, far crackle of shrimps, a bubble now and then."""
    random = np.random.default_rng(5)
    x = bed(20, 1, 40, 420, 14)
    crackle = np.zeros_like(x)
    for at in random.integers(0, len(x), 420):
        click = np.exp(-np.arange(160) / 18) * random.uniform(-0.5, 0.5)
        crackle[(at + np.arange(160)) % len(x)] += click
    return x + band(crackle, 1800, 6000) * 0.9


def bed_tunnel():
    """Between walls: lower, closer, with a hollow note."""
    x = bed(20, 11, 30, 190, 6)
    hollow = band(noise(20, 13), 84, 96, 6)
    return x + 0.5 * hollow / np.std(hollow)


def swish(seconds, low, high, seed, peak):
    x = band(noise(seconds, seed), low, high)
    t = time(seconds)
    return x * np.exp(-((t - peak) / (seconds * 0.22)) ** 2) * (1 + 0.4 * np.sin(2 * np.pi * 9 * t))


def fish_pass_small():
    return swish(0.7, 250, 1600, 21, 0.3)


def fish_pass_large():
    return swish(1.6, 40, 420, 22, 0.7)


def touch():
    t = time(0.18)
    return np.sin(2 * np.pi * 190 * t * (1 - 0.8 * t)) * np.exp(-t / 0.035) + 0.25 * fade(band(noise(0.18, 23), 400, 2400), 0.002, 0.15)


def bell(f, seconds):
    """A soft struck bar: its first partials, the upper ones short."""
    t = time(seconds)
    return sum(a * np.sin(2 * np.pi * f * r * t) * np.exp(-t / d) for r, a, d in ((1, 1, 0.45), (3.93, 0.22, 0.12), (9.2, 0.07, 0.05)))


def catch():
    out = np.zeros(int(1.3 * RATE))
    for at, f in ((0, 392.0), (0.09, 493.9), (0.18, 587.3), (0.30, 784.0)):
        b = bell(f, 0.9)
        n = int(at * RATE)
        out[n:n + len(b)] += b
    return fade(out + 0.5 * bubble_stream(1.3, 14, 24), 0.003, 0.4)


def struggle():
    """Loops: tail beats, six a second."""
    t = time(1.0)
    beat = np.maximum(np.sin(2 * np.pi * 6 * t), 0) ** 3
    return band(noise(1.0, 25), 120, 1100) * beat


def release():
    return fade(swish(0.6, 200, 900, 26, 0.12) * 2 + bubble_stream(0.6, 7, 27), 0.005, 0.2)


def escape():
    t = time(0.5)
    return swish(0.5, 300, 2200, 28, 0.1) * 1.5 + 0.3 * np.sin(2 * np.pi * (330 - 260 * t) * t) * np.exp(-t / 0.12)


def startle():
    return swish(0.35, 500, 3200, 29, 0.06)


def miss():
    return swish(0.4, 150, 700, 30, 0.12)


def shark_near():
    """Felt more than heard: two notes that beat, swelling."""
    t = time(3.2)
    x = np.sin(2 * np.pi * 41 * t) + np.sin(2 * np.pi * 43.5 * t) + 0.5 * np.sin(2 * np.pi * 82 * t) + 0.25 * np.sin(2 * np.pi * 123 * t)
    return fade(x * np.sin(np.pi * t / 3.2) ** 1.5, 0.2, 0.6)


def shark_bite():
    t = time(0.6)
    snap = band(noise(0.6, 31), 90, 2600) * np.exp(-t / 0.045)
    return snap + 0.9 * np.sin(2 * np.pi * 62 * t) * np.exp(-t / 0.16)


def shark_bump():
    t = time(0.7)
    return np.sin(2 * np.pi * (70 - 30 * t) * t) * np.exp(-t / 0.15) + 0.3 * band(noise(0.7, 32), 60, 500) * np.exp(-t / 0.1)


def bubbles():
    return bubble_stream(1.2, 26, 33)


def countdown():
    return fade(bell(880, 0.35), 0.002, 0.1)


def dive_start():
    return fade(bubble_stream(2.2, 90, 34, 1.2, 9) + 1.2 * swish(2.2, 80, 900, 35, 0.4), 0.02, 0.6)


def dive_over():
    out = np.zeros(int(2.6 * RATE))
    for at, f in ((0, 587.3), (0.25, 493.9), (0.5, 392.0), (0.85, 293.7)):
        b = bell(f, 1.6)
        n = int(at * RATE)
        out[n:n + len(b)] += b
    return fade(out, 0.003, 0.8)


BEDS = [bed_open, bed_tunnel]
LEVELS = {  # peak, dB below full scale
    fish_pass_small: 12, fish_pass_large: 9, touch: 9, catch: 6, struggle: 12, release: 12, escape: 10, startle: 13, miss: 15,
    shark_near: 4, shark_bite: 4, shark_bump: 5, bubbles: 12, countdown: 12, dive_start: 7, dive_over: 6,
}


def write(name, x):
    data = np.round(np.clip(x, -1, 1) * 32767).astype("<i2")
    temporary = os.path.join(OUT, f".{name}.wav")
    with wave.open(temporary, "wb") as out:
        out.setnchannels(1)
        out.setsampwidth(2)
        out.setframerate(RATE)
        out.writeframes(data.tobytes())
    subprocess.run(["ffmpeg", "-loglevel", "error", "-y", "-i", temporary, "-bitexact", "-map_metadata", "-1", "-c:a", "flac",
                    "-compression_level", "8", os.path.join(OUT, f"{name}.flac")], check=True)
    os.remove(temporary)


def main():
    os.makedirs(OUT, exist_ok=True)
    for make in BEDS:
        x = make()
        write(make.__name__, x / np.std(x) * 10 ** (-30 / 20))
    for make, below in LEVELS.items():
        x = make()
        write(make.__name__, x / np.max(np.abs(x)) * 10 ** (-below / 20))


if __name__ == "__main__":
    main()
