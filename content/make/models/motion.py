"""How animals move: the body's wave, beating fins, and the clips made of them."""

import numpy as np

from mesh import quaternion, quaternion_product, unit

def wave(amplitude, wave_length=0.95, cycles=1):
    """A travelling wave in fractions of the length. The envelope 0.02 - 0.0825 s + 0.1625 s^2 is what Videler and
    Hess (1984) measured on saithe and mackerel; amplitude scales it."""
    def lateral(s, phase):
        envelope = 0.02 - 0.0825 * s + 0.1625 * s * s
        return amplitude * envelope * np.sin(2 * np.pi * (s / wave_length - cycles * phase))
    return lateral


def thrash(strength=1.0):
    """The struggle of a held fish: its whole body bends into a C, to one side and to the other, unevenly."""
    def lateral(s, phase):
        c = 0.75 * np.sin(2 * np.pi * 2 * phase) + 0.4 * np.sin(2 * np.pi * 3 * phase + 0.9)
        tail = np.sin(2 * np.pi * (s * 0.9 - 3 * phase))
        return strength * (0.70 * c * ((s - 0.42) ** 2 - 0.06) + 0.06 * s * s * tail)
    return lateral


def add_clip(glb, rig, nodes, name, duration, keys, lateral, fins=None, roll=None, lift=None, upright=True):
    """upright: the spine bends sideways, as a fish's does; else up and down, as a whale's. fins(phase) -> {joint name: quaternions}; roll(phase): radians about Z; lift(phase): metres."""
    times, sway, turn = rig.bend(lateral, duration, keys)
    phase = times / duration
    start = rig.positions[0]
    up = lift(phase) if lift else 0 * phase
    places = [sway, start[1] + up, 0 * sway + start[2]] if upright else [0 * sway, start[1] + up + sway, 0 * sway + start[2]]
    channels = [(nodes[0], 'translation', np.stack(places, -1))]
    for i in range(len(rig.s)):
        q = quaternion([0, 1, 0], turn[:, i]) if upright else quaternion([1, 0, 0], -turn[:, i])
        if i == 0 and roll:
            q = quaternion_product(quaternion([0, 0, 1], roll(phase)), q)
        channels.append((nodes[i], 'rotation', q))
    for joint, q in (fins(phase) if fins else {}).items():
        channels.append((nodes[rig.names.index(joint)], 'rotation', q))
    glb.animation(name, times, channels)


def flap(axis, beats, swing, rest=0.0):
    """Both pectoral fins beat together, mirror images; axis: the left fin's root line."""
    axis = unit(axis)

    def clip(phase):
        angle = rest + swing * np.sin(2 * np.pi * (beats * phase))
        twist = 0.35 * swing * np.cos(2 * np.pi * (beats * phase))
        left = quaternion_product(quaternion(axis, angle), quaternion([1, 0, 0], twist))
        right = left * [1, -1, -1, 1]  # mirrored in x
        return {'pectoral_left': left, 'pectoral_right': right}
    return clip
