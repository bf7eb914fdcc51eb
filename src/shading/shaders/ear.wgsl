// Wood ears (Auricularia) in natural colours: wet a jelly that light shines through, dry dark and matte; the back is velvet.

struct Varyings {
  @builtin(position) clip: vec4f,
  @location(0) from_eye: vec3f,
  // Share of the way to the rim, two random numbers of the individual, and its side: 0 inner, 1 rim, 2 outer, 3 foot
  @location(1) own: vec4f,
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
  out.own = vec4f(painted.xyz, painted.w * 255.0);
  out.normal = unfolded(normal);
  return out;
}

// The young are tan and the old red-brown to nearly black; thin at the rim, where it is paler. Dry, all are dark and grey.
// `own` as in Varyings, `back` 1 on the velvet side; broad and fine noise, a vein and a hair where there is one.
fn flesh_albedo(own: vec4f, wet: f32, back: f32, broad: f32, fine: f32, vein: f32, hair: f32) -> vec3f {
  let variation = globals.flesh.y;
  let age = mix(0.5, own.y, min(2.0 * variation, 1.0));
  let old = mix(vec3f(0.115, 0.046, 0.019), vec3f(0.04, 0.013, 0.0085), smoothstep(0.4, 1.0, age));
  let jelly = mix(vec3f(0.2, 0.098, 0.042), old, smoothstep(0.0, 0.6, age)) * mix(0.65, 1.25, own.x * own.x);
  let mottled = 1.0 + 0.55 * broad + 0.35 * fine + 0.15 * vein;
  let inner = mix(vec3f(0.026, 0.019, 0.016), jelly, wet) * mottled;
  let skin = mix(vec3f(0.185, 0.162, 0.142), vec3f(0.086, 0.058, 0.041), wet) * mix(1.3, 0.75, age) * mix(0.7, 1.1, own.x);
  let zones = 1.0 + 0.12 * sin(own.x * 26.0 + 3.0 * broad) * back;
  let outer = skin * zones * (1.0 + 0.3 * broad + 0.25 * fine + 0.5 * hair);
  return mix(inner, outer, back) * exp2(variation * (own.z - 0.5) * 2.2);
}

// Water levels out what is fine, and shows the sky between the trees; `film` 0…1.
fn mirrored_sky(film: f32, base: vec3f, slope: vec3f, to_eye: vec3f, seen: f32) -> vec3f {
  let level = bumped(base, 0.35 * slope);
  let mirrored = reflect(-to_eye, level);
  let gaps = smoothstep(0.0, 0.45, noise3(mirrored * 2.3 + 17.0).w) * smoothstep(-0.1, 0.5, mirrored.z);
  let grazing = 1.0 - max(dot(level, to_eye), 0.0);
  let square = grazing * grazing;
  return sky_radiance(mirrored) * (3.0 * film * film * gaps * seen * (0.05 + 0.8 * square * square * grazing));
}

// Light through the flesh: of the sun and the sky behind it, redder the thicker it is, and most at the rim. `thin` how much of it
// comes through, `toward_rim` the share of the way there.
fn light_through(thin: f32, toward_rim: f32, vein: f32, world: vec3f, base: vec3f, to_eye: vec3f, seen: f32) -> vec3f {
  let sun = field.sun.xyz;
  let lit = dot(base, sun);
  let behind = max(-lit, 0.0) + 0.25 * max(1.0 - abs(lit), 0.0);
  // The shadow map has the flesh itself: asked is its lit side.
  let toward_sun = select(-base, base, lit > 0.0);
  let direct = sun_seen(world + sun * 0.15, toward_sun) * behind;
  let scatter = 0.6 + 1.2 * pow(max(dot(-to_eye, sun), 0.0), 4.0);
  let depth = mix(1.5, 0.5, toward_rim);
  let tint = exp(-depth * vec3f(0.75, 2.1, 3.4) * (1.0 + 0.5 * vein));
  return tint * thin * (sunshine() * direct * scatter * 0.6 + sky_light(vec3f(0.0, 0.0, 1.0)) * 0.12 * seen);
}

