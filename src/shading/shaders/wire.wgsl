// Every edge of every triangle as a line, over the dimmed fill.

struct Varyings {
  @builtin(position) clip: vec4f,
  @location(0) color: vec3f,
}

@vertex
fn vs_main(@location(0) position: vec3f, @location(1) color: vec4f) -> Varyings {
  var out: Varyings;
  out.clip = globals.clip_from_eye * vec4f(position - globals.eye.xyz, 1.0);
  // Between the rock's colour and white: reads on the dimmed fill of any layer.
  out.color = mix(srgb_to_linear(color.rgb), vec3f(1.0), 0.22);
  return out;
}

@fragment
fn fs_main(@builtin(position) pixel: vec4f, @location(0) color: vec3f) -> @location(0) vec4f {
  return finish(color, pixel.xy);
}
