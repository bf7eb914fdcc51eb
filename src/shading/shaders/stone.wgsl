// Prepended to the passes in natural colours: what kinds of stone are made of. The kinds are those of palette.rs.
// Solid patterns in the rock's own space, px: nothing swims, and a rock keeps its look.

// What `stone` found, as structs are not passed in fragment code.
var<private> stone_albedo: vec3f;
// Slope of the relief, the same in all directions of space; px per px
var<private> stone_slope: vec3f;
var<private> stone_rough: f32;

// Mean linear albedo.
fn kind_albedo(kind: f32) -> vec3f {
  var c = vec3f(0.235, 0.228, 0.214);
  c = select(c, vec3f(0.122, 0.122, 0.12), kind == 2.0);
  c = select(c, vec3f(0.27, 0.227, 0.174), kind == 3.0);
  c = select(c, vec3f(0.35, 0.335, 0.3), kind == 4.0);
  c = select(c, vec3f(0.152, 0.16, 0.158), kind == 5.0);
  c = select(c, vec3f(0.41, 0.395, 0.36), kind == 6.0);
  c = select(c, vec3f(0.215, 0.166, 0.142), kind == 7.0);
  return c;
}

// As in palette.rs, for stones too small to have a mesh; `share` 0…1.
fn mixed_kind(share: f32) -> f32 {
  var kind = 1.0;
  kind = select(kind, 2.0, share > 0.24);
  kind = select(kind, 5.0, share > 0.42);
  kind = select(kind, 3.0, share > 0.61);
  kind = select(kind, 7.0, share > 0.81);
  kind = select(kind, 4.0, share > 0.88);
  kind = select(kind, 6.0, share > 0.94);
  return kind;
}

// Of what lies about: mostly the finest rocks' own kind, where they have one.
fn debris_kind(share: f32) -> f32 {
  let kind = globals.scene.w;
  return select(kind, mixed_kind(fract(share * 7.3)), kind < 0.5 || share > 0.88);
}

// Value and hue of one stone among its like; `own` three numbers of 0…1.
fn individual(albedo: vec3f, own: vec3f) -> vec3f {
  let variation = globals.weather.x;
  let value = exp2((own.x - 0.5) * 1.3 * variation);
  let warm = (own.y - 0.5) * 0.18 * variation;
  return albedo * value * vec3f(1.0 + warm, 1.0, 1.0 - warm);
}

// Interlocking grains of this size: dark mica, pale feldspar, grey quartz between them. What they add to the value and to the warmth.
fn granite(at: vec3f, grain: f32, footprint: f32) -> vec2f {
  let seen = shown(grain, footprint) * min(quality, 1.0);
  if seen <= 0.0 {
    return vec2f(0.0);
  }
  let cell = grains(at / grain, max(1.5 * footprint / grain, 0.08));
  let mica = 1.0 - smoothstep(0.15, 0.19, cell.y);
  let feldspar = smoothstep(0.52, 0.58, cell.y);
  let value = seen * (0.24 * feldspar - 0.55 * mica + 0.3 * (cell.z - 0.5) + 0.01);
  return vec2f(value, seen * (0.1 + 0.1 * (cell.w - 0.5)) * feldspar);
}

// Gas bubbles of this size, cut open: how much darker they are.
fn pits(at: vec3f, size: f32, footprint: f32) -> f32 {
  let seen = shown(size, footprint) * min(quality, 1.0);
  if seen <= 0.0 {
    return 0.0;
  }
  let cell = grains(at / size, 0.05);
  let pit = select(0.0, 1.0 - smoothstep(0.1, 0.16 + 0.28 * cell.z, cell.x), cell.y < 0.55);
  return 0.55 * pit * seen;
}

// Some stones are cut by a white line or two: 1 on it. `broad` and `mid` are noise that bends it.
fn veins(kind: f32, own: vec3f, at: vec3f, broad: f32, mid: f32) -> f32 {
  let vein_at = dot(at, normalize(vec3f(own.zx - 0.5, 0.35))) / 23.0 + 0.12 * broad + 0.1 * mid;
  let vein = 1.0 - smoothstep(0.012, 0.035, abs(fract(vein_at) - 0.5));
  let veined = select(0.0, 1.0, fract(own.x * 7.0 + own.y * 3.0) < 0.16 && (kind == 2.0 || kind == 5.0));
  return vein * veined;
}

