/** What an element has to say, at the foot of its picture: why there is none, what was put right, what it shows instead, and a button to try again. */

import type { Language } from '../base/language.ts';

const NOTICE_MS = 8000;

const RETRY = { en: 'Retry', ja: '再試行' } as const;

/** Text only: sentences may quote what came from a link. */
export class MessageBox {
  readonly element = document.createElement('div');
  #errorText = document.createElement('span');
  #errorSlot = document.createElement('slot');
  #text = document.createElement('span');
  #button = document.createElement('button');
  #error = '';
  #notices = new Set<string>();
  #standing = '';
  #loading = '';
  #canRetry = false;
  #canRetryStanding = false;
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** `retry` is what the button does. */
  constructor(retry: () => void) {
    this.#button.type = 'button';
    this.#button.hidden = true;
    this.#button.addEventListener('click', () => {
      this.#button.disabled = true;
      retry();
    });
    this.element.className = 'message';
    this.element.setAttribute('part', 'message');
    this.element.setAttribute('role', 'status');
    this.element.hidden = true;
    this.#errorSlot.name = 'error';
    this.#errorSlot.append(this.#errorText);
    this.#errorSlot.hidden = true;
    this.element.append(this.#errorSlot, this.#text, this.#button);
  }

  /** What the button is called. */
  setLanguage(language: Language): void {
    this.#button.textContent = RETRY[language];
  }

  /** Why there is no picture, or an old one; empty once there is. `canRetry`: another try may help. */
  setError(text: string, canRetry = false): void {
    this.#error = text;
    this.#canRetry = canRetry;
    this.#tried();
  }

  /** What holds for as long as the picture is as it is; with `canRetry`, another try may change it. */
  setStanding(text: string, canRetry: boolean): void {
    this.#standing = text;
    this.#canRetryStanding = canRetry;
    this.#tried();
  }

  /** What is still on its way. */
  setLoading(text: string): void {
    this.#loading = text;
    this.#update();
  }

  /** Whatever was tried, it is over. */
  #tried(): void {
    this.#button.disabled = false;
    this.#update();
  }

  /** Shown for a while, beside those that were given shortly before. */
  notify(text: string): void {
    this.#notices.add(text);
    this.#update();
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.forget(), NOTICE_MS);
  }

  /** Takes a notice back; without `text`, all of them. */
  forget(text?: string): void {
    if (text) this.#notices.delete(text);
    else this.#notices.clear();
    this.#update();
  }

  #update(): void {
    const text = [...this.#notices, this.#standing, this.#loading].filter(Boolean).join('\n');
    if (this.#errorText.textContent !== this.#error) this.#errorText.textContent = this.#error;
    this.#errorSlot.hidden = !this.#error;
    if (this.#text.textContent !== text) this.#text.textContent = text;
    this.#button.hidden = !this.#canRetry && !this.#canRetryStanding;
    this.element.hidden = !text && !this.#error;
  }
}
