"""The right hand as a solid: bones wrapped in flesh, by smooth unions of capsules and ellipsoids."""

import json
from dataclasses import dataclass

import numpy as np

from mesh import unit
from surface import capsule, ellipsoid, smooth_max, smooth_min

PARENTS = (1, -1, 1, 2, 3, 4, 1, 6, 7, 8, 9, 1, 11, 12, 13, 14, 1, 16, 17, 18, 19, 1, 21, 22, 23, 24)
FINGERS = ('thumb', 'index', 'middle', 'ring', 'little')
WRIST_END = 0.030  # where the hand ends, hidden in the sleeve (arms.py), metres behind the wrist


@dataclass
class Skeleton:
    names: list
    positions: np.ndarray  # 26 x 3
    turns: np.ndarray      # 26 x 3 x 3, columns are the joint's axes
    radii: np.ndarray

    def index(self, name):
        return self.names.index(name)

    def at(self, name):
        return self.positions[self.index(name)]

    def local(self, name, p):
        """x right, y out of the back, z backwards from the joint, metres."""
        i = self.index(name)
        return (p - self.positions[i]) @ self.turns[i]

    def chain(self, finger):
        """Joint numbers from the metacarpal to the tip."""
        return [i for i, name in enumerate(self.names) if name.startswith(finger + '_')]


def read_skeleton(path, left=False):
    """The rest pose: -Z towards the next joint, +Y as near to `up` as can be; a tip turns as its parent does."""
    joints = json.loads(path.read_text())['joints']
    flip = np.array([-1.0 if left else 1.0, 1, 1])
    names = [j['name'] for j in joints]
    positions = np.array([j['position'] for j in joints]) * flip
    turns = np.zeros((len(joints), 3, 3))
    for i, j in enumerate(joints):
        if not j['towards']:
            turns[i] = turns[PARENTS[i]]
            continue
        z = -unit(positions[names.index(j['towards'])] - positions[i])
        x = unit(np.cross(np.array(j['up'], float) * flip, z))
        turns[i] = np.stack([x, np.cross(z, x), z], -1)
    return Skeleton(names, positions, turns, np.array([j['radius'] for j in joints]))


def finger_field(hand, finger, p):
    chain = hand.chain(finger)
    thumb = finger == 'thumb'
    at = hand.positions[chain]
    r = hand.radii[chain].copy()
    field = np.full(len(p), 1e3)
    start = 0 if thumb else 1
    for k in range(start, len(chain) - 1):
        i = chain[k]
        turn = hand.turns[i]
        back = turn[:, 1]
        last = k == len(chain) - 2
        a, b, ra, rb = at[k], at[k + 1], r[k], r[k + 1]
        if thumb and k == 0:
            ra, rb = 0.0125, 0.0118
        if last:
            b = b + unit(b - a) * -0.0012
        bone = capsule(p, a, b, ra * 0.93, rb * 0.95)
        field = smooth_min(field, bone, 0.004)
        middle = a + (b - a) * (0.56 if last else 0.5)
        long = np.linalg.norm(b - a)
        # the pad: soft flesh on the palm's side of each bone
        if last:
            pad = ellipsoid(p, middle - back * ra * 0.26, (ra * 0.90, ra * 0.74, long * 0.54), turn)
        else:
            pad = ellipsoid(p, middle - back * ra * 0.20, (ra * 0.93, ra * 0.88, long * 0.42), turn)
        if not (thumb and k == 0):
            field = smooth_min(field, pad, 0.004)
        # the knuckle at the bone's head
        if k > start or thumb and k > 0:
            knuckle = ellipsoid(p, a + back * ra * 0.16, (ra * 1.0, ra * 0.86, ra * 0.95), turn)
            field = smooth_min(field, knuckle, 0.0035)
        if last:  # the nail's bed flattens the back of the tip
            q = (p - b) @ turn
            flat = q[:, 1] - (rb * 0.86 - 18.0 * q[:, 0] ** 2 + 0.05 * q[:, 2])
            ahead = np.clip((q[:, 2] - 0.009) / 0.006, 0, 1)
            field = smooth_max(field, flat - 0.01 * ahead, 0.002)
    return field


