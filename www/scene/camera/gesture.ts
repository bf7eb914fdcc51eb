/**
 * What fingers on the picture mean, from where and when they touch it. Hears no events and moves no camera.
 *
 * A finger that starts upright scrolls the page; one that starts sideways, or follows a tap, is the picture's, and so are two.
 */

/** `wait`: too early to say. `page`: the page may scroll. `drag`: one finger moves the camera. `pinch`: two or more do. */
export type Meaning = 'wait' | 'page' | 'drag' | 'pinch';

/** Less is a finger that trembles. Browsers wait for 10 to 15 px before they scroll. */
const SLOP_PX = 10;
/** The longest tap, and the longest pause after it. */
const TAP_MS = 300;
/** How far from a tap the next touch may be to belong to it. */
const TAP_REACH_PX = 30;

export class Fingers {
  /** Where each finger came down. */
  readonly #down = new Map<number, { x: number; y: number }>();
  #meaning: Meaning = 'wait';
  #since = 0;
  #mayBeTap = false;
  #followsTap = false;
  #lastTap: { x: number; y: number; time: number } | undefined;

  /** What they mean so far; of no account while there are none. */
  get meaning(): Meaning {
    return this.#meaning;
  }

  /** Whether the page has to stay where it is, however the fingers move. */
  get holdsPage(): boolean {
    if (this.#down.size === 0 || this.#meaning === 'page') return false;
    return this.#meaning !== 'wait' || this.#followsTap;
  }

  /** A finger came down; `time` in ms. With `atOnce` nothing is the page's, and nothing has to be waited for. */
  down(id: number, x: number, y: number, time: number, atOnce = false): Meaning {
    this.#down.set(id, { x, y });
    this.#mayBeTap = this.#down.size === 1;
    if (this.#mayBeTap) {
      const tap = this.#lastTap;
      this.#followsTap = tap !== undefined && time - tap.time <= TAP_MS && Math.hypot(x - tap.x, y - tap.y) <= TAP_REACH_PX;
      this.#since = time;
      this.#meaning = atOnce ? 'drag' : 'wait';
    } else {
      this.#meaning = 'pinch';
    }
    return this.#meaning;
  }

  move(id: number, x: number, y: number): Meaning {
    const from = this.#down.get(id);
    if (!from) return this.#meaning;
    const [dx, dy] = [Math.abs(x - from.x), Math.abs(y - from.y)];
    if (Math.hypot(dx, dy) < SLOP_PX) return this.#meaning;
    this.#mayBeTap = false;
    if (this.#meaning === 'wait') this.#meaning = this.#followsTap || dx > dy ? 'drag' : 'page';
    return this.#meaning;
  }

  /** A finger left. True after the second of two taps. */
  up(id: number, time: number): boolean {
    const from = this.#down.get(id);
    if (!from) return false;
    this.#leave(id);
    const isTap = this.#mayBeTap && time - this.#since <= TAP_MS;
    const isDouble = isTap && this.#followsTap;
    // The third of three taps begins anew.
    this.#lastTap = isTap && !isDouble ? { ...from, time } : undefined;
    return isDouble;
  }

  /** The browser took a finger. True when it did so before it was clear what it meant: the page scrolls. */
  cancel(id: number): boolean {
    if (!this.#down.has(id)) return false;
    const wasOpen = this.#meaning === 'wait' && !this.#followsTap;
    this.#leave(id);
    this.#lastTap = undefined;
    return wasOpen;
  }

  clear(): void {
    this.#down.clear();
    this.#lastTap = undefined;
  }

  /** After a pinch the finger that stays drags on. */
  #leave(id: number): void {
    this.#down.delete(id);
    if (this.#down.size === 1) this.#meaning = 'drag';
  }
}
