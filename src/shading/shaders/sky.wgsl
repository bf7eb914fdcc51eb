// Prepended to the passes in natural colours: the sky (sky.rs has the model), the air in between, and the camera's tone curve. All light is in the units of
// sky.rs: multiplied by exposure and white balance.

// Radiance of the sky without the sun. Columns from the sun's azimuth to the opposite one by the sine of half the angle, rows from the
// horizon up by the root of the elevation's sine.
@group(2) @binding(6) var sky_map: texture_2d<f32>;
@group(2) @binding(7) var sky_sampler: sampler;

// The hills at the horizon (hills.rs): x and y of the normal, the root of the distance, how far below the skyline. Columns once round the horizon.
@group(2) @binding(10) var hill_map: texture_2d<f32>;

// How high the panorama reaches, radians, and its rows; how far its hills are at most, and over what distance the air hides what
// is behind it by e, km.
const HILLS_TOP = 0.08;
const HILLS_ROWS = 48.0;
const HILLS_FAR = 24.0;
const AIR = 22.0;

// The sun's light, as `daylight` wants it: its irradiance divided by π.
fn sunshine() -> vec3f {
  return field.sunshine.rgb;
}

// From a direction of length 1; below the horizon, that of the horizon.
fn sky_radiance(direction: vec3f) -> vec3f {
  let azimuth = vec2f(field.sky[0].w, field.sky[1].w);
  let from_sun = dot(azimuth, direction.xy) * inverseSqrt(max(dot(direction.xy, direction.xy), 1e-12));
  let at = sqrt(max(vec2f(0.5 - 0.5 * from_sun, direction.z), vec2f(0.0)));
  return textureSampleLevel(sky_map, sky_sampler, at, 0.0).rgb;
}

// The sky's irradiance of a surface with this normal, divided by π, as long as nothing hides any of it.
fn sky_light(normal: vec3f) -> vec3f {
  let azimuth = vec2f(field.sky[0].w, field.sky[1].w);
  let x = dot(azimuth, normal.xy);
  let y = azimuth.x * normal.y - azimuth.y * normal.x;
  let z = normal.z;
  let light = field.sky[0].rgb + z * (field.sky[1].rgb + z * field.sky[3].rgb) + x * (field.sky[2].rgb + z * field.sky[4].rgb)
    + (x * x - y * y) * field.sky[5].rgb;
  return max(light, vec3f(0.0));
}

// What the eye sees of the sky: with the sun's disc and its glow in the haze and in the lens.
fn sky_seen_by_eye(direction: vec3f) -> vec3f {
  let off = max(1.0 - dot(direction, field.sun.xyz), 0.0);
  let disc = 60.0 * (1.0 - smoothstep(0.6e-5, 2.2e-5, off)) + 1.2 * exp(-off * 2500.0);
  return sky_radiance(direction) + sunshine() * disc;
}

// The hills in front of the sky, whose light in this direction is `sky`; `pixel` the angle that a pixel covers, radians.
fn with_hills(sky: vec3f, direction: vec3f, pixel: f32) -> vec3f {
  if direction.z > HILLS_TOP {
    return sky;
  }
  // Each field has another part of the panorama before it.
  let turned_by = mat2x2f(field.sky[2].w, field.sky[3].w, -field.sky[3].w, field.sky[2].w);
  let there = turned_by * direction.xy;
  let turn = atan2(there.y, there.x) / 6.2831853 + 0.5;
  let found = textureSampleLevel(hill_map, sky_sampler, vec2f(turn, direction.z / HILLS_TOP), 0.0);
  // Crowns of trees and rocks on the skyline.
  let crowns = (noise2(vec2f(turn * 2600.0, 0.5)) + 0.7 * noise2(vec2f(turn * 7100.0, 7.5))) * 0.22;
  let rows = (found.w * 255.0 - 128.0) / 32.0 + crowns;
  let covered = clamp(rows * HILLS_TOP / HILLS_ROWS / pixel + 0.5, 0.0, 1.0);
  let flat = (found.xy * 2.0 - 1.0) * turned_by;
  let normal = vec3f(flat, sqrt(max(1.0 - dot(flat, flat), 0.0)));
  let distance = found.z * found.z * HILLS_FAR;
  let at = vec2f(turn * 900.0, direction.z * 4000.0);
  let patches = noise2(at / vec2f(9.0, 5.0)) + 0.5 * noise2(at / vec2f(2.3, 1.7));
  let bare = smoothstep(0.15, 0.5, 1.0 - normal.z + 0.12 * patches);
  let grown = mix(vec3f(0.13, 0.12, 0.085), vec3f(0.07, 0.075, 0.04), clamp(0.5 + 0.5 * patches + globals.weather.z, 0.0, 1.0));
  let dry = mix(mix(grown, 0.8 * soil_albedo(globals.scene.x), 0.35), vec3f(0.17, 0.16, 0.145), bare) * (1.0 + 0.2 * patches);
  let white = select(0.0, smoothstep(0.1, 0.4, 1.0 - bare + 2.0 * globals.waters.x + 0.4 * patches - 0.5), has_snow);
  let albedo = mix(dry, 0.8 * SNOW, white);
  let light = albedo * (sunshine() * max(dot(normal, field.sun.xyz), 0.0) + 0.85 * sky_light(normal));
  let air = sky_radiance(vec3f(direction.xy, 0.03));
  return mix(sky, mix(air, light, exp(-distance / AIR)), covered);
}

// The air between the eye and what is `far` in a direction: its light, and how much comes through.
fn air_before(direction: vec3f, far: f32) -> vec4f {
  // The plain ends where the hills begin.
  let side = max(field.size.x, field.size.y);
  let left = exp(-min(far, 45.0 * side) / (500.0 * side));
  return vec4f(sky_radiance(vec3f(direction.xy, 0.02)) * (1.0 - left), left);
}

// Of a surface: what the camera makes of its light.
fn developed(light: vec3f, from_eye: vec3f, pixel: vec2f) -> vec4f {
  let far = length(from_eye);
  let air = air_before(from_eye / far, far);
  return taken_of_surface(light * air.w + air.rgb, pixel);
}