@fragment
fn fs_main(
  @builtin(position) pixel: vec4f,
  @builtin(front_facing) front: bool,
  @location(0) from_eye: vec3f,
  @location(1) own: vec4f,
  @location(2) given: vec3f,
  @location(3) @interpolate(perspective, centroid) inside: vec3f,
) -> @location(0) vec4f {
  let footprint = footprint_of(dpdx(from_eye), dpdy(from_eye));
  let turn_x = dpdx(given);
  let turn_y = dpdy(given);
  // A single sheet shows its back as its inner side turned over.
  let base = normalize(given) * select(-1.0, 1.0, front);
  let world = inside + globals.eye.xyz;
  let far = length(from_eye);
  let to_eye = -from_eye / far;
  let back = select(1.0, smoothstep(1.0, 1.9, own.w), front);
  let moisture = globals.flesh.x;
  let variation = globals.flesh.y;
  let wet = smoothstep(0.15, 0.85, moisture + 0.3 * variation * (own.z - 0.5));

  // Veins that branch over the inner side, and what the flesh is uneven by.
  let at = world + own.yzy * vec3f(37.0, 53.0, 71.0);
  let broad = noise3(at / 1.7);
  let seen_veins = shown(0.9, footprint) * (1.0 - back);
  var slope = 0.06 * broad.xyz;
  var vein = 0.0;
  if quality > 0.0 && seen_veins > 0.0 {
    let net = noise3((at + 0.3 * broad.xyz) / 1.3);
    let t = clamp(net.w / 0.22, -1.0, 1.0);
    let here = seen_veins * smoothstep(-0.25, 0.3, broad.w);
    vein = (1.0 - t * t) * (1.0 - t * t) * here;
    slope -= 0.3 * t * (1.0 - t * t) * here * net.xyz;
  }
  var fine = 0.0;
  if quality > 0.0 {
    fine = noise3(at / 0.5).w * shown(0.5, footprint);
  }
  var down_hair = 0.0;
  let hair_seen = shown(0.12, footprint) * back;
  if quality > 0.0 && hair_seen > 0.0 {
    let hair = noise3(at / 0.12) * hair_seen;
    down_hair = hair.w;
    slope += 0.25 * hair.xyz;
  }

  var albedo = flesh_albedo(own, wet, back, broad.w, fine, vein, down_hair);
  var rough = mix(mix(0.62, 0.19, wet), 0.85, back);
  let relief = bumped(base, slope);
  let seen = mix(0.25, 1.0, sky_seen(world, base, sky_taps()));
  let towards = normalize(relief + to_eye * max(0.0, 0.02 - dot(relief, to_eye)));

  // Velvet: hairs stand out against the light where they are seen from the side.
  let n_v = max(dot(towards, to_eye), 0.0);
  let velvet = globals.flesh.w * back * (1.0 - 0.35 * wet);
  let fuzz = velvet * pow(1.0 - n_v, 2.5);
  albedo = mix(albedo, vec3f(0.36, 0.32, 0.285) * (1.0 + 0.6 * down_hair), 0.25 * velvet + 0.6 * fuzz);
  // What turns faster than the pixels can show scatters, as in natural_rock.wgsl: a rim is as wide as a pixel.
  let spread = min(0.5 * (dot(turn_x, turn_x) + dot(turn_y, turn_y)), 0.3);
  rough = sqrt(sqrt(min(rough * rough * rough * rough + spread, 1.0)));
  bare_soil = soil_albedo(globals.scene.x);
  light_nearby();
  all_around = light_all_around(towards);
  var light = daylight(albedo, rough, world, base, towards, to_eye, seen);
  if is_matte() {
    light += mirrored_light(rough, towards, to_eye, seen);
  }
  let film = wet * (1.0 - back);
  if film > 0.0 {
    light += mirrored_sky(film, base, slope, to_eye, seen);
  }

  let thin = globals.flesh.z * wet * smoothstep(0.05, 1.0, own.x) * (1.0 - smoothstep(2.2, 2.9, own.w));
  if thin > 0.0 {
    light += light_through(thin, own.x, vein, world, base, to_eye, seen);
  }
  return developed(light, from_eye, pixel.xy);
}
