"""Both hands, skinned to the 26 joints of OpenXR. The left one is the right one's mirror image."""

import numpy as np

import paint
import surface
from glb import Glb
from hand_glove import Glove
from hand_shape import FINGERS, PARENTS, WRIST_END, hand_field, read_skeleton
from hand_skin import HandSkin
from mesh import Part, facing, mirrored, strongest_four, tangent_frame, unit

TEXELS = 1024
CELL = (0.0048, 0.0046, 0.0057)  # metres; fingers run along z


def weights(hand, p):
    """Each point follows the bones of the nearest finger, blended across joints over about a finger's thickness."""
    n = len(hand.names)
    distance, chains = [], []
    for finger in FINGERS:
        chain = hand.chain(finger)
        at = hand.positions[chain]
        best, rows = np.full(len(p), 1e3), np.zeros((len(p), n))
        for k in range(len(chain) - 1):
            axis = at[k + 1] - at[k]
            t = np.clip((p - at[k]) @ axis / (axis @ axis), 0, 1)
            r = hand.radii[chain[k]] * (1 - t) + hand.radii[chain[k + 1]] * t
            best = np.minimum(best, np.linalg.norm(p - at[k] - t[:, None] * axis, axis=1) - r)
        # how far past each joint: 0 before, 1 after, along the mean direction of the bones that meet there
        passed = []
        for k in range(1, len(chain) - 1):
            into, out = unit(at[k] - at[k - 1]), unit(at[k + 1] - at[k])
            depth = (p - at[k]) @ unit(into + out)
            r = hand.radii[chain[k]]
            span = (1.5 if k == 1 else 0.95) * r
            shift = 0.25 * r if k == 1 else 0.0
            passed.append(paint.step(-span + shift, span + shift, depth))
        left = np.ones(len(p))
        for k in range(len(chain) - 2, 0, -1):
            rows[:, chain[k]] = left * passed[k - 1]
            left = left * (1 - passed[k - 1])
        rows[:, chain[0]] = left
        distance.append(best)
        chains.append(rows)
    distance = np.stack(distance, -1)
    near = distance - distance.min(1, keepdims=True)
    share = np.exp(-near / 0.0027) * paint.step(0.012, 0.004, near)
    # beyond the webs, skin follows one finger only
    for f, finger in enumerate(FINGERS[1:], 1):
        chain = hand.chain(finger)
        q = hand.local(hand.names[chain[1]], p)
        alone = paint.step(0.016, 0.025, -q[:, 2]) * (distance.argmin(1) == f)
        share = share * np.where(np.arange(5) == f, 1.0, 1 - alone[:, None])
    alone = paint.step(0.004, 0.014, -hand.local('thumb_proximal', p)[:, 2]) * (distance.argmin(1) == 0)
    share[:, 1:] *= 1 - alone[:, None]
    share /= share.sum(1, keepdims=True)
    w = sum(share[:, f:f + 1] * rows for f, rows in enumerate(chains))
    # skin behind the wrist follows the wrist
    wrist = paint.step(-0.022, 0.004, p[:, 2])
    w *= 1 - wrist[:, None]
    w[:, hand.index('wrist')] += wrist
    return w


def right_part(skeleton):
    """The mesh, and where in space its texels lie."""
    field = hand_field(skeleton)
    # the grid's origin is chosen so that its points fall into the narrow gaps between the fingers, and near the tips
    points, quads = surface.surface_nets(field, (-0.0967, -0.045, -0.209), (0.066, 0.036, WRIST_END + 0.008), CELL)
    points = surface.project(field, points, 2)
    points = surface.relax(field, points, quads)
    triangles = surface.split_quads(points, quads)
    normals = unit(surface.gradient(field, points, 4e-4))
    old, triangles, uv, u_axis, up_axis = surface.unfold(points, triangles, normals, TEXELS)
    p, n = points[old], normals[old]
    part = facing(Part(p, n, tangent_frame(n, u_axis, up_axis), uv, triangles))
    part.joints, part.weights = strongest_four(weights(skeleton, p))
    baked, mask = surface.bake(uv, triangles, np.concatenate([p, n, u_axis, up_axis], 1), TEXELS)
    return part, baked, mask


