/** What went wrong with a picture, and who hears of it: listeners of `error`, the reader of the picture, and those who wait for one. */

import { ErrorPace } from '../base/error-pace.ts';
import type { ErrorDetail } from '../base/error-pace.ts';
import { isPassing, RockFieldError } from '../base/errors.ts';
import type { ErrorInfo } from '../base/errors.ts';
import type { Language } from '../base/language.ts';
import { lazily } from '../base/lazy.ts';
import type { MessageBox } from './message-box.ts';

/** The picture that may fail. */
export interface Failing {
  hasPicture(): boolean;
  language(): Language;
  messages(): MessageBox;
  /** Emits the event; at most one a second. */
  tell(detail: ErrorDetail): void;
}

export class Failures {
  readonly #picture: Failing;
  readonly #pace: ErrorPace;
  /** Why there is no picture, or not the one that was asked for. */
  #failure: ErrorInfo | null = null;
  #waiting: ((error?: RockFieldError) => void)[] = [];

  constructor(picture: Failing) {
    this.#picture = picture;
    this.#pace = new ErrorPace((detail) => picture.tell(detail));
  }

  /** What there is instead of a picture, or of the one that was asked for. */
  get error(): RockFieldError | null {
    return this.#failure && new RockFieldError(this.#failure);
  }

  /** Calls `tell` once: when there is a picture, or with the reason why there will be none. */
  wait(tell: (error?: RockFieldError) => void): void {
    this.#waiting.push(tell);
  }

  /** An `error` event; also a message in the element while it has no picture to show instead. */
  report(error: ErrorInfo): void {
    const hasPicture = this.#picture.hasPicture();
    if (!hasPicture || isPassing(error)) {
      this.#failure = error;
      this.say();
      if (!hasPicture) this.#tellWaiting(new RockFieldError(error));
    }
    // Whether the element's own message says it.
    const shown = error.name === 'DeviceLost' || (error === this.#failure && error.key === undefined);
    this.#pace.push({ error, shown });
  }

  /** Says the failure, if there is one, in the present language. */
  say(): void {
    const error = this.#failure;
    if (!error) return;
    const language = this.#picture.language();
    const canRetry = isPassing(error) || /Renderer/.test(error.name);
    const say = (text: string): void => this.#picture.messages().setError(text, canRetry);
    say(error.words?.[language] ?? error.message);
    if (error.words || language === 'en') return;
    lazily(() => import('../base/failures.ja.ts'), true).then(
      ({ japaneseFailure }) => this.#failure === error && say(japaneseFailure(error.message)),
      () => undefined,
    );
  }

  /** Another run may succeed, or has. */
  forget(): void {
    this.#failure = null;
    this.#picture.messages().setError('');
  }

  /** There is a picture. */
  end(): void {
    this.forget();
    this.#tellWaiting();
  }

  /** The cycle has ended without one. */
  close(reason: RockFieldError): void {
    this.#failure = null;
    this.#tellWaiting(reason);
  }

  #tellWaiting(error?: RockFieldError): void {
    for (const tell of this.#waiting.splice(0)) tell(error);
  }
}
