// For functions that are evaluated in a page: the names that the pages of these tests define, and elements that are there, because a test that
// looks for one in vain fails by itself.

import type { RockFieldElement } from '../../www/entries/rock-field.ts';
import type { WoodEarLogElement } from '../../www/entries/wood-ear-log.ts';
import type { ErrorInfo as Told } from '../../www/base/errors.ts';

/** An element as a test finds it: with its shadow root, and with what has grown. */
type Shown<E> = E & { readonly [Name in keyof E & ('shadowRoot' | 'field' | 'colony' | 'scene')]: NonNullable<E[Name]> };

/** A canvas that is drawn on, or that can be. */
type Canvas = { getContext(kind: '2d'): CanvasRenderingContext2D } & HTMLCanvasElement;

/** A <rock-field> with what a <wood-ear-log> has beside it, for tests of either: they know which of the two they have. */
type EitherElement = Shown<RockFieldElement> & Omit<Shown<WoodEarLogElement>, keyof RockFieldElement>;

/** An event that a page has written down, with as much of its detail as its tests look at. */
interface Heard {
  type: string;
  /** Of an error. */
  name: string;
  message: string;
  error: Told;
  rocks: number;
  detail: { message: string; error: Told };
}

declare global {
  /** What a test reads of an error that it has caught. */
  type ErrorInfo = Told;

  interface ParentNode {
    querySelector(selectors: 'rock-field, wood-ear-log'): EitherElement;
    querySelector(selectors: `${string}canvas`): Canvas;
    querySelector(selectors: `input${string}`): HTMLInputElement;
    querySelector(selectors: `button${string}`): HTMLButtonElement;
    querySelector<K extends keyof HTMLElementTagNameMap>(selectors: K): Shown<HTMLElementTagNameMap[K]>;
    querySelector(selectors: string): Shown<HTMLElement>;
    querySelectorAll(selectors: 'rock-field, wood-ear-log'): NodeListOf<EitherElement>;
    querySelectorAll(selectors: `${string}input:checked`): NodeListOf<HTMLInputElement>;
    querySelectorAll<K extends keyof HTMLElementTagNameMap>(selectors: K): NodeListOf<Shown<HTMLElementTagNameMap[K]>>;
    querySelectorAll(selectors: string): NodeListOf<Shown<HTMLElement>>;
  }

  /** The element under test, the first one of the page; `b` is a second one, or the place that the first is moved to. */
  var a: EitherElement;
  var b: EitherElement;
  /** What the element has said. */
  var heard: Heard[];

  // browser.mjs
  var passTime: () => void;
  var releaseTimers: () => void;
  var results: { hold(): void; release(): void; readonly held: number };

  // element-page.mjs, many.test.mjs, quality.test.mjs
  var counts: { frames: number; workers: number; ended: number };
  var frames: number;
  var frame: () => Promise<number>;
  var types: () => string[];
  var loseContext: () => void;
  var held: () => { contexts: number; devices: number; workers: number; listeners: number };
  var sleep: (ms: number) => Promise<void>;
  var anchor: RockFieldElement;

  // places-page.mjs
  var until: (test: () => unknown) => Promise<void>;
  var colours: (picture: ImageBitmapSource) => Promise<number>;
  var outer: HTMLElement;

  // devices.test.mjs
  var all: () => EitherElement[];
  var allBack: (act: () => unknown, backend: string) => Promise<void>;
  var faults: { gone: boolean; dropped: boolean; trap: boolean };
  var hide: (isHidden: boolean) => void;
  var isPicture: (picture: Blob) => Promise<boolean>;
  var lose: () => void;
  var told: { type: string; of: number; name?: string; at: number }[];

  // controls-page.mjs
  /** How many events the element has sent, by type. */
  var eventCounts: Record<string, number>;
  /** What the panel and the element listen to outside themselves. */
  var listeners: Map<unknown, string>;
  /** What is to be collected as garbage. */
  var gone: WeakRef<object>[];
  /** Of Chromium with --expose-gc. */
  var gc: (() => void) | undefined;
  /** Keys that the page around an element has heard. */
  var keys: string[];

  // Others, each of one file.
  var axe: { run(where: Document, options: object): Promise<{ violations: import('axe-core').Result[] }> };
  var before: unknown;
  var changes: boolean[];
  var given: boolean[] | undefined;
  var grown: number | undefined;
  var injected: unknown;
  var isHurried: boolean;
  var isSame: boolean | undefined;
  var refused: (edit: () => unknown) => Promise<object>;
  var runs: number;
  var scenes: EitherElement[];
  var seen: (name: string) => Promise<string>;
  var shown: number;
  var cameraState: () => { scroll: number; scale: number; framings: number; framed: boolean } & EitherElement['camera'];
}
