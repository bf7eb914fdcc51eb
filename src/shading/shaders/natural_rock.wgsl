// All rocks at once, in natural colours.

struct Varyings {
  @builtin(position) clip: vec4f,
  @location(0) from_eye: vec3f,
  // Three random numbers of the rock, and its kind / 255
  @location(1) own: vec4f,
  @location(2) normal: vec3f,
  // As in rock.wgsl: the same point, but never outside the triangle
  @location(3) @interpolate(perspective, centroid) inside: vec3f,
}

@vertex
fn vs_main(@location(0) position: vec3f, @location(1) color: vec4f, @location(2) normal: vec2f) -> Varyings {
  var out: Varyings;
  out.from_eye = settled(position, color) - globals.eye.xyz;
  out.clip = globals.clip_from_eye * vec4f(out.from_eye, 1.0);
  out.inside = out.from_eye;
  // The same rock of two copies has other colours.
  out.own = vec4f(fract(color.xyz + field.shift.w * vec3f(1.0, 1.7, 2.3)), kind_of(color) / 255.0);
  out.normal = unfolded(normal);
  return out;
}

@fragment
fn fs_main(
  @builtin(position) pixel: vec4f,
  @location(0) from_eye: vec3f,
  @location(1) own: vec4f,
  @location(2) normal: vec3f,
  @location(3) @interpolate(perspective, centroid) inside: vec3f,
) -> @location(0) vec4f {
  let across = dpdx(from_eye);
  let down = dpdy(from_eye);
  let flat = normalize(cross(across, down));
  let face = select(flat, -flat, dot(flat, from_eye) > 0.0);
  let smooth_normal = normalize(normal);
  let turn_x = dpdx(smooth_normal);
  let turn_y = dpdy(smooth_normal);
  let agree = agreement(smooth_normal, face);
  let base = normalize(mix(face, smooth_normal, agree));

  let world = inside + globals.eye.xyz;
  let far = length(from_eye);
  let to_eye = -from_eye / far;
  let footprint = footprint_of(across, down);
  // From afar, and copies always, rocks have fewer triangles than the maps, which would shade what lies lower for it.
  let coarse = max(footprint - select(0.7, 0.0, field.shift.w > 0.0), 0.0);
  let home = at_home(world, field.shift.xyz) + base * (2.0 * coarse);
  let seen = sky_seen(home, base);
  let wear = worn(across, down, turn_x, turn_y) * agree;
  rock_surface(world, own, base, wear, seen, footprint);

  // A rim turned away by less than its relief would be lit from behind.
  let towards = normalize(surface_normal + to_eye * max(0.0, 0.02 - dot(surface_normal, to_eye)));
  // What turns faster than the pixels can show scatters (Kaplanyan et al., Filtering distributions of normals, 2016).
  let spread = min(0.5 * (dot(turn_x, turn_x) + dot(turn_y, turn_y)) * agree, 0.18);
  let square = surface_rough * surface_rough;
  let rough = sqrt(sqrt(min(square * square + spread, 1.0)));
  let light = daylight(surface_albedo, rough, home, base, towards, to_eye, seen);
  return developed(light, from_eye, pixel.xy);
}
