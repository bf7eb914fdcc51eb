// All rocks at once: faceted, two-sided, lit.

struct Varyings {
  @builtin(position) clip: vec4f,
  @location(0) from_eye: vec3f,
  @location(1) color: vec3f,
  // The same point, but never outside the triangle: at the edges of multisampled faces the pixel's
  // middle may lie inside the next rock, and would be lit as if it were buried.
  @location(2) @interpolate(perspective, centroid) inside: vec3f,
}

@vertex
fn vs_main(@location(0) position: vec3f, @location(1) color: vec4f) -> Varyings {
  var out: Varyings;
  out.from_eye = position - globals.eye.xyz;
  out.clip = globals.clip_from_eye * vec4f(out.from_eye, 1.0);
  out.inside = out.from_eye;
  out.color = srgb_to_linear(color.rgb);
  return out;
}

@fragment
fn fs_main(
  @builtin(position) pixel: vec4f,
  @location(0) from_eye: vec3f,
  @location(1) color: vec3f,
  @location(2) @interpolate(perspective, centroid) inside: vec3f,
) -> @location(0) vec4f {
  // The face's own normal, turned to the viewer: no winding and no provoking vertex is relied on.
  let face = normalize(cross(dpdx(from_eye), dpdy(from_eye)));
  let normal = select(face, -face, dot(face, from_eye) > 0.0);
  let lit = shade(color, inside + globals.eye.xyz, normal, pixel.xy);
  // In the wireframe view the fill stays legible but steps back.
  return finish(lit * mix(1.0, 0.3, globals.ray_forward.w), pixel.xy);
}
