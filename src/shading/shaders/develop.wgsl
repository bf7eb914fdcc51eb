// A still as a picture: the mean of its samples, as opaque as `globals.scene.y` over what is there.

@group(2) @binding(0) var mean: texture_2d<f32>;

@vertex
fn vs_main(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
  return vec4f(vec2f(f32((index << 1u) & 2u), f32(index & 2u)) * 2.0 - 1.0, 0.0, 1.0);
}

@fragment
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
  let picture = shown_as(toned(textureLoad(mean, vec2i(pixel.xy), 0).rgb), pixel.xy);
  return vec4f(picture.rgb, globals.scene.y);
}
