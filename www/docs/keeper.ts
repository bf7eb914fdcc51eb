/**
 * Lets only what is near the screen live: forty fields at once are more than a page should ask of a device, and more WebGL
 * contexts than browsers allow.
 */

/** Something that can be brought to life and put away again; its box keeps its size. */
export interface Kept {
  readonly box: Element;
  start(): void;
  stop(): void;
}

/** So near does it start; a little further away it ends. px. */
const NEAR = 250;
const FAR = 500;
/** Browsers allow 16 WebGL contexts in a page, and one that was let go of is freed a second later. */
const MAX_ALIVE = 10;
/** What is still near at the next look was not just scrolled past. */
const LOOK_MS = 150;

const all = new Set<Kept>();
const alive = new Set<Kept>();
let seen = new Set<Kept>();
let looking: ReturnType<typeof setTimeout> | undefined;

export function keep(kept: Kept): void {
  all.add(kept);
  if (all.size > 1) return;
  for (const type of ['scroll', 'resize'] as const) addEventListener(type, scheduleLook, { passive: true });
  scheduleLook();
}

/** For what needs to be alive at once, wherever it is. */
export function wake(kept: Kept): void {
  if (alive.has(kept)) return;
  alive.add(kept);
  kept.start();
}

function scheduleLook(): void {
  if (looking === undefined) looking = setTimeout(look, LOOK_MS);
}

function look(): void {
  looking = undefined;
  const distances = new Map([...all].map((kept) => [kept, distance(kept.box)]));
  const nearest = [...all].sort((a, b) => (distances.get(a) ?? 0) - (distances.get(b) ?? 0)).slice(0, MAX_ALIVE);
  const wanted = new Set(nearest.filter((kept) => (distances.get(kept) ?? 0) < (alive.has(kept) ? FAR : NEAR)));
  for (const kept of alive) {
    if (wanted.has(kept)) continue;
    alive.delete(kept);
    kept.stop();
  }
  for (const kept of wanted) if (seen.has(kept)) wake(kept);
  if ([...wanted].some((kept) => !seen.has(kept))) scheduleLook();
  seen = wanted;
}

/** From the screen, px; nothing for what has the focus. */
function distance(box: Element): number {
  if (box.contains(document.activeElement)) return 0;
  const { top, bottom } = box.getBoundingClientRect();
  return Math.max(0, top - innerHeight, -bottom);
}
