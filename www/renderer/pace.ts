/** How fast a device is, before anything was drawn on this visit: as the last visit left it, or by its name. */

import { QUALITIES } from '../base/view.ts';
import type { Quality } from '../base/view.ts';

export interface Pace {
  /** Of motions, where nobody says. */
  level: Quality;
  /** Pictures are drawn in pieces: as a whole, one would take longer than a page may wait. */
  isCut: boolean;
  /** Of a picture of a motion, which may be smaller than the stage then; 0: not known. */
  pixels: number;
}

/** GPUs that are programs. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|lavapipe|basic render|fallback/i;

/** Another version of this, or another cost of a frame, has another. */
const KEY = 'rock-field:pace:1:';

export function isSoftware(name: string): boolean {
  return SOFTWARE.test(name);
}

/** Storage may be refused or absent, and holds what anybody wrote to it. */
export function paceOf(name: string): Pace {
  const known: Pace = isSoftware(name) ? { level: 'low', isCut: true, pixels: 0 } : { level: 'medium', isCut: false, pixels: 0 };
  try {
    const saved = JSON.parse(localStorage.getItem(KEY + name) ?? '') as Partial<Pace>;
    if (QUALITIES.includes(saved.level!) && typeof saved.isCut === 'boolean' && Number.isInteger(saved.pixels) && saved.pixels! >= 0)
      return { ...known, ...saved };
  } catch {}
  return known;
}

export function rememberPace(name: string, pace: Pace): void {
  try {
    localStorage.setItem(KEY + name, JSON.stringify(pace));
  } catch {}
}
