// A fallen log in natural colours: bark with its fissures, end grain, splinters. It lies along x.

struct Varyings {
  @builtin(position) clip: vec4f,
  @location(0) from_eye: vec3f,
  @location(1) kind: f32,
  @location(2) normal: vec3f,
  // As in rock.wgsl: the same point, but never outside the triangle
  @location(3) @interpolate(perspective, centroid) inside: vec3f,
}

@vertex
fn vs_main(@location(0) position: vec3f, @location(1) painted: vec4f, @location(2) normal: vec2f) -> Varyings {
  var out: Varyings;
  out.from_eye = position - globals.eye.xyz;
  out.clip = globals.clip_from_eye * vec4f(out.from_eye, 1.0);
  out.inside = out.from_eye;
  out.kind = painted.w * 255.0;
  out.normal = unfolded(normal);
  return out;
}

// Height of a net of fissures, 0 in them and 1 on the plates between, and in xyz its slope; `noise` per px.
fn fissures(noise: vec4f, wide: f32) -> vec4f {
  let t = clamp(abs(noise.w) / wide, 0.0, 1.0);
  return vec4f(noise.xyz * sign(noise.w) * 6.0 * t * (1.0 - t) / wide, t * t * (3.0 - 2.0 * t));
}

// Along the grain all is drawn out.
const LONG = vec3f(0.17, 1.0, 1.0);
const RIDGE = vec3f(0.2, 1.0, 1.0) / 1.9;
const PLATE = vec3f(1.0, 0.6, 0.6) / 2.3;

// What `bark` found, as structs are not passed in fragment code.
var<private> bark_albedo: vec3f;
// Slope of the relief; px per px
var<private> bark_slope: vec3f;
// 0 in fissures, 1 on the ridges
var<private> bark_high: f32;
// How much paler it is here than its colour
var<private> bark_value: f32;

// Ridges between fissures along the axis, cut across into plates, and scaly. `at` along its grain, `broad` and `fiber` noise
// there, `hue` 0 brown to 1 grey.
fn bark(at: vec3f, broad: vec4f, fiber: vec4f, hue: f32, footprint: f32) {
  let warped = at + vec3f(0.0, 0.6, 0.6) * broad.w;
  var ridge = noise3(warped * RIDGE);
  ridge = fissures(vec4f(ridge.xyz * RIDGE, ridge.w), 0.2);
  var plate = noise3(warped * PLATE + 11.0) * shown(2.0, footprint);
  plate = fissures(vec4f(plate.xyz * PLATE, plate.w + 0.15), 0.2);
  // Cracks within the ridges.
  var crack = vec4f(vec3f(0.0), 1.0);
  if quality > 0.0 {
    crack = noise3(warped * RIDGE * 2.7 + 41.0) * shown(0.8, footprint);
    crack = fissures(vec4f(crack.xyz * RIDGE * 2.7, crack.w), 0.16);
    crack = mix(vec4f(vec3f(0.0), 1.0), crack, 0.5 * shown(0.8, footprint) * smoothstep(-0.4, 0.3, broad.w));
  }
  let high = ridge.w * mix(1.0, plate.w, 0.55) * crack.w;
  var slope = 0.8 * ridge.xyz * mix(1.0, plate.w, 0.55) + (0.3 * plate.xyz + 0.22 * crack.xyz) * ridge.w;
  var value = 0.3 * broad.w;
  let scale_seen = shown(0.9, footprint);
  if quality > 0.0 && scale_seen > 0.0 {
    let scales = noise3(at * vec3f(0.6, 1.0, 1.0) / 0.7 + 7.0) * scale_seen;
    slope += 0.5 * scales.xyz * vec3f(0.6, 1.0, 1.0);
    value += 1.0 * scales.w;
  }
  let micro_seen = shown(0.25, footprint);
  if quality > 1.0 && micro_seen > 0.0 {
    let micro = noise3(at * vec3f(0.7, 1.0, 1.0) / 0.22) * micro_seen;
    slope += 0.4 * micro.xyz;
    value += 0.75 * micro.w;
  }
  value += 0.6 * fiber.w;
  slope += 0.1 * fiber.xyz * LONG / 0.5 * ridge.w;
  let albedo = mix(vec3f(0.066, 0.047, 0.034), mix(vec3f(0.135, 0.098, 0.07), vec3f(0.18, 0.157, 0.13), hue), high);
  bark_albedo = albedo * max(1.0 + value, 0.25);
  bark_slope = slope;
  bark_high = high;
  bark_value = value;
}

