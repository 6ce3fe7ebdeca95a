"""Writes glTF 2.0 binary files: one buffer, embedded images. Same input, same bytes."""

import json
import struct

import numpy as np

COMPONENT = {np.dtype('<f4'): 5126, np.dtype('<u2'): 5123, np.dtype('<u4'): 5125, np.dtype('u1'): 5121}
KIND = {1: 'SCALAR', 2: 'VEC2', 3: 'VEC3', 4: 'VEC4', 16: 'MAT4'}


class Glb:
    def __init__(self):
        self.binary = bytearray()
        self.json = {'asset': {'version': '2.0', 'generator': 'shoal make_models'}, 'scene': 0,
                     'scenes': [{'nodes': []}]}

    def _append(self, key, value):
        return self.json.setdefault(key, []).append(value) or len(self.json[key]) - 1

    def _view(self, data, target=None):
        self.binary.extend(b'\0' * (-len(self.binary) % 4))
        view = {'buffer': 0, 'byteOffset': len(self.binary), 'byteLength': len(data)}
        if target:
            view['target'] = target
        self.binary.extend(data)
        return self._append('bufferViews', view)

    def accessor(self, array, dtype='<f4', target=None, bounds=False, normalized=False):
        a = np.ascontiguousarray(array, dtype=dtype)
        width = 1 if a.ndim == 1 else int(np.prod(a.shape[1:]))
        item = {'bufferView': self._view(a.tobytes(), target), 'componentType': COMPONENT[a.dtype],
                'count': len(a), 'type': KIND[width]}
        if normalized:
            item['normalized'] = True
        if bounds:
            flat = a.reshape(len(a), width)
            item['min'] = [float(v) for v in flat.min(0)]
            item['max'] = [float(v) for v in flat.max(0)]
        return self._append('accessors', item)

    def texture(self, encoded):
        """encoded: PNG or JPEG bytes."""
        mime = 'image/png' if encoded[:4] == b'\x89PNG' else 'image/jpeg'
        image = self._append('images', {'bufferView': self._view(encoded), 'mimeType': mime})
        sampler = {'magFilter': 9729, 'minFilter': 9987, 'wrapS': 33071, 'wrapT': 33071}
        known = self.json.setdefault('samplers', [])
        if sampler not in known:
            known.append(sampler)
        return self._append('textures', {'sampler': known.index(sampler), 'source': image})

    def material(self, name, base, normal=None, metal_rough=None, rough=1.0, metal=1.0, blend=False, glow=None):
        """base: texture index or linear RGBA; metal_rough: texture index (G roughness, B metallic); glow: texture index of
        what it emits."""
        pbr = {'metallicFactor': metal, 'roughnessFactor': rough}
        if isinstance(base, int):
            pbr['baseColorTexture'] = {'index': base}
        else:
            pbr['baseColorFactor'] = list(base)
        if metal_rough is not None:
            pbr['metallicRoughnessTexture'] = {'index': metal_rough}
        item = {'name': name, 'pbrMetallicRoughness': pbr}
        if normal is not None:
            item['normalTexture'] = {'index': normal, 'scale': 1.0}
        if glow is not None:
            item['emissiveTexture'], item['emissiveFactor'] = {'index': glow}, [1.0, 1.0, 1.0]
        if blend:
            item['alphaMode'] = 'BLEND'
        return self._append('materials', item)

    def primitive(self, part, material, compact=False):
        """part: a mesh.Part with weights as (joint indices, weights), four to a vertex. compact: weights and uvs as
        integers."""
        vertex = 34962
        attributes = {'POSITION': self.accessor(part.positions, target=vertex, bounds=True),
                      'NORMAL': self.accessor(part.normals, target=vertex),
                      'TANGENT': self.accessor(part.tangents, target=vertex)}
        if part.uvs is not None:
            uvs = np.round(part.uvs * 65535) if compact else part.uvs
            attributes['TEXCOORD_0'] = self.accessor(uvs, '<u2' if compact else '<f4', vertex, normalized=compact)
        attributes['JOINTS_0'] = self.accessor(part.joints, 'u1', vertex)
        weights = part.weights
        if compact:  # the heaviest takes the rounding, so that they sum to one
            weights = np.round(part.weights * 255)
            weights[:, 0] += 255 - weights.sum(1)
        attributes['WEIGHTS_0'] = self.accessor(weights, 'u1' if compact else '<f4', vertex, normalized=compact)
        small = len(part.positions) < 65535
        indices = self.accessor(part.triangles.reshape(-1), '<u2' if small else '<u4', 34963)
        return {'attributes': attributes, 'indices': indices, 'material': material}

    def variants(self, names, primitive):
        """The primitive wears material k as variant names[k] (KHR_materials_variants)."""
        self.json['extensionsUsed'] = ['KHR_materials_variants']
        self.json['extensions'] = {'KHR_materials_variants': {'variants': [{'name': name} for name in names]}}
        primitive['extensions'] = {'KHR_materials_variants': {
            'mappings': [{'material': k, 'variants': [k]} for k in range(len(names))]}}

    def node(self, name, parent=None, translation=None, rotation=None, **more):
        item = {'name': name, **more}
        if translation is not None and np.any(np.asarray(translation)):
            item['translation'] = [float(v) for v in np.asarray(translation, '<f4')]
        if rotation is not None:
            item['rotation'] = [float(v) for v in np.asarray(rotation, '<f4')]
        index = self._append('nodes', item)
        if parent is None:
            self.json['scenes'][0]['nodes'].append(index)
        else:
            self.json['nodes'][parent].setdefault('children', []).append(index)
        return index

    def mesh(self, name, primitives):
        return self._append('meshes', {'name': name, 'primitives': primitives})

    def skin(self, joints, inverse_binds, skeleton):
        """inverse_binds: (n, 4, 4), row major as numpy has them; stored column major."""
        matrices = self.accessor(np.transpose(np.asarray(inverse_binds), (0, 2, 1)).reshape(-1, 16))
        return self._append('skins', {'inverseBindMatrices': matrices, 'joints': joints,
                                      'skeleton': skeleton})

    def animation(self, name, times, channels):
        """channels: list of (node, 'rotation' | 'translation' | 'scale', values of one per time)."""
        clock = self.accessor(times, bounds=True)
        item = {'name': name, 'samplers': [], 'channels': []}
        for node, path, values in channels:
            item['channels'].append({'sampler': len(item['samplers']),
                                     'target': {'node': node, 'path': path}})
            item['samplers'].append({'input': clock, 'interpolation': 'LINEAR',
                                     'output': self.accessor(values)})
        self._append('animations', item)

    def save(self, path):
        self.binary.extend(b'\0' * (-len(self.binary) % 4))
        self.json['buffers'] = [{'byteLength': len(self.binary)}]
        text = json.dumps(self.json, separators=(',', ':'), sort_keys=True).encode()
        text += b' ' * (-len(text) % 4)
        total = 12 + 8 + len(text) + 8 + len(self.binary)
        with open(path, 'wb') as file:
            file.write(struct.pack('<4sII', b'glTF', 2, total))
            file.write(struct.pack('<I4s', len(text), b'JSON') + text)
            file.write(struct.pack('<I4s', len(self.binary), b'BIN\0') + bytes(self.binary))
        return total
