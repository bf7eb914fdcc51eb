// A clock, a screen and a graphics device of our own, for whoever draws frames. Every test of a file that imports this begins with new ones.
import assert from 'node:assert/strict';
import { afterEach, beforeEach } from 'node:test';
import type { Quality } from '../../www/base/view.ts';
import type { Pieces, Stills } from '../../www/renderer/renderer.ts';
import { FramePacer } from '../../www/scene/frame-pacer.ts';

export const STAGE = [800, 600] as const;

/** What the scene asked the screen for, and the time. */
export const screen = { frames: [] as FrameRequestCallback[], clock: 0 };
/** The scenes of a test are out of sight when it ends, or they would keep those of the next one waiting. */
const scenes: { visible: boolean }[] = [];
const real = { request: globalThis.requestAnimationFrame, cancel: globalThis.cancelAnimationFrame };

beforeEach((context) => {
  screen.frames = [];
  screen.clock = 0;
  globalThis.requestAnimationFrame = (callback) => screen.frames.push(callback);
  globalThis.cancelAnimationFrame = (handle) => {
    screen.frames[handle - 1] = () => {};
  };
  if ('mock' in context) context.mock.timers.enable({ apis: ['setTimeout'] });
});

afterEach(() => {
  for (const scene of scenes.splice(0)) scene.visible = false;
  globalThis.requestAnimationFrame = real.request;
  globalThis.cancelAnimationFrame = real.cancel;
});

/** The screen asks for its next picture. */
export function present(ms = 16): void {
  screen.clock += ms;
  const due = screen.frames;
  screen.frames = [];
  for (const callback of due) callback(screen.clock);
}

export function setUp({
  graded = true,
  moves = 0,
  pieces = undefined as Pieces | undefined,
  stills = undefined as Stills | undefined,
} = {}) {
  const drawn: (Quality | null)[] = [];
  const scene = { visible: true, graded, moves, level: null as Quality | null, error: null as unknown };
  scenes.push(scene);
  const pacer = new FramePacer({
    view: () => globalThis as unknown as Window,
    canDraw: () => scene.visible,
    isGraded: () => scene.graded,
    advance: () => {
      scene.moves -= 1;
      return scene.moves >= 0;
    },
    draw: (level) => void drawn.push(level),
    pieces: () => pieces && { pieces, size: STAGE },
    refiner: () => (stills && scene.graded ? { stills: async () => stills, isLost: false } : undefined),
    prepare: (level) => {
      scene.level = level;
      return (show) => {
        try {
          show();
        } catch (thrown) {
          scene.error = thrown;
        }
      };
    },
  });
  return { drawn, scene, pacer };
}

/** Draws pictures in pieces, so many pixels in a millisecond. */
export class Device implements Pieces {
  /** What was shown, one line each: its size, and `rough` if it was so. */
  readonly shown: string[] = [];
  readonly pieces: number[] = [];
  /** How many parts of what gives light are still to be drawn, each as long as so many pixels. */
  lights = 0;
  readonly lightPixels = 20_000;
  /** The most parts and pieces that were under way at once. */
  most = 0;
  begun = 0;
  width = 0;
  #picture = '';
  #left = 0;
  #under: { pixels: number }[] = [];
  readonly #speed: number;

  constructor(speed: number) {
    this.#speed = speed;
  }

  make(): boolean {
    return false;
  }

  isMaking(): boolean {
    return false;
  }

  begin(width: number, height: number, isRough: boolean): void {
    this.begun += 1;
    this.width = width;
    this.#picture = `${width}×${height}${isRough ? ' rough' : ''}`;
    this.#left = width * height;
    this.#under = [];
  }

  light(): boolean {
    if (this.lights === 0) return false;
    this.lights -= 1;
    this.#give(this.lightPixels);
    return true;
  }

  #give(pixels: number): void {
    this.#under.push({ pixels });
    this.most = Math.max(this.most, this.#under.length);
  }

  draw(pixels: number): boolean {
    const size = Math.min(pixels, this.#left);
    this.#left -= size;
    this.pieces.push(size);
    this.#give(size);
    return this.#left > 0;
  }

  underWay(): number {
    return this.#under.length;
  }

  show(): void {
    this.shown.push(this.#picture);
  }

  end(): void {}

  pass(ms: number): void {
    let pixels = ms * this.#speed;
    for (const piece of this.#under) {
      const done = Math.min(pixels, piece.pixels);
      piece.pixels -= done;
      pixels -= done;
    }
    this.#under = this.#under.filter((piece) => piece.pixels > 0);
  }
}

/** Draws samples of stills, each of which takes so many ms of the time that goes by. */
export class Samplers implements Stills {
  begun = 0;
  ended = 0;
  samples = 0;
  /** Of what is on the screen, the share that the mean has. */
  share = 0;
  readonly shares: number[] = [];
  /** The device was given something that nobody has waited for. */
  #isBusy = true;
  readonly #ms: number;

  constructor(ms: number) {
    this.#ms = ms;
  }

  make(): boolean {
    return false;
  }

  begin(): void {
    assert(!this.#isBusy, 'the page waits for the device');
    this.begun += 1;
    this.samples = 0;
  }

  draw(): boolean {
    this.#isBusy = true;
    this.samples += 1;
    return false;
  }

  async done(): Promise<void> {
    await new Promise((resolve) => setTimeout(resolve, this.#ms));
    this.#isBusy = false;
  }

  show(): void {}

  blend(opacity: number): void {
    this.share += (1 - this.share) * opacity;
    this.shares.push(this.share);
  }

  end(): void {
    this.ended += 1;
  }
}

export type Mock = { timers: { tick(ms: number): void }; method: typeof import('node:test').mock.method };

/** The time goes on, in steps of a screen's frames. */
export async function pass(mock: Mock, device: Device, ms: number): Promise<void> {
  for (let at = 0; at < ms; at += 4) {
    mock.timers.tick(4);
    screen.clock += 4;
    device.pass(4);
    if (at % 16 === 0) present(0);
    await settled();
  }
}

/** What waits for nothing but promises, and scripts that are imported, is done. */
export async function settled(): Promise<void> {
  for (let k = 0; k < 4; k += 1) await new Promise((resolve) => setImmediate(resolve));
}

export const SWIFTSHADER = 'webgl ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero)), SwiftShader driver)';

export async function setUpSoftware(mock: Mock, speed: number, stills?: Stills) {
  mock.method(performance, 'now', () => screen.clock);
  const device = new Device(speed);
  const set = setUp({ pieces: device, stills });
  set.pacer.renew(SWIFTSHADER);
  await settled();
  return { ...set, device };
}
