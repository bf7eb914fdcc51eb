/**
 * Refines the picture on the screen while nothing changes: into the mean of samples, each in the light of another point of the sun, the sky and the
 * ground. One passes smoothly into the other, and no step is seen.
 */

import type { Pieces, SceneRenderer, Stills } from '../renderer/renderer.ts';
import { Samples } from './samples.ts';
import { inLaterTurn } from './turns.ts';

/** Somebody who looks around pauses shorter than this, ms. */
const PAUSE_MS = 800;

/** The means of so many samples and more are clean, and worth being shown before the last. */
const CLEAN_SAMPLES = 16;

/**
 * The device draws for no longer than this, ms: then the mean is good enough, or it would take too much of a battery. What is too slow for a clean one
 * is left at the picture it shows.
 */
const BUDGET_MS = 30_000;

/** How long one picture passes into the other, ms. */
const FADE_MS = 600;

/** More than any picture has. */
const EVERY_PIXEL = 1e9;

export interface Refinement {
  renderer: Pick<SceneRenderer, 'stills' | 'isLost'>;
  pieces: Pieces;
  view: Window;
  /** Of the stage, device pixels. */
  size: readonly [width: number, height: number];
  samples: number;
  /** The picture on the screen is one in pieces. */
  isPieced: boolean;
  /** From now on it is. */
  holds(): void;
  /** Readies the renderer. What it returns is called with what shows the picture. */
  prepare(): (show: () => void) => void;
  /** Whether something has changed, or nothing can be seen. */
  isOver(): boolean;
}

/** A device that was lost in the middle of it would be again. */
let isBarred = false;

type Outcome = 'done' | 'over' | 'wanted';

/** True when there is nothing more to refine. */
export async function refine(refinement: Refinement): Promise<boolean> {
  await new Promise((resolve) => setTimeout(resolve, PAUSE_MS));
  const stills = await refinement.renderer.stills?.();
  if (!stills) return true;
  for (let outcome: Outcome = 'wanted'; outcome === 'wanted'; ) {
    if (refinement.isOver()) return false;
    if (isBarred) return true;
    outcome = await inLaterTurn((isWanted) => attempt(refinement, stills, isWanted));
    isBarred ||= refinement.renderer.isLost;
    if (outcome === 'done') return true;
  }
  return false;
}

async function attempt(refinement: Refinement, stills: Stills, isWanted: () => boolean): Promise<Outcome> {
  const { samples: most } = refinement;
  const isOver = (): boolean => isWanted() || refinement.isOver();
  const ended = (): Outcome => (refinement.isOver() ? 'over' : 'wanted');
  const samples = new Samples({ ...refinement, stills, isOver });
  const least = Math.min(most, CLEAN_SAMPLES);
  try {
    hold(refinement);
    if (!(await samples.ready())) return ended();
    refinement.prepare();
    stills.begin();
    for (let drawn = 1; drawn <= most; drawn += 1) {
      if (!(await samples.draw())) return ended();
      // The first one tells little: the device compiles what it is drawn with.
      const whole = Math.floor((BUDGET_MS * drawn) / samples.spent);
      if (drawn > 1 && whole < least) break;
      const isLast = drawn === most || (drawn >= least && drawn >= whole);
      if ((isLast || drawn === CLEAN_SAMPLES) && !(await fade(refinement, stills, isOver))) return ended();
      if (isLast) break;
    }
    return 'done';
  } finally {
    stills.end();
  }
}

/** The same picture as one in pieces: over that the other is drawn. */
function hold({ pieces, size, isPieced, holds, prepare }: Refinement): void {
  if (isPieced) return;
  const shown = prepare();
  pieces.begin(...size, false);
  while (pieces.draw(EVERY_PIXEL));
  shown(() => pieces.show());
  holds();
}

/** Passes into the mean of the samples until now. False when it is over. */
async function fade({ view, prepare }: Refinement, stills: Stills, isOver: () => boolean): Promise<boolean> {
  const start = performance.now();
  for (let before = 0; before < 1; ) {
    await new Promise((resolve) => view.requestAnimationFrame(resolve));
    if (isOver()) return false;
    const now = Math.min(1, (performance.now() - start) / FADE_MS);
    prepare()(() => stills.blend((now - before) / (1 - before)));
    before = now;
  }
  return true;
}
