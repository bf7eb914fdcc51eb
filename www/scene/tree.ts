/** The shadow tree of a scene: stage, poster, progress bar, hint, messages, and the words for those who cannot see the picture. */

import { addStyles } from '../base/document-styles.ts';
import { MessageBox } from './message-box.ts';
import type { Language } from '../base/language.ts';
import SCENE_STYLES from '../styles/scene.css';

/** Where the page's own rules leave the element inline (`* { all: revert }`): a box in its line, as an `<img>` is. */
const INLINE_STYLES = ':host { display: inline-block !important }';
/** A drag changes the picture all the time; what it shows is said when the hand rests. */
const ANNOUNCE_AFTER_MS = 800;
const HINT_MS = 1500;

export class SceneTree {
  /** Holds the canvas and the focus. */
  readonly stage = part('div', 'stage waiting');
  readonly messages: MessageBox;
  #poster = part('div', 'poster');
  #posterSlot = slot('poster');
  #progress = part('div', 'progress');
  #hint = part('div', 'hint');
  #description = part('div', 'unseen');
  #announcing: ReturnType<typeof setTimeout> | undefined;
  #hinting: ReturnType<typeof setTimeout> | undefined;

  readonly #root: ShadowRoot;
  /** Stands over the canvas while the page is printed. */
  #print: HTMLCanvasElement | undefined;

  constructor(root: ShadowRoot, retry: () => void) {
    this.#root = root;
    this.messages = new MessageBox(retry);
    this.dress();
    this.stage.setAttribute('role', 'application');
    this.stage.setAttribute('aria-describedby', 'description');
    this.#poster.setAttribute('part', 'poster');
    this.#poster.append(this.#posterSlot);
    this.#progress.setAttribute('part', 'progress');
    this.#progress.setAttribute('role', 'progressbar');
    this.#progress.hidden = true;
    this.#progress.append(slot('progress', part('div', 'bar')));
    this.#hint.setAttribute('part', 'hint');
    this.#hint.hidden = true;
    this.#hint.setAttribute('role', 'status');
    this.#description.id = 'description';
    this.#description.setAttribute('role', 'status');
    root.append(this.stage, this.#poster, this.#progress, this.#hint, this.messages.element, this.#description);
  }

  /** To be called in every new document. */
  dress(): void {
    addStyles(this.#root, SCENE_STYLES);
  }

  /** To be called when the element stands in a page: what is inline has no box for the picture, which would cover the page. */
  box(view: Window): void {
    if (view.getComputedStyle(this.#root.host).display === 'inline') addStyles(this.#root, INLINE_STYLES);
  }

  /** A copy of the canvas over it, which browsers leave out of prints when a GPU draws it; null takes it away. */
  print(canvas: HTMLCanvasElement | null): void {
    this.#print?.remove();
    this.#print = canvas ? this.makeCanvas([canvas.width, canvas.height]) : undefined;
    if (!canvas || !this.#print) return;
    this.#print.getContext('2d')?.drawImage(canvas, 0, 0);
    this.stage.append(this.#print);
  }

  setLanguage(language: Language, role: string, label: string): void {
    this.messages.setLanguage(language);
    this.stage.setAttribute('aria-roledescription', role);
    this.stage.setAttribute('aria-label', label);
    this.#progress.setAttribute('aria-label', label);
  }

  setDisabled(disabled: boolean): void {
    if (disabled) this.stage.removeAttribute('tabindex');
    else this.stage.tabIndex = 0;
    this.stage.setAttribute('aria-disabled', String(disabled));
  }

  setPoster(address: string | null): void {
    const [image] = this.#posterSlot.children;
    if (address === null) this.#posterSlot.replaceChildren();
    else if (image?.getAttribute('src') !== address) this.#posterSlot.replaceChildren(picture(address));
  }

  get hasPoster(): boolean {
    return this.#posterSlot.assignedNodes({ flatten: true }).length > 0;
  }

  /** Stands in for the picture as a poster does, and goes with it. */
  standIn(canvas: HTMLCanvasElement): void {
    this.#poster.append(canvas);
  }

  /** The first picture is there; a canvas without one is black in some browsers. */
  hidePoster(): void {
    this.stage.className = 'stage';
    this.#poster.hidden = true;
  }

  showProgress(fraction: number | null): void {
    this.#progress.hidden = fraction === null;
    if (fraction !== null) this.#progress.ariaValueNow = String(Math.round(100 * fraction));
  }

  describe(text: string): void {
    clearTimeout(this.#announcing);
    // The first words are there at once: nobody waits for them, and what focuses the picture early finds them.
    const say = () => (this.#description.textContent = text);
    if (this.#description.textContent === '') say();
    else this.#announcing = setTimeout(say, ANNOUNCE_AFTER_MS);
  }

  /** For a renderer, which puts it into the stage when it stands. */
  makeCanvas([width, height]: readonly [number, number] = [1, 1]): HTMLCanvasElement {
    const canvas = document.createElement('canvas');
    canvas.setAttribute('part', 'canvas');
    [canvas.width, canvas.height] = [width, height];
    return canvas;
  }

  /** Shown for a moment. */
  hint(text: string, ms = HINT_MS): void {
    clearTimeout(this.#hinting);
    this.#hint.textContent = text;
    this.#hint.hidden = false;
    this.#hinting = setTimeout(() => (this.#hint.hidden = true), ms);
  }
}

function picture(address: string): HTMLImageElement {
  const image = part('img', 'poster-image');
  image.alt = '';
  image.src = address;
  return image;
}

function part<K extends 'div' | 'img'>(tag: K, className: string): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  element.className = className;
  return element;
}

function slot(name: string, ...fallback: HTMLElement[]): HTMLSlotElement {
  const element = document.createElement('slot');
  element.name = name;
  element.append(...fallback);
  return element;
}
