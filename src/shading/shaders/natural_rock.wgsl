// All rocks at once, in natural colours.

struct Varyings {
  @builtin(position) clip: vec4f,
  @location(0) from_eye: vec3f,
  // Three random numbers of the rock, and its kind / 255
  @location(1) own: vec4f,
  @location(2) normal: vec3f,
  // As in rock.wgsl: the same point, but never outside the triangle
  @location(3) @interpolate(perspective, centroid) inside: vec3f,
  // Share of the sky that it sees, and towards where; `mossy`
  @location(4) open: vec4f,
  // Light of the air in front of it, and how much of its own comes through
  @location(5) air: vec4f,
  @location(6) from_ground: vec3f,
  @location(7) from_rocks: vec3f,
  // The colours of the rock and of the ground, and how much of this lies on it
  @location(8) albedo: vec3f,
  @location(9) soil: vec4f,
}

@vertex
fn vs_main(
  @location(0) position: vec3f,
  @location(1) color: vec4f,
  @location(2) normal: vec2f,
  // What open_rock.wgsl found
  @location(3) open: vec4f,
) -> Varyings {
  var out: Varyings;
  out.from_eye = settled(position, color) - globals.eye.xyz;
  out.clip = globals.clip_from_eye * vec4f(out.from_eye, 1.0);
  out.inside = out.from_eye;
  // The same rock of two copies has other colours.
  out.own = vec4f(fract(color.xyz + field.shift.w * vec3f(1.0, 1.7, 2.3)), kind_of(color) / 255.0);
  out.normal = normalize(unfolded(normal));
  out.open = vec4f(open.x, open.yz * 4.0 - 2.0, (open.w * 2.0 - 1.0) * MOSSIEST);
  // On a copy moss grows where it does on the ground.
  if has_moss && field.shift.w > 0.0 {
    out.open.w = mossy(out.from_eye + globals.eye.xyz);
  }
  // What changes slowly is found here, since there are several pixels for each vertex.
  let far = length(out.from_eye);
  out.air = air_before(out.from_eye / far, far);
  bare_soil = soil_albedo(globals.scene.x);
  light_nearby();
  out.from_ground = ground_light;
  if quality < 0.5 {
    out.from_ground = light_all_around(out.normal);
  }
  out.from_rocks = rock_light;
  out.albedo = albedo_of(out.own, open.x);
  out.soil = vec4f(bare_soil, soiled(out.from_eye + globals.eye.xyz - field.shift.xyz));
  return out;
}

// Where the maps have a point. From afar, and copies always, rocks have fewer triangles than the maps, which would shade what lies lower for
// it; `footprint` px of the world under a pixel.
fn at_rest(from_eye: vec3f, normal: vec3f, footprint: f32) -> vec3f {
  let coarse = max(footprint - select(0.7, 0.0, field.shift.w > 0.0), 0.0);
  return at_home(from_eye + globals.eye.xyz, field.shift.xyz) + normal * (2.0 * coarse);
}

@fragment
fn fs_main(
  @builtin(position) pixel: vec4f,
  @location(0) from_eye: vec3f,
  @location(1) own: vec4f,
  @location(2) normal: vec3f,
  @location(3) @interpolate(perspective, centroid) inside: vec3f,
  @location(4) open: vec4f,
  @location(5) air: vec4f,
  @location(6) from_ground: vec3f,
  @location(7) from_rocks: vec3f,
  @location(8) albedo: vec3f,
  @location(9) soil: vec4f,
) -> @location(0) vec4f {
  let across = dpdx(from_eye);
  let down = dpdy(from_eye);
  let flat = normalize(cross(across, down));
  let face = select(flat, -flat, dot(flat, from_eye) > 0.0);
  let smooth_normal = normalize(normal);
  let turn_x = dpdx(smooth_normal);
  let turn_y = dpdy(smooth_normal);
  let agree = agreement(smooth_normal, face);
  var base = mix(face, smooth_normal, agree);
  if quality > 0.0 {
    base = normalize(base);
  }

  let world = inside + globals.eye.xyz;
  let far = length(from_eye);
  let to_eye = -from_eye / far;
  let footprint = footprint_of(across, down);
  let home = at_rest(inside, base, footprint);
  let seen = clamp(open.x, 0.0, 1.0);
  open_towards = vec3f(open.yz, 1.0);
  ground_light = from_ground;
  all_around = from_ground;
  rock_light = from_rocks;
  bare_soil = soil.xyz;
  rock_soiled = soil.w;
  rock_albedo = albedo;
  rock_mossy = open.w;
  var wear = 0.0;
  if quality > 1.5 {
    wear = worn(across, down, turn_x, turn_y) * agree;
  }
  // The mean of many samples shows what is finer than a pixel.
  rock_surface(world, own, base, wear, seen, select(1.0, 0.6, is_sampled) * footprint);
  dive(world, to_eye, footprint);
  gathered = caustics(world, footprint);
  surface_rough = select(surface_rough, 0.95, water_deep > 0.0);

  // A rim turned away by less than its relief would be lit from behind.
  var towards = surface_normal;
  if quality > 0.0 {
    towards = normalize(towards + to_eye * max(0.0, 0.02 - dot(towards, to_eye)));
  }
  var rough = surface_rough;
  // What turns faster than the pixels can show scatters (Kaplanyan et al., Filtering distributions of normals, 2016).
  if quality > 0.0 {
    let spread = min(0.5 * (dot(turn_x, turn_x) + dot(turn_y, turn_y)) * agree, 0.18);
    rough = sqrt(sqrt(min(rough * rough * rough * rough + spread, 1.0)));
  }
  let light = daylight(surface_albedo, rough, home, base, towards, to_eye, seen);
  return taken_of_surface(through_water(light, to_eye) * air.w + air.rgb, pixel.xy);
}
