// Prepended to the passes in natural colours: what kinds of stone are made of. The kinds are those of palette.rs.
// Solid patterns in the rock's own space, px: nothing swims, and a rock keeps its look.

// What `stone` found, as structs are not passed in fragment code.
var<private> stone_albedo: vec3f;
// Slope of the relief, the same in all directions of space; px per px
var<private> stone_slope: vec3f;
var<private> stone_rough: f32;
// Red more and blue less by so much
var<private> stone_warm: f32;
// Noise whose patches are some px wide
var<private> stone_patch: f32;

// Mean linear albedo.
fn kind_albedo(kind: f32) -> vec3f {
  var c = vec3f(0.235, 0.228, 0.214);
  c = select(c, vec3f(0.126, 0.12, 0.113), kind == 2.0);
  c = select(c, vec3f(0.27, 0.227, 0.174), kind == 3.0);
  c = select(c, vec3f(0.35, 0.335, 0.3), kind == 4.0);
  c = select(c, vec3f(0.152, 0.16, 0.158), kind == 5.0);
  c = select(c, vec3f(0.41, 0.395, 0.36), kind == 6.0);
  c = select(c, vec3f(0.215, 0.166, 0.142), kind == 7.0);
  return c;
}

// As in palette.rs, for stones too small to have a mesh; `share` 0…1.
fn mixed_albedo(share: f32) -> vec3f {
  var albedo = kind_albedo(1.0);
  albedo = select(albedo, kind_albedo(2.0), share > 0.24);
  albedo = select(albedo, kind_albedo(5.0), share > 0.42);
  albedo = select(albedo, kind_albedo(3.0), share > 0.61);
  albedo = select(albedo, kind_albedo(7.0), share > 0.81);
  albedo = select(albedo, kind_albedo(4.0), share > 0.88);
  albedo = select(albedo, kind_albedo(6.0), share > 0.94);
  return albedo;
}

// The mean albedo of the finest rocks' kind, to be set where there is debris.
var<private> finest_albedo: vec3f;

// Of what lies about: mostly the finest rocks' own kind, where they have one.
fn debris_albedo(share: f32) -> vec3f {
  return select(finest_albedo, mixed_albedo(fract(share * 7.3)), globals.scene.w < 0.5 || share > 0.88);
}

// Value and hue of one stone among its like; `own` three numbers of 0…1.
fn individual(albedo: vec3f, own: vec3f) -> vec3f {
  let variation = globals.weather.x;
  let value = exp2((own.x - 0.5) * 1.3 * variation);
  let warm = (own.y - 0.5) * 0.18 * variation;
  return albedo * value * vec3f(1.0 + warm, 1.0, 1.0 - warm);
}

// A gas bubble of basalt, cut open, in its cell of a grid: x, y, z the slope of its wall, w what it is darker by.
fn bubble(at: vec3f, share: f32) -> vec4f {
  let cell = grains(at, 20.0);
  let radius = select(0.001, 0.16 + 0.28 * cell.z, cell.y < share);
  let out = cell.x / radius;
  let wall = smoothstep(0.2, 0.8, out) * (1.0 - smoothstep(0.85, 1.05, out));
  return vec4f(-1.5 * wall * grain_middle / max(cell.x, 0.01), 0.3 * (1.0 - smoothstep(0.75, 1.0, out)));
}

// Where all kinds of stone lie together, some are cut by a white line or two: 1 on it. `broad` and `mid` are noise that bends it.
fn veins(kind: f32, own: vec3f, at: vec3f, broad: f32, mid: f32) -> f32 {
  if globals.scene.w > 0.5 || (kind != 2.0 && kind != 5.0) || fract(own.x * 7.0 + own.y * 3.0) > 0.16 {
    return 0.0;
  }
  let vein_at = dot(at, normalize(vec3f(own.zx - 0.5, 0.35))) / 23.0 + 0.12 * broad + 0.1 * mid;
  return 1.0 - smoothstep(0.012, 0.035, abs(fract(vein_at) - 0.5));
}

