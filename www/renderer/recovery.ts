/** When a scene is not drawn as it was asked for: why, in words, and when it is tried again. */

import type { Language, Words } from '../base/language.ts';
import { loadingText } from './loading.ts';
import { rendererArrived } from './artefact.ts';
import type { Refusal } from './load.ts';

/** Before the first new try, and where the device was lost again and again; doubled after each, up to the longest. */
export const FIRST_WAIT_MS = 1000;
export const CAUTIOUS_WAIT_MS = 8000;
const LONGEST_WAIT_MS = 60_000;
/** How often the words follow what has arrived of a renderer that is being fetched again. */
const LOOK_EVERY_MS = 200;

/** A renderer that has lived for so long was no accident: after its loss the waits begin anew. */
const STEADY_MS = 30_000;

const REASONS = {
  noGpu: {
    en: 'This browser offers neither WebGPU nor WebGL2 here, so the plan is drawn instead of the rocks.',
    ja: 'WebGPU も WebGL2 も使えないため、立体ではなく平面図を表示しています。',
  },
  lost: {
    en: 'The graphics device was lost; the plan is shown until it is back.',
    ja: '描画デバイスが失われました。復旧するまで平面図を表示します。',
  },
  lostOften: {
    en: 'The graphics device was lost several times; the plan is shown, and 3D is tried again later.',
    ja: '描画デバイスが何度も失われました。平面図を表示し、後で立体表示を再試行します。',
  },
  refused: {
    en: 'The graphics device cannot be used at the moment; the plan is shown until it can.',
    ja: '現在、描画デバイスを使用できません。使用できるまで平面図を表示します。',
  },
  unfetched: {
    en: 'The 3D renderer could not be loaded; the plan is shown instead. Check the connection.',
    ja: '3D 描画プログラムを読み込めませんでした。代わりに平面図を表示しています。接続を確認してください。',
  },
} as const satisfies Record<string, Words>;

/** What refusals say of a browser that has no such backend at all, or none at present. */
const ABSENT = /has no WebGPU|no graphics adapter|no WebGL2 context/;

interface Host {
  /** Tries to open a renderer as it was asked for. */
  again(): Promise<boolean>;
  /** The words have changed, or a try is over. */
  said(): void;
}

export class Recovery {
  readonly #host: Host;
  readonly #look: () => void;
  #reason: Words | null = null;
  #waitMs = FIRST_WAIT_MS;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #endedAt = -Infinity;
  #isTrying = false;
  /** Share of the renderer that the present try has fetched so far; null while it fetches nothing. */
  #arrived: number | null = null;
  #listening: AbortController | undefined;

  constructor(host: Host, arrived = rendererArrived) {
    this.#host = host;
    this.#look = () => {
      // Before the first byte the reason still holds.
      const now = arrived() || null;
      if (now === this.#arrived) return;
      this.#arrived = now;
      host.said();
    };
  }

  /** Whether a button makes sense that tries again at once: not while a try is fetching the renderer. */
  get canRetry(): boolean {
    return this.#reason !== null && this.#arrived === null;
  }

  words(language: Language): string {
    if (this.#reason && this.#arrived !== null) return loadingText(language, this.#arrived);
    return this.#reason?.[language] ?? '';
  }

  /** @param losses in the last half minute; `isTooMany`: the device was not even tried again. */
  begin(refusals: readonly Refusal[], losses: number, isTooMany: boolean): void {
    this.#stop();
    const isSteady = performance.now() - this.#endedAt > STEADY_MS;
    this.#waitMs = Math.max(isSteady ? FIRST_WAIT_MS : longer(this.#waitMs), isTooMany ? CAUTIOUS_WAIT_MS : 0);
    this.#reason = REASONS[reasonOf(refusals, losses, isTooMany)];
    const listening = new AbortController();
    this.#listening = listening;
    const now = (): void => {
      if (document.visibilityState === 'visible') void this.retry();
    };
    document.addEventListener('visibilitychange', now, { signal: listening.signal });
    window.addEventListener('online', now, { signal: listening.signal });
    this.#schedule();
    this.#host.said();
  }

  /** The picture is drawn as it was asked for, or nobody asks for it any more. */
  end(): void {
    this.#stop();
    this.#reason = null;
    this.#endedAt = performance.now();
    this.#host.said();
  }

  async retry(): Promise<void> {
    if (this.#isTrying || !this.#reason) return;
    this.#isTrying = true;
    clearTimeout(this.#timer);
    const looking = setInterval(this.#look, LOOK_EVERY_MS);
    const isBack = await this.#host.again();
    clearInterval(looking);
    this.#arrived = null;
    this.#isTrying = false;
    if (isBack || !this.#reason) return;
    this.#waitMs = longer(this.#waitMs);
    this.#schedule();
    this.#host.said();
  }

  /** Hidden pages are given no device, and need none: those wait until they are seen. */
  #schedule(): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => document.visibilityState === 'visible' && void this.retry(), this.#waitMs);
  }

  #stop(): void {
    clearTimeout(this.#timer);
    this.#listening?.abort();
  }
}

function longer(ms: number): number {
  return Math.min(LONGEST_WAIT_MS, 2 * ms);
}

function reasonOf(refusals: readonly Refusal[], losses: number, isTooMany: boolean): keyof typeof REASONS {
  const errors = refusals.map(({ error }) => error as Error);
  if (errors.some(({ name }) => /Unavailable$/.test(name))) return 'unfetched';
  if (isTooMany) return 'lostOften';
  if (losses > 0) return 'lost';
  return errors.every(({ message }) => ABSENT.test(message)) ? 'noGpu' : 'refused';
}
