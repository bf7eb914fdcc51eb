// The papers' style, where something goes on below the ground: the depth of z = 0 alone, which hides it. The colour was drawn
// by ground.wgsl.

@vertex
fn vs_main(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
  return ground_clip(vec2f(f32((index << 1u) & 2u), f32(index & 2u)) * 2.0 - 1.0);
}

@fragment
fn fs_main() -> @location(0) vec4f {
  return vec4f(0.0);
}
