// Filled cells seen from above.

struct Varyings {
  @builtin(position) clip: vec4f,
  @location(0) color: vec3f,
}

@vertex
fn vs_main(@location(0) position: vec2f, @location(1) color: vec4f) -> Varyings {
  var out: Varyings;
  out.clip = vec4f((position - globals.plan.xy) * globals.plan.zw, 0.5, 1.0);
  out.color = srgb_to_linear(color.rgb);
  return out;
}

@fragment
fn fs_main(@builtin(position) pixel: vec4f, @location(0) color: vec3f) -> @location(0) vec4f {
  return finish(color, pixel.xy);
}
