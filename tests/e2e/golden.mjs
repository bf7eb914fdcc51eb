// The golden hash from JavaScript: for Node and browsers, without imports, so that a page can load it as it is.

/**
 * SHA-256 of all buffers of a field, in hexadecimal; the order of the bytes is described in tests/golden.rs.
 *
 * @param {import('../../www/data/field.ts').Field} field
 * @returns {Promise<string>}
 */
export async function hashField(field) {
  const buffers = [
    ...field.layers.flatMap(({ sites, cellStarts, cellVertices, selected }) => [sites, cellStarts, cellVertices, selected]),
    field.positions,
    field.normals,
    field.indices,
    field.rockStarts,
    field.vertexStarts,
    field.rockLayer,
  ];
  return hashOf(buffers);
}

/**
 * SHA-256 of the buffers of a colony; the order of the bytes is described in tests/wood_ear_properties.rs.
 *
 * @param {import('../../www/data/colony.ts').WoodEarColony} colony
 * @returns {Promise<string>}
 */
export function hashColony({ positions, normals, indices, individualStarts, vertexStarts, foot, size, base, log }) {
  return hashOf([
    positions,
    normals,
    indices,
    individualStarts,
    vertexStarts,
    foot,
    size,
    base,
    log.positions,
    log.normals,
    log.indices,
    log.kinds,
  ]);
}

async function hashOf(buffers) {
  const bytes = new Uint8Array(buffers.reduce((sum, { byteLength }) => sum + byteLength, 0));
  let at = 0;
  for (const { buffer, byteOffset, byteLength } of buffers) {
    // Typed arrays are little-endian on every machine a browser runs on.
    bytes.set(new Uint8Array(buffer, byteOffset, byteLength), at);
    at += byteLength;
  }
  const digest = await crypto.subtle.digest('SHA-256', bytes);
  return Array.from(new Uint8Array(digest), (byte) => byte.toString(16).padStart(2, '0')).join('');
}
