// The rocks' surface spread out as an atlas has it, and what it is like there, without light: for files of other programs.

struct Varyings {
  @builtin(position) clip: vec4f,
  @location(0) world: vec3f,
  // Three random numbers of the rock, and its kind / 255
  @location(1) own: vec4f,
  @location(2) normal: vec3f,
  @location(3) tangent: vec3f,
}

// `place` in texels of the atlas, from its upper left corner; `tangent` points to the right of the atlas.
@vertex
fn vs_main(
  @location(0) position: vec3f,
  @location(1) color: vec4f,
  @location(2) normal: vec2f,
  @location(3) place: vec2f,
  @location(4) tangent: vec3f,
) -> Varyings {
  var out: Varyings;
  out.clip = vec4f((place - globals.plan.xy) * globals.plan.zw, 0.5, 1.0);
  out.world = settled(position, color);
  out.own = vec4f(color.xyz, kind_of(color) / 255.0);
  out.normal = normalize(unfolded(normal));
  out.tangent = tangent;
  return out;
}

fn byte(value: f32) -> u32 {
  return u32(clamp(value, 0.0, 1.0) * 255.0 + 0.5);
}

// Eight bytes, the lowest first: the albedo as sRGB; how open the place is to the sky; the normal in the tangent frame, x to the
// right and y upwards in the atlas; roughness; and 255, since nothing is drawn here where there is 0.
@fragment
fn fs_main(
  @location(0) world: vec3f,
  @location(1) own: vec4f,
  @location(2) normal: vec3f,
  @location(3) tangent: vec3f,
) -> @location(0) vec2u {
  let across = dpdx(world);
  let down = dpdy(world);
  let smooth_normal = normalize(normal);
  let turn_x = dpdx(smooth_normal);
  let turn_y = dpdy(smooth_normal);
  // A triangle without area has no side.
  let crossed = cross(across, down);
  let area = dot(crossed, crossed);
  let flat = select(smooth_normal, crossed * inverseSqrt(max(area, 1e-30)), area > 1e-30);
  let face = select(flat, -flat, dot(flat, smooth_normal) < 0.0);
  let agree = agreement(smooth_normal, face);
  let base = normalize(mix(face, smooth_normal, agree));

  // Four spirals: a texture is looked at from all sides, and from near by.
  var seen = 0.0;
  for (var i = 0; i < 4; i++) {
    spiral_start = 0.3 * f32(i);
    seen += 0.25 * sky_seen(world, base, 16);
  }
  bare_soil = soil_albedo(globals.scene.x);
  rock_albedo = albedo_of(own, seen);
  rock_mossy = mossy(world);
  rock_soiled = soiled(world);
  rock_surface(world, own, base, worn(across, down, turn_x, turn_y) * agree, seen, footprint_of(across, down));

  let right = normalize(tangent - smooth_normal * dot(tangent, smooth_normal));
  let up = cross(smooth_normal, right);
  let found = vec3f(dot(surface_normal, right), dot(surface_normal, up), max(dot(surface_normal, smooth_normal), 0.05));
  let bent = normalize(found) * 0.5 + 0.5;
  let albedo = linear_to_srgb(clamp(surface_albedo, vec3f(0.0), vec3f(1.0)));
  // As daylight.wgsl dims the light of the sky.
  let open = byte(seen * seen);
  return vec2u(
    byte(albedo.x) | (byte(albedo.y) << 8u) | (byte(albedo.z) << 16u) | (open << 24u),
    byte(bent.x) | (byte(bent.y) << 8u) | (byte(surface_rough) << 16u) | (255u << 24u),
  );
}
