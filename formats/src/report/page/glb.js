"use strict";
// Reads the model of the page: a GLB with one node for each piece, and one named "body".

const ARRAYS = { 5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
const SIZES = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };

function bytesOf(base64) {
  const text = atob(base64.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

function readGlb(bytes) {
  const words = new DataView(bytes.buffer);
  const jsonLength = words.getUint32(12, true);
  const gltf = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + jsonLength)));
  const start = 28 + jsonLength;
  const view = (number) => {
    const v = gltf.bufferViews[number];
    return bytes.subarray(start + (v.byteOffset || 0), start + (v.byteOffset || 0) + v.byteLength);
  };
  const array = (number) => {
    const a = gltf.accessors[number];
    const data = view(a.bufferView);
    const Type = ARRAYS[a.componentType];
    return new Type(data.slice().buffer, 0, a.count * SIZES[a.type]);
  };
  const surfaces = gltf.nodes.map((node) => {
    const primitive = gltf.meshes[node.mesh].primitives[0];
    const at = {};
    for (const name in primitive.attributes) at[name] = array(primitive.attributes[name]);
    return { name: node.name, at, indices: array(primitive.indices), material: primitive.material };
  });
  const materials = (gltf.materials || []).map((m) => {
    const pbr = m.pbrMetallicRoughness;
    const info = pbr.baseColorTexture;
    const image = info && gltf.images[gltf.textures[info.index].source];
    const scale = info && info.extensions ? info.extensions.KHR_texture_transform.scale : [1, 1];
    return {
      colour: pbr.baseColorFactor || [1, 1, 1, 1],
      scale,
      image: image && new Blob([view(image.bufferView)], { type: image.mimeType }),
    };
  });
  return { surfaces, materials };
}
