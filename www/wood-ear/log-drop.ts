/** Files that are dragged over a picture and dropped on it. */

import { addStyles, removeStyles } from '../base/document-styles.ts';
import { droppedFiles, hasFiles, NO_FILES } from '../base/dropped-files.ts';
import { filled } from '../base/filled.ts';
import type { Language } from '../base/language.ts';

const WORDS = {
  drop: {
    en: 'Drop a GLB or OBJ file: it becomes the log. A picture or file made here brings its scene back',
    ja: 'GLB・OBJ ファイルは丸太になります。ここで作った画像やファイルは、そのシーンに戻ります',
  },
  beside: { en: '{file} was opened; of the other files nothing was read', ja: '{file} を開きました。ほかのファイルは読み込んでいません' },
} as const;

/** What a log can be read from, by name. Material libraries and pictures come beside it. */
const LOGS = /\.(glb|gltf|obj)$/i;

const STYLES = `
.drop {
  position: absolute; inset: 0; display: grid; place-items: center; padding: 1em; text-align: center; pointer-events: none;
  font: .875rem/1.4 system-ui, sans-serif; color: #fff; background: rgb(20 20 24 / .5);
  outline: 3px dashed var(--rock-field-accent, Highlight); outline-offset: -10px;
}
.drop span { padding: .5em .9em; border-radius: .5em; background: rgb(20 20 24 / .82); text-wrap: balance }
.drop[hidden] { display: none }
`;

export interface DropOwner {
  root: ShadowRoot;
  language: () => Language;
  isOpen: () => boolean;
  open: (files: readonly File[]) => void;
}

/** Of files that were brought together the one that has the log. */
export function logAmong(files: Iterable<File>): File | undefined {
  const all = [...files];
  return all.find(({ name }) => LOGS.test(name)) ?? all[0];
}

export function nothingDropped(language: Language): string {
  return NO_FILES[language];
}

/** What is said where several files could have been the log; else null. */
export function besideNotice(files: Iterable<File>, language: Language): string | null {
  const logs = [...files].filter(({ name }) => LOGS.test(name));
  return logs.length > 1 ? filled(WORDS.beside[language], { file: logs[0]?.name ?? '' }) : null;
}

/** Listens on `host`, over which a frame is shown while files are dragged. */
export function listenToDrops(host: HTMLElement, { root, language, isOpen, open }: DropOwner, signal: AbortSignal): void {
  const frame = document.createElement('div');
  const words = document.createElement('span');
  frame.className = 'drop';
  frame.setAttribute('part', 'drop');
  frame.hidden = true;
  frame.append(words);
  addStyles(root, STYLES);
  root.append(frame);
  const on = (type: string, listener: (event: DragEvent) => void) => host.addEventListener(type, listener as EventListener, { signal });
  on('dragover', (event) => {
    if (!isOpen() || !hasFiles(event)) return;
    event.preventDefault();
    if (event.dataTransfer) event.dataTransfer.dropEffect = 'copy';
    words.textContent = WORDS.drop[language()];
    frame.hidden = false;
  });
  on('dragleave', ({ relatedTarget }) => {
    frame.hidden = !(relatedTarget instanceof Node && host.contains(relatedTarget));
  });
  on('drop', (event) => {
    frame.hidden = true;
    // A page may have taken it already.
    if (event.defaultPrevented || !isOpen() || !hasFiles(event)) return;
    event.preventDefault();
    // What cannot be read is refused by name when it is opened.
    const { dataTransfer } = event;
    droppedFiles(dataTransfer).then(open, () => open([]));
  });
  signal.addEventListener('abort', () => {
    frame.remove();
    removeStyles(root, STYLES);
  });
}