def painted(cover, baked, mask):
    """Colours by look, normal map and roughness of a cover (skin or glove)."""
    p, n = baked[mask][:, :3], unit(baked[mask][:, 3:6])
    up = n[:, 1]

    def sheet(values, empty):
        picture = np.ones((TEXELS, TEXELS, 3)) * empty
        picture[mask] = values
        return picture
    e = 1.2e-4
    here = cover.relief(p, up)
    u_axis, up_axis = baked[mask][:, 6:9], baked[mask][:, 9:12]
    t = unit(u_axis - n * (u_axis * n).sum(1, keepdims=True))
    b = np.cross(n, t)
    b = b * np.sign((b * up_axis).sum(1, keepdims=True))
    slope = unit(np.stack([-(cover.relief(p + e * t, up) - here) / e, -(cover.relief(p + e * b, up) - here) / e,
                           np.ones(len(p))], -1))
    rough = cover.rough(p, up)
    gloss = np.stack([np.ones_like(rough), rough, 0 * rough], -1)
    colours = {look: sheet(c, c.mean(0)) for look, c in cover.colours(p, up).items()}
    return colours, sheet(slope * 0.5 + 0.5, [0.5, 0.5, 1.0]), sheet(gloss, [1, 0.5, 0])


def turn_to_quaternion(m):
    """x y z w of a rotation matrix (Shepperd 1978)."""
    q = np.array([1 + m[0, 0] - m[1, 1] - m[2, 2], 1 - m[0, 0] + m[1, 1] - m[2, 2],
                  1 - m[0, 0] - m[1, 1] + m[2, 2], 1 + np.trace(m)])
    k = int(q.argmax())
    s = np.sqrt(q[k]) * 2
    a, b, c = (m[2, 1] - m[1, 2]) / s, (m[0, 2] - m[2, 0]) / s, (m[1, 0] - m[0, 1]) / s
    d, e, f = (m[0, 1] + m[1, 0]) / s, (m[0, 2] + m[2, 0]) / s, (m[1, 2] + m[2, 1]) / s
    return np.array([[s / 4, d, e, a], [d, s / 4, f, b], [e, f, s / 4, c], [a, b, c, s / 4]][k])


def write(folder, skeleton_file, names):
    part, baked, mask = right_part(read_skeleton(skeleton_file))
    looks = []  # name, colour, normal map and gloss, encoded
    for cover in (HandSkin, Glove):
        colours, normal, gloss = painted(cover(read_skeleton(skeleton_file)), baked, mask)
        shared = paint.jpeg(normal, 88), paint.jpeg(paint.shrink(gloss, 4), 90)
        looks += [(look, paint.jpeg(colour, 90), *shared) for look, colour in colours.items()]
    for name in names:
        left = name == 'hand_left'
        skeleton = read_skeleton(skeleton_file, left)
        mine = part
        if left:
            mine = mirrored(part)
            mine.joints, mine.weights = part.joints, part.weights
        glb, made = Glb(), {}
        for look, *maps in looks:
            for encoded in maps:
                if encoded not in made:
                    made[encoded] = glb.texture(encoded)
            glb.material(look, *(made[encoded] for encoded in maps), metal=0.0)
        world = []
        for turn, at in zip(skeleton.turns, skeleton.positions):
            m = np.eye(4)
            m[:3, :3], m[:3, 3] = turn, at
            world.append(m)
        nodes = {}
        order = [PARENTS.index(-1)]
        for joint in order:
            order += [i for i, parent in enumerate(PARENTS) if parent == joint]
            parent = PARENTS[joint]
            local = world[joint] if parent < 0 else np.linalg.inv(world[parent]) @ world[joint]
            nodes[joint] = glb.node(skeleton.names[joint], nodes.get(parent), local[:3, 3],
                                    turn_to_quaternion(local[:3, :3]))
        binds = np.stack([np.linalg.inv(m) for m in world])
        binds[:, 3] = [0, 0, 0, 1]
        skin = glb.skin([nodes[i] for i in range(len(PARENTS))], binds, nodes[order[0]])
        primitive = glb.primitive(mine, 0)
        glb.variants([look for look, *_ in looks], primitive)
        glb.node(name, mesh=glb.mesh(name, [primitive]), skin=skin)
        yield name, glb.save(folder / f'{name}.glb'), len(mine.triangles), len(mine.positions)