// What a slope of noise is multiplied by where it is folded at 0: `strength`, downwards where its value is below.
fn folded(strength: f32, value: f32) -> f32 {
  return select(-strength, strength, value > 0.0 || quality < 0.5);
}

// Grain upon grain, down to the pixel: x, y, z the slope, w the value. Its relief is folded where the noise is 0, so that there are creases
// as where grains have broken out, and not the swells of dough.
fn grained(at: vec3f, footprint: f32) -> vec4f {
  let least = select(1.5, 1.0, quality > 1.0) * footprint;
  var period = 1.7;
  var q = at / period + 5.0;
  var all = vec4f(0.0);
  for (var i = 0; i < 6; i++) {
    let seen = shown(period, least);
    if seen <= 0.0 {
      break;
    }
    let grain = noise3(q);
    all += grain * vec4f(vec3f(folded(seen, grain.w)), seen);
    period /= 3.1;
    q = q * 3.1 + 3.7;
  }
  return all;
}

// Crystals of granite about as large as `size`: pale feldspar with grey quartz between, and flakes of dark mica. x, y, z the slope, since each
// crystal broke along planes of its own, w the value; `stone_rough` and `stone_warm` change, too. Noise, among it `fine` and `mid` of other
// periods, decides how far a crystal has grown into the next, and so are their borders uneven. Medium quality makes do with specks.
fn granite(at: vec3f, size: f32, fine: f32, mid: f32, footprint: f32) -> vec4f {
  let seen = shown(size, footprint);
  let q = at / size;
  let grown = noise3(2.6 * q);
  if quality < 1.5 {
    stone_warm += 0.05 * seen * grown.x;
    return vec4f(vec3f(0.0), 0.8 * seen * (grown.w - max(-0.3 - grown.w, 0.0)));
  }
  let sharp = min(size / footprint, 8.0);
  let cell = grains(q + 0.12 * grown.xyz, sharp);
  let feldspar = seen * saturate(sharp * (cell.y + 0.2 * (fine + grown.w) - 0.38) + 0.5);
  let mica = seen * saturate(sharp * (cell.z + grown.w + 0.2 * (fine + mid) - 0.98) + 0.5);
  stone_warm += 0.16 * feldspar * cell.w;
  stone_rough += 0.15 * feldspar - 0.2 * seen;
  let value = 0.5 * feldspar + seen * (0.3 * cell.w - 0.35);
  return vec4f(feldspar * (0.5 * cell.yzw - 0.25), mix(value, -0.75, mica));
}

// All sizes of the gas bubbles of basalt, as `bubble` has one.
fn bubbles(at: vec3f, coarse: f32, share: f32, footprint: f32) -> vec4f {
  var all = vec4f(0.0);
  for (var size = 2.4 * coarse; size > 0.3; size *= 0.37) {
    let seen = shown(0.6 * size, footprint);
    if seen <= 0.0 {
      break;
    }
    all += seen * bubble(at / size, share);
  }
  return all;
}

// The pits that rain has etched into limestone, as `bubble` has one; the higher `patchy`, a noise, the more there are.
fn etched(at: vec3f, patchy: f32, footprint: f32) -> vec4f {
  const SIZE = 0.9;
  let hollow = noise3(at / SIZE + 3.0);
  let depth = smoothstep(0.24, 0.36, hollow.w + 0.25 * patchy) * shown(SIZE, footprint);
  return vec4f(-5.0 * depth * (1.0 - depth) * hollow.xyz, 0.13 * depth);
}

