// Lines and dots seen from above: one instance is a capsule from a to b, a dot where a = b.
// The quad is a pixel wider than the capsule; the edge is smoothed by its distance, on top of MSAA.

struct Varyings {
  @builtin(position) clip: vec4f,
  // Along and across the capsule, device pixels
  @location(0) local: vec2f,
  // x length, y half width, device pixels
  @location(1) shape: vec2f,
  @location(2) color: vec4f,
}

@vertex
fn vs_main(
  @builtin(vertex_index) index: u32,
  @location(0) ends: vec4f,
  @location(1) color: vec4f,
  // x width in CSS pixels, y the cell size below which it fades, px of the image
  @location(2) style: vec2f,
) -> Varyings {
  let viewport = globals.tile.zw;
  let to_pixels = globals.plan.zw * viewport * 0.5;
  let a = (ends.xy - globals.plan.xy) * to_pixels;
  let b = (ends.zw - globals.plan.xy) * to_pixels;
  let span = length(b - a);
  let along = select((b - a) / max(span, 0.0001), vec2f(1.0, 0.0), span < 0.0001);
  let across = vec2f(-along.y, along.x);
  // A mark is never wider than a third of its cell, so that distant diagrams stay open.
  let cell = style.y * to_pixels.y;
  let half_width = 0.5 * min(style.x * globals.eye.w, max(cell * 0.3, 0.7));
  let corner = vec2f(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
  let reach = half_width + 1.0;
  let local = vec2f(select(-reach, span + reach, corner.x > 0.0), corner.y * reach);

  var out: Varyings;
  out.clip = vec4f((a + along * local.x + across * local.y) * 2.0 / viewport, 0.5, 1.0);
  out.local = local;
  out.shape = vec2f(span, half_width);
  // Below four CSS pixels per cell lines would close to a slab: they thin out instead.
  out.color = vec4f(srgb_to_linear(color.rgb), color.a * clamp(cell / (4.0 * globals.eye.w), 0.12, 1.0));
  return out;
}

@fragment
fn fs_main(
  @builtin(position) pixel: vec4f,
  @location(0) local: vec2f,
  @location(1) shape: vec2f,
  @location(2) color: vec4f,
) -> @location(0) vec4f {
  let past = local.x - clamp(local.x, 0.0, shape.x);
  let cover = clamp(shape.y + 0.5 - length(vec2f(past, local.y)), 0.0, 1.0);
  return vec4f(finish(color.rgb, pixel.xy).rgb, color.a * cover);
}
