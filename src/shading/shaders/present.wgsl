// Shows a picture that was drawn before, as large as what it is drawn on. It stands alone: nothing is prepended.

@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var filtering: sampler;

struct Varyings {
  @builtin(position) clip: vec4f,
  @location(0) place: vec2f,
}

@vertex
fn vs_main(@builtin(vertex_index) index: u32) -> Varyings {
  let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
  return Varyings(vec4f(corner * 2.0 - 1.0, 0.0, 1.0), vec2f(corner.x, 1.0 - corner.y));
}

@fragment
fn fs_main(varyings: Varyings) -> @location(0) vec4f {
  return textureSample(picture, filtering, varyings.place);
}
