"""A loose thing, written as glTF: skins over grids of places, one sheet of pictures, a few joints, clips."""

from dataclasses import dataclass

import numpy as np

import paint
from glb import Glb
from mesh import Part, facing, grid_triangles, join, strongest_four, tangent_frame, unit, without_slivers

PAD = 4  # texels of a tile beyond its edge, painted as if the surface went on, for the smaller mip levels
LEAST_ROUGH = 0.3  # as on all animals: a smoother surface would want sharper maps of the light, which take time
GONE = 0.001  # scale of a node that is not there; not 0, which would leave its occluding ellipsoids without axes


def skin(place, columns, rows, away, closed=False):
    """A smooth skin over place(u, v) at these u and v. away: which way its normals point, for each place or for all;
    closed: its last column is the first again."""
    u, v = np.meshgrid(columns, rows)
    p = place(u, v)
    down, along = np.gradient(p, axis=0), np.gradient(p, axis=1)
    if closed:
        p[:, -1] = p[:, 0]
        along[:, [0, -1]] = (p[:, [1]] - p[:, [-2]]) / 2
    n = unit(np.cross(down, along))
    for pole, beside in ((0, 1), (-1, -2)):
        if np.ptp(p[pole], axis=0).max() < 1e-6:
            n[pole] = unit(n[beside].mean(0))
    n = n * np.sign(np.sum(n * away))
    return facing(without_slivers(Part(p.reshape(-1, 3), n.reshape(-1, 3), tangent_frame(n, along, -down).reshape(-1, 4),
                                       np.stack([u, v], -1).reshape(-1, 2), grid_triangles(*u.shape))))


def both_sides(part):
    """The part and its other side: a draw of its own for two-sided materials takes longer than these vertices."""
    other = Part(part.positions, -part.normals, -part.tangents, part.uvs, part.triangles[:, ::-1])
    other.joints, other.weights = part.joints, part.weights
    return join([part, other])


def bound(part, joint):
    part.joints, part.weights = strongest_four(np.eye(joint + 4)[np.full(len(part.positions), joint)])
    return part


class Sheet:
    """Pictures of all parts: colour (sRGB), normals and roughness. A tile is x, y, width, height in texels."""

    def __init__(self, width, height):
        self.size = np.array([width, height])
        self.colour = np.ones((height, width, 3)) * 0.5
        self.normal = np.ones((height, width, 3)) * [0.5, 0.5, 1.0]
        self.gloss = np.ones((height, width, 3)) * [1.0, 0.5, 0.0]

    def paint(self, tile, place, painter):
        """painter(u, v, p): colour, relief in metres and roughness of the surface place(u, v), which may go on beyond 0..1."""
        x, y, w, h = tile
        u, v = np.meshgrid((np.arange(w) + 0.5 - PAD) / (w - 2 * PAD), (np.arange(h) + 0.5 - PAD) / (h - 2 * PAD))
        p = place(u, v)
        colour, relief, rough = painter(u, v, p)
        texel = [np.maximum(np.linalg.norm(np.gradient(p, axis=k), axis=-1), 1e-4) for k in (1, 0)]
        at = np.s_[y:y + h, x:x + w]
        self.colour[at], self.normal[at] = np.clip(colour, 0, 1), paint.normal_map(relief, *texel)
        self.gloss[at][..., 1] = np.clip(rough, LEAST_ROUGH, 1)

    def placed(self, part, tile):
        """The part with its uv, 0..1, squeezed into the tile."""
        x, y, w, h = tile
        part.uvs = (np.array([x, y]) + PAD + part.uvs * (np.array([w, h]) - 2 * PAD)) / self.size
        return part


@dataclass
class Thing:
    name: str
    joints: list   # (name, parent's number or None, place in metres, rest rotation)
    parts: list    # the body's, bound to joints
    sheet: Sheet
    weed: list     # the parts of the seaweed on which it drifts
    clips: list    # (name, duration, phases, {(joint's name, 'rotation' or 'scale'): values for each phase})

    def write(self, path):
        glb, nodes = Glb(), []
        binds = np.tile(np.eye(4), (len(self.joints), 1, 1))
        for k, (name, parent, place, turn) in enumerate(self.joints):
            offset = place if parent is None else place - self.joints[parent][2]
            nodes.append(glb.node(name, None if parent is None else nodes[parent], offset, turn))
            binds[k, :3, 3] = -np.asarray(place)
        pictures = [glb.texture(paint.jpeg(self.sheet.colour, 84)), glb.texture(paint.jpeg(self.sheet.normal, 80)),
                    glb.texture(paint.jpeg(paint.shrink(self.sheet.gloss, 4), 84))]
        whole = join(self.parts + [both_sides(part) for part in self.weed])
        primitive = glb.primitive(whole, glb.material(self.name, *pictures, metal=0.0), compact=True)
        glb.node(self.name, mesh=glb.mesh(self.name, [primitive]), skin=glb.skin(nodes, binds, nodes[0]))
        names = [joint[0] for joint in self.joints]
        for name, duration, phases, moved in self.clips:
            glb.animation(name, np.asarray(phases) * duration,
                          [(nodes[names.index(joint)], path, values) for (joint, path), values in moved.items()])
        return glb.save(path), len(whole.triangles), len(whole.positions)