// What `bare_wood` found.
var<private> wood_albedo: vec3f;
// Slope of the relief; px per px
var<private> wood_slope: vec3f;
// 0 deep in a gap, 1 in the open
var<private> wood_open: f32;

// End grain: growth rings, unequal, each pale first and dark at last; the heart is darker, and checks gape along the rays.
// `splinter` 1: torn along the grain instead.
fn bare_wood(at: vec3f, broad: vec4f, fiber: vec4f, hue: f32, splinter: f32, footprint: f32) {
  let radius = length(at.yz);
  let ray = at.yz / max(radius, 0.01);
  let grown = radius + 0.5 * broad.w + 0.4 * noise2(2.0 * ray + 5.0);
  let years = grown / 0.46 + 2.0 * noise2(vec2f(grown / 1.3, 0.5));
  let late = smoothstep(0.3, 0.9, fract(years)) * (1.0 - smoothstep(0.93, 1.0, fract(years)));
  let rings = late * shown(0.42, footprint);
  let check = fissures(noise3(vec3f(2.6 * ray, radius / 16.0 + 0.02 * at.x)), 0.05);
  let gap = mix(check.w, 1.0, smoothstep(-0.15, 0.2, broad.w + 0.4 * noise2(3.0 * ray)) * smoothstep(1.5, 5.0, radius));
  let rays = noise2(vec2f(23.0 * atan2(ray.y, ray.x), radius / 1.7)) * shown(0.25, footprint);
  // Torn across, the fibres end in tufts.
  let tuft = noise3(at * vec3f(0.25, 1.0, 1.0) / 0.55 + 3.0) * shown(0.5, footprint);
  let stain = smoothstep(0.1, 0.6, noise2(at.yz / 4.7) + 0.5 * noise2(at.yz / 1.9));
  var pale = mix(vec3f(0.27, 0.19, 0.115), vec3f(0.2, 0.17, 0.138), 0.5 + broad.x);
  pale *= mix(vec3f(0.62, 0.52, 0.45), vec3f(1.0), smoothstep(0.3 * field.log.z, 0.6 * field.log.z, grown));
  pale *= (1.0 - 0.3 * rings) * (1.0 + 0.25 * broad.w + 0.12 * rays + 0.5 * tuft.w) * (1.0 - 0.45 * stain);
  let torn = mix(vec3f(0.28, 0.19, 0.11), vec3f(0.2, 0.175, 0.15), hue) * max(1.0 + 0.9 * fiber.w + 0.3 * broad.w, 0.2);
  wood_albedo = mix(pale * mix(0.25, 1.0, gap), torn, splinter);
  wood_slope = mix(0.28 * tuft.xyz * vec3f(0.25, 1.0, 1.0), 0.25 * fiber.xyz * LONG / 0.5, splinter);
  wood_open = mix(0.6, 1.0, gap);
}

