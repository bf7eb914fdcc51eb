/** `<live-example>`: HTML in an editor, and beside it what the HTML does. The markup is made by the build; this brings it to life. */

import { copyButton } from './copy.ts';
import { keep, wake } from './keeper.ts';
import type { Kept } from './keeper.ts';
import { word } from './words.ts';

/** After the last key. */
const RUN_AFTER_MS = 400;

/** For what stands in a result: it is a document of its own, as far as styles go. */
const STYLES = `
:host { display: grid; gap: .75rem; align-content: start; justify-items: start; padding-block-end: 1rem }
:host > * { margin: 0 1rem; max-width: calc(100% - 2rem) }
:host > rock-field { width: 100%; max-width: none; height: var(--example-height, 19rem); margin: 0 }
:host > .bar { justify-self: stretch }
button, select { min-height: 2.25rem; padding: 0 .9rem; border: 1px solid var(--line-strong); border-radius: var(--radius); background: var(--surface-raised); color: inherit; font: inherit }
button { cursor: pointer }
button:hover { background: var(--surface-sunken) }
label { display: flex; flex-wrap: wrap; align-items: center; gap: .25rem .75rem; min-height: 2.25rem }
input, progress { accent-color: var(--accent) }
input[type=range] { width: 14rem; max-width: 100%; height: 1.5rem }
input[type=checkbox] { width: 1.25rem; height: 1.25rem; margin: 0 }
output { font-variant-numeric: tabular-nums }
a { color: var(--accent) }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px }
`;

let sheet: CSSStyleSheet | undefined;

export class LiveExample extends HTMLElement implements Kept {
  #root: ShadowRoot | undefined;
  #message = document.createElement('p');
  #editor: HTMLTextAreaElement | undefined;
  #result: HTMLElement | undefined;
  #source = '';
  #run = 0;
  #editing: ReturnType<typeof setTimeout> | undefined;

  get box(): Element {
    return this;
  }

  connectedCallback(): void {
    const editor = this.querySelector('textarea');
    const result = this.querySelector<HTMLElement>('.result');
    if (this.#root || !editor || !result) return;
    this.#editor = editor;
    this.#result = result;
    this.#source = editor.value;
    this.#root = result.attachShadow({ mode: 'open' });
    sheet ??= styles();
    this.#root.adoptedStyleSheets = [sheet];
    this.#message.className = 'example-message';
    this.#message.setAttribute('role', 'status');
    const buttons = document.createElement('div');
    buttons.className = 'editor-buttons';
    buttons.append(
      this.#resetButton(editor),
      copyButton(() => editor.value),
    );
    this.querySelector('.editor-label')?.after(buttons);
    editor.after(this.#message);
    editor.addEventListener('input', () => this.#edited(editor));
    editor.addEventListener('keydown', (event) => keepIndent(event, editor));
    keep(this);
  }

  /** Renders the HTML and runs its scripts. Resolves when the scripts have run to their ends. */
  start(): void {
    void this.run();
  }

  async run(): Promise<void> {
    const root = this.#root;
    if (!root || !this.#editor) return;
    this.#run += 1;
    const run = this.#run;
    this.#say('');
    const template = document.createElement('template');
    template.innerHTML = this.#editor.value;
    const content = document.importNode(template.content, true);
    const scripts = [...content.querySelectorAll('script')];
    for (const script of scripts) script.remove();
    root.replaceChildren(content);
    try {
      for (const script of scripts) {
        if (script.src) this.#say(word('externalScript'));
        else if (run === this.#run) await runScript(script.text, root);
      }
    } catch (thrown) {
      if (run === this.#run) this.#say(String(thrown));
    }
  }

  /** Puts the result away; its place stays as large as it was. */
  stop(): void {
    if (!this.#root || !this.#result) return;
    this.#run += 1;
    this.#result.style.minBlockSize = `${this.#result.offsetHeight}px`;
    this.#root.replaceChildren();
  }

  #edited(editor: HTMLTextAreaElement): void {
    editor.rows = editor.value.split('\n').length;
    clearTimeout(this.#editing);
    this.#editing = setTimeout(() => {
      if (this.#result) this.#result.style.minBlockSize = '';
      wake(this);
      void this.run();
    }, RUN_AFTER_MS);
  }

  #resetButton(editor: HTMLTextAreaElement): HTMLButtonElement {
    const button = document.createElement('button');
    button.type = 'button';
    button.className = 'button';
    button.textContent = word('reset');
    button.addEventListener('click', () => {
      editor.value = this.#source;
      this.#edited(editor);
    });
    return button;
  }

  #say(text: string): void {
    this.#message.textContent = text;
    this.#message.hidden = text === '';
  }
}

function styles(): CSSStyleSheet {
  const made = new CSSStyleSheet();
  made.replaceSync(STYLES);
  return made;
}

/**
 * Runs a script as a module whose `document` finds only what is in the example: so every example reads like a page of its own.
 * A module from a blob, since a policy can allow those without allowing `eval`.
 */
async function runScript(code: string, root: ShadowRoot): Promise<void> {
  const address = URL.createObjectURL(new Blob([`export default async (document) => {\n${code}\n};`], { type: 'text/javascript' }));
  try {
    const script = (await import(address)) as { default: (scope: Document) => Promise<void> };
    await script.default(scopeOf(root));
  } finally {
    URL.revokeObjectURL(address);
  }
}

const SCOPED = ['querySelector', 'querySelectorAll', 'getElementById'] as const;

function scopeOf(root: ShadowRoot): Document {
  return new Proxy(document, {
    get(target, key) {
      const isScoped = SCOPED.some((name) => name === key);
      const owner = isScoped ? root : target;
      const value: unknown = Reflect.get(owner, key, owner);
      return typeof value === 'function' ? value.bind(owner) : value;
    },
    set: (target, key, value) => Reflect.set(target, key, value, target),
  });
}

/** Enter keeps the indentation of its line. Tab is left alone: it leads out of the editor, as everywhere on a page. */
function keepIndent(event: KeyboardEvent, editor: HTMLTextAreaElement): void {
  if (event.key !== 'Enter' || event.isComposing || event.ctrlKey || event.metaKey || event.altKey) return;
  const before = editor.value.slice(0, editor.selectionStart);
  const [indent = ''] = /^[ \t]*/.exec(before.slice(before.lastIndexOf('\n') + 1)) ?? [];
  if (indent === '') return;
  event.preventDefault();
  // Deprecated, and still the only way that keeps the editor's own undo.
  document.execCommand('insertText', false, `\n${indent}`);
}
