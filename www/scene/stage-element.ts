/**
 * An element as a place on a page: its shadow tree, its size and whether it can be seen, its language, and what it says.
 *
 * Nothing is loaded before the element stands in a document. Moving it costs nothing: it is torn down only when it has been out of the
 * document for `IDLE_TIMEOUT_MS`. What it has lives for one *cycle*, from `entered` to `left`.
 */

import { CAN_SHOW } from '../base/document-styles.ts';
import { languageOf, watchLanguage } from './language.ts';
import { StageSize } from './stage-size.ts';
import { SceneTree } from './tree.ts';
import { Visibility } from './visibility.ts';
import { WORDS } from './words.ts';

/** How long an element may be out of the document before its worker, device and buffers go. */
export const IDLE_TIMEOUT_MS = 1000;

/** On a server there is no HTMLElement; importing must be silent there, and nobody makes an element. */
const Base = (globalThis.HTMLElement ?? class {}) as typeof HTMLElement;

/**
 * @attr poster - Address of a picture that stands in until the first one is painted.
 * @attr disabled - Nothing moves the camera, and the picture takes no focus.
 */
export abstract class StageElement extends Base {
  #tree!: SceneTree;
  #isStarted = false;
  #closing: ReturnType<typeof setTimeout> | undefined;
  /** Ends every listener and observer of the cycle. */
  #listening: AbortController | undefined;
  #speaking: AbortController | undefined;
  #spoken: 'en' | 'ja' | undefined;
  #size: StageSize | undefined;
  #visibility: Visibility | undefined;

  constructor() {
    super();
    // The fallback class of a server has no shadow root, and no document to build for.
    if (typeof this.attachShadow !== 'function') return;
    this.#tree = new SceneTree(this.attachShadow({ mode: 'open' }), () => this.retry());
  }

  // What the layers above add. Those that override one of another layer call it, too.

  /** A cycle begins; `signal` is aborted when it ends. */
  protected abstract entered(signal: AbortSignal): void;
  /** The cycle has ended. */
  protected abstract left(): void;
  /** Within a cycle: what costs something begins. */
  protected abstract opened(): void;
  /** What was opened has ended: lets go of everything. */
  protected abstract closed(): void;
  /** The stage has another size, in device pixels. */
  protected abstract resized(): void;
  /** The element has come into view or out of it. */
  protected abstract sighted(): void;
  /** Asks for a frame; many calls, one frame. */
  protected abstract invalidate(): void;
  /** Tries again what failed. */
  protected abstract retry(): void;

  /** What the picture is of, in a word or two. */
  protected get label(): string {
    return WORDS.label[this.language];
  }

  protected get tree(): SceneTree {
    return this.#tree;
  }

  /** Holds the canvas and the focus. */
  protected get stage(): HTMLElement {
    return this.#tree.stage;
  }

  /** Undefined out of a cycle. */
  protected get stageSize(): StageSize | undefined {
    return this.#size;
  }

  protected get aspect(): number {
    return this.#size?.aspect ?? 2;
  }

  /** Whether a frame would be seen. */
  protected get isSeen(): boolean {
    return this.isConnected && this.#visibility?.visible === true && this.#size?.isEmpty === false;
  }

  /** Aborted when the cycle ends; undefined before the first one. */
  protected get cycle(): AbortSignal | undefined {
    return this.#listening?.signal;
  }

  /** Whether a cycle has begun. */
  protected get isOpen(): boolean {
    return this.cycle?.aborted === false;
  }

  /** The window that the element is in: one of a frame or a popup, perhaps. */
  protected get ownWindow(): Window & typeof globalThis {
    return this.ownerDocument.defaultView ?? window;
  }

  /** The page's language, from the nearest `lang`. */
  protected get language(): 'en' | 'ja' {
    return languageOf(this);
  }

  // What it says.

  /** What the picture shows, for those who cannot see it. */
  protected describe(text: string): void {
    this.#tree.describe(text);
  }

  /** 0 … 1 while a run is under way that takes longer; null otherwise. */
  protected showProgress(fraction: number | null): void {
    this.#tree.showProgress(fraction);
    if (fraction === null) this.style.removeProperty('--rock-field-progress');
    else this.style.setProperty('--rock-field-progress', fraction.toFixed(3));
  }

  /** False when it is an `error` that a listener tells the user itself. */
  protected emit(type: string, detail: unknown = null): boolean {
    return this.dispatchEvent(new CustomEvent(type, { detail, bubbles: false, composed: true, cancelable: /error|notice/.test(type) }));
  }

  /** Something was put right, or left out, for an attribute: said once on the console, once by event, for a while on the picture unless the event is prevented. */
  protected notify(message: string): void {
    console.warn(`<${this.localName}>: ${message}`);
    if (this.emit('notice', { message })) this.say(message);
  }

  /** Shown on the picture for a while. */
  protected say(text: string): void {
    this.#tree.messages.notify(text);
  }

  /** Takes back what is said on the picture and no longer holds. */
  protected unsay(text: string): void {
    this.#tree.messages.forget(text);
  }

  /** Attributes that are no parameters changed. */
  protected readManners(): void {
    if (!CAN_SHOW) return;
    this.#tree.setPoster(this.getAttribute('poster'));
    this.#tree.setDisabled(this.hasAttribute('disabled'));
    this.invalidate();
  }

  // Lifecycle.

  connectedCallback(): void {
    if (!CAN_SHOW) return;
    clearTimeout(this.#closing);
    if (this.isOpen) {
      this.#speak();
      this.invalidate();
      return;
    }
    this.#listen();
    this.#speak();
    this.readManners();
    this.loadUnlessLazy();
  }

  disconnectedCallback(): void {
    this.#closing = setTimeout(() => this.#close(), IDLE_TIMEOUT_MS);
  }

  /** In another document everything is another: styles, observers, frames. The field stays. */
  adoptedCallback(): void {
    clearTimeout(this.#closing);
    if (this.isOpen) this.#close();
    this.#tree.dress();
  }

  protected loadUnlessLazy(): void {
    if (this.getAttribute('loading')?.trim() !== 'lazy') this.start();
  }

  /** Begins what costs something; where loading is lazy, as soon as the element comes near. */
  protected start(): void {
    if (this.#isStarted || !this.isOpen) return;
    this.#isStarted = true;
    this.opened();
  }

  #listen(): void {
    this.#listening = new AbortController();
    const { signal } = this.#listening;
    this.#tree.box(this.ownWindow);
    this.#size = new StageSize(this.stage, () => this.resized(), signal);
    this.#visibility = new Visibility(this, () => this.#onVisibility(), signal);
    this.entered(signal);
  }

  #onVisibility(): void {
    if (this.#visibility?.near) this.start();
    this.sighted();
  }

  #close(): void {
    this.#listening?.abort();
    this.#speaking?.abort();
    this.left();
    this.#visibility = undefined;
    this.#size = undefined;
    this.#tree.messages.forget();
    if (this.#isStarted) this.closed();
    this.#isStarted = false;
  }

  /** In the language of where the element stands now, and whenever that changes. */
  #speak(): void {
    this.#speaking?.abort();
    this.#speaking = new AbortController();
    const say = () => {
      const { language } = this;
      if (language === this.#spoken) return;
      this.#spoken = language;
      this.relabel();
    };
    watchLanguage(this, say, this.#speaking.signal);
    say();
  }

  /** Says in the present language what is said all the time. */
  protected relabel(): void {
    this.#tree.setLanguage(this.language, WORDS.role[this.language], this.label);
    this.invalidate();
  }
}
