/** What wood ears and logs are made of in files, in mean colours: natural ones as ear.wgsl and log.wgsl have them without their patterns. */

import { FLESH, WOOD } from '../data/palette.gen.ts';
import type { Material } from '../export/model.ts';
import { hash } from '../rocks/stone-kinds.ts';
import type { WoodEarParams } from './request.ts';

type Look = Pick<WoodEarParams, 'moisture' | 'variation' | 'velvet'>;
type Color = Material['color'];

/** Where each age's class ends, and the age that stands for it. */
const AGES = [
  { name: 'young', below: 1 / 3, age: 1 / 6 },
  { name: 'grown', below: 2 / 3, age: 1 / 2 },
  { name: 'old', below: Infinity, age: 5 / 6 },
] as const;

/** Means over an ear of what ear.wgsl has as a function of the distance from the foot. */
const [JELLY, SKIN] = [0.95, 0.967];

export interface Flesh {
  materials: Material[];
  /** The materials of both sides of the individual with this foot, by their places in the list. */
  of: (foot: number) => [inside: number, outside: number];
}

/** @param isThick whether both sides have triangles of their own. */
export function fleshOf(look: Look, isNatural: boolean, isThick: boolean): Flesh {
  const isTwoSided = !isThick;
  if (!isNatural) {
    const materials = [
      { name: 'flesh', color: FLESH.plainInside, isTwoSided },
      { name: 'velvet', color: FLESH.plainOutside },
    ];
    return { materials, of: () => [0, 1] };
  }
  const wet = smoothstep(0.15, 0.85, look.moisture / 100);
  const inside = AGES.map(({ name, age }) => ({
    name: `flesh-${name}`,
    color: insideOf(age, wet),
    roughness: rounded(mix(0.62, 0.19, wet)),
    isTwoSided,
  }));
  const outside = AGES.map(({ name, age }) => ({ name: `velvet-${name}`, color: outsideOf(age, wet, look.velvet), roughness: 0.85 }));
  const classOf = (foot: number): number => {
    const age = mix(0.5, (hash(0, foot) & 0xff) / 255, Math.min(2 * look.variation, 1));
    return AGES.findIndex(({ below }) => age < below);
  };
  return { materials: [...inside, ...outside], of: (foot) => [classOf(foot), AGES.length + classOf(foot)] };
}

/** The kinds of wood in their order. */
export function woodMaterials(isNatural: boolean, isTwoSided: boolean): Material[] {
  return WOOD.map(({ name, natural, plain }) => ({ name, color: isNatural ? natural : plain, isTwoSided }));
}

function insideOf(age: number, wet: number): Color {
  const old = mixed(FLESH.grown, FLESH.old, smoothstep(0.4, 1, age));
  const jelly = scaled(mixed(FLESH.young, old, smoothstep(0, 0.6, age)), JELLY);
  return scaled(mixed(FLESH.dryInside, jelly, wet), 1);
}

function outsideOf(age: number, wet: number, velvet: number): Color {
  const skin = scaled(mixed(FLESH.dryOutside, FLESH.wetOutside, wet), mix(1.3, 0.75, age) * SKIN);
  return scaled(mixed(skin, FLESH.velvet, 0.25 * velvet * (1 - 0.35 * wet)), 1);
}

function smoothstep(from: number, to: number, x: number): number {
  const t = Math.min(1, Math.max(0, (x - from) / (to - from)));
  return t * t * (3 - 2 * t);
}

function mix(a: number, b: number, share: number): number {
  return a + share * (b - a);
}

function mixed([r, g, b]: Color, other: Color, share: number): Color {
  return [mix(r, other[0], share), mix(g, other[1], share), mix(b, other[2], share)];
}

function scaled([r, g, b]: Color, by: number): Color {
  return [rounded(r * by), rounded(g * by), rounded(b * by)];
}

function rounded(value: number): number {
  return Math.round(value * 1e4) / 1e4;
}