// `own` three random numbers of the rock, `at` in its own space, footprint px of the world under a pixel.
fn stone(kind: f32, own: vec3f, at: vec3f, footprint: f32) {
  let coarse = 0.75 + 0.6 * own.z;
  var value = 0.0;
  var warm = 0.0;
  var slope = vec3f(0.0);
  var pale = 0.0;

  // What all stones have: patches, mottling and grain over four octaves; in places worn smooth, in others rugged.
  let broad = noise3(at / 19.0);
  value += 0.3 * broad.w;
  warm += 0.045 * broad.x;
  slope += 0.1 * broad.xyz;
  let rugged = 0.3 + 0.9 * smoothstep(-0.3, 0.4, broad.w + 0.6 * (own.y - 0.5));
  let mid_seen = shown(5.0, footprint);
  var mid = vec4f(0.0);
  if quality > 0.0 && mid_seen > 0.0 {
    mid = noise3(at / 5.0 + 17.0) * mid_seen;
    value += 0.26 * mid.w;
    warm += 0.03 * mid.x;
    slope += 0.12 * rugged * mid.xyz;
  }
  let fine_seen = shown(1.7, footprint);
  if quality > 0.0 && fine_seen > 0.0 {
    let fine = noise3(at / 1.7 + 5.0) * fine_seen;
    value += 0.34 * fine.w;
    slope += 0.2 * rugged * fine.xyz;
  }
  let micro_seen = shown(0.55, footprint);
  if quality > 1.0 && micro_seen > 0.0 {
    let micro = noise3(at / 0.55) * micro_seen;
    value += 0.3 * micro.w;
    slope += 0.22 * rugged * micro.xyz;
  }

  var albedo = kind_albedo(kind);
  var rough = 0.82;
  // The bed of layered stones, tilted differently in every rock.
  let tilt = vec2f(own.x - 0.5, own.y - 0.5) * 1.4;
  let bed = normalize(vec3f(tilt, 1.0));
  let along = dot(at, bed);
  if kind == 1.0 {
    let speckled = granite(at + 0.35 * mid.xyz, 0.5 * coarse, footprint);
    value += speckled.x;
    warm += speckled.y;
    rough = 0.75;
  } else if kind == 2.0 {
    value -= pits(at, 2.4 * coarse, footprint);
    slope *= 1.2;
    rough = 0.7;
  } else if kind == 3.0 || kind == 7.0 {
    let thick = 3.2 * coarse;
    let layer = noise3(vec3f(along / thick + 0.5 * mid.w, 0.5 + 4.0 * own.z, 0.5)) * shown(thick, footprint);
    value += 0.36 * layer.w;
    warm += 0.16 * layer.y;
    slope += 0.22 * layer.x * bed;
  } else if kind == 4.0 {
    value += 0.1 * mid.w;
    pale = smoothstep(0.1, 0.5, broad.w) * 0.3;
    slope *= 0.9;
  } else if kind == 5.0 {
    let flat = at - along * bed;
    let leaf = noise3(flat / 9.0 + bed * along / 1.25) * shown(1.25, footprint);
    value += 0.3 * leaf.w;
    slope += 0.3 * dot(leaf.xyz, bed) * bed;
    rough = 0.6;
  } else if kind == 6.0 {
    let rust = smoothstep(0.05, 0.45, broad.w + 0.5 * mid.w);
    albedo = mix(albedo, vec3f(0.34, 0.235, 0.135), 0.5 * rust);
    value *= 0.6;
    slope *= 0.7;
    rough = 0.55;
  }
  albedo = mix(individual(albedo, own), vec3f(0.45, 0.44, 0.41), max(pale, 0.75 * veins(kind, own, at, broad.w, mid.w) * mid_seen));
  stone_albedo = max(albedo * max(1.0 + value, 0.2) * vec3f(1.0 + warm, 1.0, 1.0 - warm), vec3f(0.01));
  stone_slope = slope;
  stone_rough = rough;
}
