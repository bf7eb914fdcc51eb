// Adds a piece of a sample, which has its upper left corner at `globals.plan`, to the mean of those before it.

@group(2) @binding(0) var mean: texture_2d<f32>;
@group(2) @binding(1) var sample: texture_2d<f32>;

@vertex
fn vs_main(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
  return vec4f(vec2f(f32((index << 1u) & 2u), f32(index & 2u)) * 2.0 - 1.0, 0.0, 1.0);
}

@fragment
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
  let at = vec2i(pixel.xy);
  // A glint brighter than white by so much would be seen as a speck in a thousand samples.
  let found = clamp(textureLoad(sample, at - vec2i(globals.plan.xy), 0), vec4f(0.0), vec4f(32.0));
  return mix(textureLoad(mean, at, 0), found, globals.scene.y);
}
