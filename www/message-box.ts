/** What an element has to say, at the foot of its picture: why there is none, what was put right, what it shows instead. */

const NOTICE_MS = 8000;

/** Text only: sentences may quote what came from a link. */
export class MessageBox {
  readonly element = document.createElement('div');
  #errorText = document.createElement('span');
  #errorSlot = document.createElement('slot');
  #text = document.createElement('span');
  #error = '';
  #notices: string[] = [];
  #standing = '';
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor() {
    this.element.className = 'message';
    this.element.setAttribute('part', 'message');
    this.element.setAttribute('role', 'status');
    this.element.hidden = true;
    this.#errorSlot.name = 'error';
    this.#errorSlot.append(this.#errorText);
    this.#errorSlot.hidden = true;
    this.element.append(this.#errorSlot, this.#text);
  }

  /** Why there is no picture; empty once there is one. */
  setError(text: string): void {
    this.#error = text;
    this.#update();
  }

  /** What holds for as long as the picture is as it is. */
  setStanding(text: string): void {
    this.#standing = text;
    this.#update();
  }

  /** Shown for a while, beside those that were given shortly before. */
  notify(text: string): void {
    this.#notices.push(text);
    this.#update();
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.forgetNotices(), NOTICE_MS);
  }

  forgetNotices(): void {
    clearTimeout(this.#timer);
    this.#notices = [];
    this.#update();
  }

  #update(): void {
    const text = [...this.#notices, this.#standing].filter((line) => line !== '').join('\n');
    if (this.#errorText.textContent !== this.#error) this.#errorText.textContent = this.#error;
    this.#errorSlot.hidden = this.#error === '';
    if (this.#text.textContent !== text) this.#text.textContent = text;
    this.element.hidden = text === '' && this.#error === '';
  }
}