@fragment
fn fs_main(
  @builtin(position) pixel: vec4f,
  @location(0) from_eye: vec3f,
  @location(1) kind: f32,
  @location(2) given: vec3f,
  @location(3) @interpolate(perspective, centroid) inside: vec3f,
) -> @location(0) vec4f {
  let footprint = footprint_of(dpdx(from_eye), dpdy(from_eye));
  let base = normalize(given);
  let world = inside + globals.eye.xyz;
  let far = length(from_eye);
  let to_eye = -from_eye / far;

  let at = about_log(world);
  // The grain winds about the trunk a little, so that nothing comes again along it.
  let grown = at + vec3f(0.0, 0.037, 0.023) * at.x;
  let broad = noise3(grown * LONG / 7.0 + 3.0);
  let fiber_seen = shown(0.5, footprint);
  var fiber = vec4f(0.0);
  if quality > 0.0 && fiber_seen > 0.0 {
    fiber = noise3(grown * LONG / 0.5) * fiber_seen;
  }
  let end = smoothstep(0.35, 0.65, kind) * (1.0 - smoothstep(1.35, 1.65, kind));
  let splinter = smoothstep(1.35, 1.65, kind);
  let bare = end + splinter;

  let hue = 0.5 + broad.x * 0.35;
  bark(grown, broad, fiber, hue, footprint);
  let high = bark_high;
  var albedo = bark_albedo;
  var slope = bark_slope;
  var open = mix(0.65, 1.0, high);
  var rough = 0.9;

  // Lichen: pale crusts where the sky is seen, on the ridges.
  let spots = noise2(at.xy / 6.3 + 0.35 * at.z) + 0.6 * noise2(at.xz / 2.3) + 0.35 * noise2(at.xy / 0.7) * shown(0.7, footprint);
  let lichen = smoothstep(0.66, 0.74, spots + 0.25 * base.z + 0.15 * bark_value) * smoothstep(0.3, 0.8, high) * (1.0 - bare);
  albedo = mix(albedo, vec3f(0.27, 0.29, 0.23) * (1.0 + 0.7 * bark_value), 0.75 * lichen);

  if bare > 0.0 {
    bare_wood(at, broad, fiber, hue, splinter / bare, footprint);
    albedo = mix(albedo, wood_albedo, bare);
    slope = mix(slope, wood_slope, bare);
    open = mix(open, wood_open, bare);
  }
  let relief = bumped(base, slope);
  let seen = sky_seen(world, base, sky_taps());

  // Soil clings to what lies in the ground; moss as on the rocks, first in the fissures.
  bare_soil = soil_albedo(globals.scene.x);
  let loose = noise2(world.xy / 6.3) * 0.5;
  let soiled = smoothstep(0.25, 1.0, 1.1 * exp(-max(world.z, 0.0) / 2.5) + 0.5 * loose) * (0.35 + 0.65 * globals.weather.w);
  albedo = mix(albedo, bare_soil, 0.8 * soiled);
  var bent = relief;
  // Algae where it stays damp.
  let damp = (1.0 - smoothstep(0.0, 1.6 * field.log.z, world.z)) * smoothstep(-0.3, 0.5, noise2(at.xy / 9.0) + 0.5 * noise2(at.xz / 2.1));
  albedo *= mix(vec3f(1.0), vec3f(0.5, 0.58, 0.42), damp);
  var moss = moss_cover(world, mossy(world), base.z, 0.35 * world.z, 1.0 - seen + 0.35 + 0.25 * (1.0 - high), footprint) * (1.0 - 0.7 * bare);
  if moss > 0.0 {
    moss_coat(world, footprint);
    moss = smoothstep(0.25, 0.5, moss + 0.6 * moss_high);
    albedo = mix(albedo, moss_albedo, moss);
    bent = normalize(mix(relief, bumped(base, moss_slope), moss));
    open = mix(open, 1.0 + 0.5 * min(moss_high, 0.0), moss);
  }
  let wet = wet_cover(world) * (1.0 - 0.5 * moss);
  albedo *= mix(vec3f(1.0), vec3f(0.45) + 0.35 * albedo, wet);
  rough = mix(rough, 0.45, wet);
  let towards = normalize(bent + to_eye * max(0.0, 0.02 - dot(bent, to_eye)));
  light_nearby();
  all_around = light_all_around(towards);
  let light = daylight(albedo, rough, world, base, towards, to_eye, seen * open);
  return developed(light, from_eye, pixel.xy);
}
