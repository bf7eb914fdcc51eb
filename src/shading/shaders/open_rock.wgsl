// How much of the sky each vertex of the rocks sees, as the map of heights has it, and where moss likes to grow: found once for a field, since all
// pictures ask for it. A texel for each vertex, which pictures read with the other vertices' data (render/scene/open.rs).

// The vertices as buffers have them: three texels for a position, a normal as two 16-bit numbers, and what is painted.
@group(2) @binding(12) var positions: texture_2d<u32>;
@group(2) @binding(13) var normals: texture_2d<u32>;
@group(2) @binding(14) var colors: texture_2d<u32>;

@vertex
fn vs_main(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
  return vec4f(vec2f(f32((index << 1u) & 2u), f32(index & 2u)) * 2.0 - 1.0, 0.0, 1.0);
}

// As open.wgsl: R the share, GB towards where. A what `mossy` has.
@fragment
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
  let vertex = vec2i(pixel.xy);
  let x = vec2i(3 * vertex.x, vertex.y);
  let position = bitcast<vec3f>(vec3u(
    textureLoad(positions, x, 0).r,
    textureLoad(positions, x + vec2i(1, 0), 0).r,
    textureLoad(positions, x + vec2i(2, 0), 0).r,
  ));
  let painted = f32(textureLoad(colors, vertex, 0).r >> 24u) / 255.0;
  // Below the ground it is as dark as just above it, or the rocks would be too dark all along their feet.
  var at = settled(position, vec4f(painted));
  let moss = mossy(at);
  at.z = max(at.z, 0.0);
  let seen = sky_seen(at, normalize(unfolded(unpack2x16snorm(textureLoad(normals, vertex, 0).r))), 12);
  return vec4f(seen, open_towards.xy * 0.25 + 0.5, 0.5 + 0.5 * moss / MOSSIEST);
}