def palm_field(hand, p):
    at = hand.at
    field = np.full(len(p), 1e3)
    # the metacarpals and the flesh between them
    for finger, ra, rb in (('index', 0.0128, 0.0112), ('middle', 0.0135, 0.0114), ('ring', 0.0130, 0.0106),
                           ('little', 0.0122, 0.0094)):
        a, b = at(f'{finger}_metacarpal'), at(f'{finger}_proximal')
        bone = capsule(p, a + [0, -0.003, 0.006], b + [0, -0.0032, 0], ra, rb)
        field = smooth_min(field, bone, 0.012)
    for finger, r in (('index', 0.0088), ('middle', 0.0092), ('ring', 0.0084), ('little', 0.0074)):
        b = at(f'{finger}_proximal')
        field = smooth_min(field, ellipsoid(p, b + [0, 0.0028, 0.002], (r, r * 0.92, r * 1.2)), 0.006)
    # the carpals
    field = smooth_min(field, ellipsoid(p, np.array([-0.001, -0.002, -0.012]), (0.0315, 0.0172, 0.030)), 0.012)
    # the heel of the thumb, the heel of the little finger, the pads below the fingers
    a, b = at('thumb_metacarpal'), at('thumb_proximal')
    thenar_axis = unit(b - a)
    side = unit(np.cross([0, 1, 0], thenar_axis))
    turn = np.stack([side, np.cross(thenar_axis, side), thenar_axis], -1)
    field = smooth_min(field, ellipsoid(p, a * 0.48 + b * 0.52 + [0.006, -0.0055, 0], (0.0165, 0.0150, 0.0285), turn), 0.010)
    field = smooth_min(field, ellipsoid(p, np.array([0.0225, -0.0095, -0.040]), (0.0125, 0.0125, 0.031)), 0.010)
    field = smooth_min(field, ellipsoid(p, np.array([0.004, -0.0085, -0.083]), (0.034, 0.0095, 0.0120)), 0.008)
    # the hollow of the hand
    field = smooth_max(field, -ellipsoid(p, np.array([0.003, -0.0285, -0.058]), (0.015, 0.0150, 0.026)), 0.010)
    # webs between the fingers
    for f, g, t in (('index', 'middle', 0.27), ('middle', 'ring', 0.28), ('ring', 'little', 0.27)):
        a = at(f'{f}_proximal') * (1 - t) + at(f'{f}_intermediate') * t
        b = at(f'{g}_proximal') * (1 - t) + at(f'{g}_intermediate') * t
        field = smooth_min(field, capsule(p, a - [0, 0.0025, -0.003], b - [0, 0.0025, -0.003], 0.0048, 0.0048), 0.007)
    # the fold between thumb and forefinger
    a0, b0 = at('thumb_metacarpal') * 0.35 + at('thumb_proximal') * 0.65, at('index_metacarpal') * 0.45 + at('index_proximal') * 0.55
    a1, b1 = at('thumb_proximal') * 0.93 + at('thumb_distal') * 0.07, at('index_metacarpal') * 0.15 + at('index_proximal') * 0.85
    for t, r in ((0.0, 0.0115), (0.5, 0.0090), (1.0, 0.0058)):
        a, b = a0 * (1 - t) + a1 * t, b0 * (1 - t) + b1 * t
        a = a + (b - a) * 0.1
        field = smooth_min(field, capsule(p, a, b - [0, 0.004, 0], r, r), 0.010)
    # the wrist and a stub of forearm
    arm = capsule(p, np.array([0.0, -0.001, 0.055]), np.array([0.0, -0.002, -0.008]), 0.0262, 0.0275,
                  np.array([1.0, 1.38, 1.0]))
    field = smooth_min(field, arm, 0.014)
    field = smooth_min(field, ellipsoid(p, np.array([0.0200, 0.0050, 0.011]), (0.0070, 0.0076, 0.010)), 0.010)
    return field


def hand_field(hand):
    def field(p):
        p = np.asarray(p, float)
        fingers = finger_field(hand, FINGERS[1], p)
        for finger in FINGERS[2:]:  # little fillet here, or the gaps between fingers would fill
            fingers = smooth_min(fingers, finger_field(hand, finger, p), 0.002)
        f = smooth_min(palm_field(hand, p), fingers, 0.006)
        f = smooth_min(f, finger_field(hand, FINGERS[0], p), 0.008)
        return smooth_max(f, p[:, 2] - WRIST_END, 0.008)
    return field
