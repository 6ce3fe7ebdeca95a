"""The skeleton of a fish: a spine that bends sideways, and joints at fins and jaw."""

from dataclasses import dataclass, field

import numpy as np

import paint
from mesh import strongest_four

SPINE_S = (0.0, 0.20, 0.32, 0.43, 0.53, 0.62, 0.71, 0.80, 0.89)


@dataclass
class Rig:
    """Spine joints from the snout to the tail fin; each turns what lies behind it about Y."""
    length: float
    s: tuple = SPINE_S
    extra: list = field(default_factory=list)  # (name, parent spine joint, position in metres)

    @property
    def names(self):
        return [f'spine_{i}' for i in range(len(self.s))] + [e[0] for e in self.extra]

    @property
    def positions(self):
        spine = [np.array([0, 0, (0.5 - s) * self.length]) for s in self.s]
        return spine + [np.asarray(e[2], float) for e in self.extra]

    def weights(self, points):
        """Each point follows the two nearest segments; half and half at the joint between them."""
        s = 0.5 - points[:, 2] / self.length
        ends = np.append(self.s, 1.0)
        middles = 0.5 * (ends[:-1] + ends[1:])
        w = np.zeros((len(points), len(self.names)))
        k = np.clip(np.searchsorted(middles, s) - 1, 0, len(middles) - 2)
        t = paint.step(0, 1, (s - middles[k]) / (middles[k + 1] - middles[k]))
        rows = np.arange(len(points))
        w[rows, k] = 1 - t
        w[rows, k + 1] += t
        return w

    def bind(self, part):
        """part.follow, if there: joint name -> how much each vertex follows it instead of the spine, 0..1."""
        w = self.weights(part.positions)
        for joint, share in getattr(part, 'follow', {}).items():
            w *= 1 - share[:, None]
            w[:, self.names.index(joint)] += share
        part.joints, part.weights = strongest_four(w)
        return part

    def bind_rigid(self, part, joint):
        part.joints = np.zeros((len(part.positions), 4), int)
        part.joints[:, 0] = joint
        part.weights = np.tile(np.array([1, 0, 0, 0], '<f4'), (len(part.positions), 1))
        return part

    def bind_fin(self, part, joint):
        """A fin follows the spine, or swings with its joint from its root on (part.reach: 0 root, 1 edge)."""
        w = self.weights(part.positions)
        if joint:
            t = paint.step(0.02, 0.3, part.reach)
            root = w[np.argmin(part.reach)]
            w = root * (1 - t)[:, None]
            w[:, self.names.index(joint)] = t
        part.joints, part.weights = strongest_four(w)
        return part

    def add_nodes(self, glb, ahead=0.0):
        """Returns node indices of the joints and the skin; each spine joint hangs on the one before it. ahead: metres
        by which the whole animal is moved along +Z."""
        root = glb.node('root', translation=[0, 0, ahead])
        nodes, at = [], self.positions
        for i in range(len(self.s)):
            nodes.append(glb.node(self.names[i], nodes[-1] if nodes else root, at[i] - (at[i - 1] if i else 0)))
        for name, parent, p in self.extra:
            nodes.append(glb.node(name, nodes[parent], np.asarray(p) - at[parent]))
        binds = []
        for p in at:
            m = np.eye(4)
            m[:3, 3] = -np.asarray(p, '<f4').astype(float)
            binds.append(m)
        return nodes, glb.skin(nodes, binds, root)

    def bend(self, lateral, duration, keys):
        """Rotations that lay the midline on x = lateral(s, phase in 0..1), and the snout's sideways travel, metres.

        Segments keep their length: sin(angle) = -dx / length, as a turn by +angle about Y takes -Z towards -X.
        """
        phase = np.linspace(0, 1, keys + 1)
        ends = np.append(self.s, 1.0)
        x = np.stack([lateral(s, phase) for s in ends], -1) * self.length
        slope = np.diff(x, axis=1) / (np.diff(ends) * self.length)
        angle = -np.arcsin(np.clip(slope, -0.95, 0.95))
        turn = np.diff(np.concatenate([np.zeros((keys + 1, 1)), angle], 1), axis=1)
        return phase * duration, x[:, 0], turn


