// A log and wood ears in the papers' style: smooth and matte; flesh is told from wood by what is painted of it.

struct Varyings {
  @builtin(position) clip: vec4f,
  @location(0) from_eye: vec3f,
  @location(1) color: vec3f,
  @location(2) normal: vec3f,
}

@vertex
fn vs_main(@location(0) position: vec3f, @location(1) painted: vec4f, @location(2) normal: vec2f) -> Varyings {
  var out: Varyings;
  out.from_eye = position - globals.eye.xyz;
  out.clip = globals.clip_from_eye * vec4f(out.from_eye, 1.0);
  out.color = wood_color(painted);
  out.normal = unfolded(normal);
  return out;
}

@fragment
fn fs_main(
  @builtin(position) pixel: vec4f,
  @location(0) from_eye: vec3f,
  @location(1) color: vec3f,
  @location(2) given: vec3f,
) -> @location(0) vec4f {
  let flat = cross(dpdx(from_eye), dpdy(from_eye));
  let face = select(flat, -flat, dot(flat, from_eye) > 0.0);
  let normal = normalize(given);
  let lit = shade(color, from_eye + globals.eye.xyz, select(normal, -normal, dot(normal, face) < 0.0), pixel.xy);
  return finish(lit * mix(1.0, 0.3, globals.ray_forward.w), pixel.xy);
}