// `own` three random numbers of the rock, `mean` its own mean albedo, `at` in its own space, footprint px of the world under a pixel.
fn stone(kind: f32, own: vec3f, mean: vec3f, at: vec3f, footprint: f32) {
  let coarse = 0.75 + 0.6 * own.z;
  let turned_at = TURN * at;

  // What all stones have: patches and mottling; in places worn smooth, in others rugged.
  let broad = noise3(turned_at / 19.0);
  let rugged = clamp(0.3 + 0.77 * own.y + 1.29 * broad.w, 0.3, 1.2);
  let mid_seen = shown(5.0, footprint);
  let mid = noise3(turned_at / 5.0 + 17.0) * mid_seen;
  stone_patch = mid.w;
  var value = 0.3 * broad.w + 0.26 * mid.w;
  stone_warm = 0.05 * broad.x;
  var slope = 0.12 * broad.xyz + folded(0.2, mid.w) * rugged * mid.xyz;
  var pale = 0.0;
  var fine = 0.0;
  if quality > 0.0 {
    let found = grained(turned_at, footprint);
    fine = found.w;
    value += 0.34 * fine;
    slope += 0.25 * rugged * found.xyz;
  }

  var albedo = mean;
  stone_rough = 0.82;
  if kind == 1.0 {
    stone_rough = 0.7;
    if quality > 0.0 {
      let found = granite(turned_at, 0.23 * coarse, fine, mid.w, footprint);
      slope += found.xyz;
      value += found.w;
    }
  } else if kind == 2.0 {
    slope *= 1.2;
    if quality > 1.5 {
      let found = bubbles(turned_at, coarse, 0.5 + 0.3 * rugged * mid.w, footprint);
      slope += found.xyz;
      value -= found.w;
    }
    stone_rough = 0.75;
  } else if kind == 3.0 || kind == 7.0 || kind == 5.0 {
    // The bed of layered stones, tilted differently in every rock: layers of sandstone, leaves of slate.
    let tilt = vec2f(own.x - 0.5, own.y - 0.5) * 1.4;
    let bed = normalize(vec3f(tilt, 1.0));
    let along = dot(at, bed);
    let is_slate = kind == 5.0;
    let thick = select(3.2 * coarse, 1.25, is_slate);
    // Through the volume aslant, so that no layer comes again.
    const ASLANT = vec3f(0.64, 0.48, 0.6);
    let layer_at = ASLANT * (along / thick + 0.5 * mid.w) + 4.0 * own.zxy;
    let leaf_at = (at - along * bed) / 9.0 + bed * along / thick;
    let layer = noise3(select(layer_at, leaf_at, is_slate)) * shown(thick, footprint);
    value += select(0.36, 0.3, is_slate) * layer.w;
    stone_warm += select(0.16 * layer.y, 0.0, is_slate);
    let rise = dot(layer.xyz, select(ASLANT, bed, is_slate)) * select(0.22, 0.3, is_slate);
    // Back by `slope * TURN` with the others.
    slope += TURN * (rise * bed);
    stone_rough = select(stone_rough, 0.6, is_slate);
  } else if kind == 4.0 {
    value += 0.1 * mid.w;
    pale = smoothstep(0.1, 0.5, broad.w) * 0.3;
    slope *= 1.5;
    if quality > 1.5 {
      let found = etched(turned_at, mid.w, footprint);
      slope += found.xyz;
      value -= found.w;
    }
  } else if kind == 6.0 {
    let rust = smoothstep(0.05, 0.45, broad.w + 0.5 * mid.w);
    albedo *= mix(vec3f(1.0), vec3f(0.83, 0.595, 0.375), 0.5 * rust);
    value *= 0.6;
    slope *= 0.7;
    stone_rough = 0.55;
  }
  albedo = mix(albedo, vec3f(0.45, 0.44, 0.41), max(pale, 0.75 * veins(kind, own, at, broad.w, mid.w) * mid_seen));
  stone_albedo = albedo * max(1.0 + value, 0.2) * vec3f(1.0 + stone_warm, 1.0, 1.0 - stone_warm);
  stone_slope = slope * TURN;
}
