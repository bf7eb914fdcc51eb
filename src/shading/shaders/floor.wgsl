// The depth of z = 0 alone, which hides what is below it. In natural colours it comes before everything else, so that nothing is shaded
// that the ground hides; its colour comes last, by natural_ground.wgsl. In the papers' style its colour was drawn before, by ground.wgsl.

struct Varyings {
  @builtin(position) @invariant clip: vec4f,
}

@vertex
fn vs_main(@builtin(vertex_index) index: u32) -> Varyings {
  return Varyings(ground_clip(vec2f(f32((index << 1u) & 2u), f32(index & 2u)) * 2.0 - 1.0));
}

@fragment
fn fs_main() -> @location(0) vec4f {
  return vec4f(0.0);
}
