// Every edge of a log and of wood ears as a line, over the dimmed fill.

struct Varyings {
  @builtin(position) clip: vec4f,
  @location(0) color: vec3f,
}

@vertex
fn vs_main(@location(0) position: vec3f, @location(1) painted: vec4f) -> Varyings {
  var out: Varyings;
  out.clip = globals.clip_from_eye * vec4f(position - globals.eye.xyz, 1.0);
  // As in wire.wgsl, but less white: the lines lie closer.
  out.color = mix(wood_color(painted), vec3f(1.0), 0.1);
  return out;
}

@fragment
fn fs_main(@builtin(position) pixel: vec4f, @location(0) color: vec3f) -> @location(0) vec4f {
  return finish(color, pixel.xy);
}
