/** Files of the page's scenes: those that are dropped on it, pasted or opened bring theirs back, as one step of undo; and what is shown becomes one. */

import { droppedFiles, hasFiles, NO_FILES } from '../base/dropped-files.ts';
import { errorInfo } from '../base/errors.ts';
import type { ErrorInfo } from '../base/errors.ts';
import { shown } from '../base/file-name.ts';
import type { Language } from '../base/language.ts';
import { lazily } from '../base/lazy.ts';
import { toast } from '../controls/dialogs.ts';
import type { Panel } from '../controls/panel.ts';
import type { OpenedLink, Store } from '../controls/store.ts';
import { translate } from '../controls/strings.ts';
import type { StringKey } from '../controls/strings.en.ts';
import { errorText, later } from '../controls/strings-later.ts';
import type { GeneratorElement } from '../element/generator-element.ts';
import { importedScene, isSceneFile } from '../element/import-file.ts';
import type { ImportedScene, LinkReading } from '../element/import-file.ts';
import type { Kind } from '../table/table.ts';

/** What of the page is used. */
export interface FileParts<K extends Kind> {
  store: Store<K>;
  element: GeneratorElement<K>;
  panel: Panel<K>;
  /** Shows what a link says. */
  open: (link: OpenedLink<K>) => void;
}

/** What the generators differ in. */
export interface Files<K extends Kind> {
  reading: LinkReading<K>;
  /** Of what the present parameters make, as soon as it is there. */
  hash: () => Promise<string>;
  /** The page of the other generator with the scene of a file of its, or what was pasted. */
  otherPage: (file: File | string) => Promise<{ name: StringKey; address: string }>;
  /** Takes what is no scene; absent where nothing does. */
  takeOthers?: (files: readonly File[]) => void;
  /** Takes a picture that is no scene; what frames it while it is dragged. Absent where pictures are scenes only. */
  pictures?: { take: (file: File) => Promise<void>; invitation: (language: Language) => string };
}

/** Of files that came together, so many are looked into. */
const MOST_FILES = 24;
const TOAST_MS = 4000;

export function bringBack<K extends Kind>(parts: FileParts<K>, files: Files<K>): void {
  const { store, panel } = parts;
  const openFiles = (given: readonly File[]): void => void openAny(parts, files, given);
  const showIt = async (): Promise<void> => {
    const { showPicture } = await lazily(() => import('../controls/picture-dialog.ts'));
    const { origin, pathname } = location;
    const address = `${origin}${pathname}#${panel.actions.link?.()}`;
    showPicture({ store, element: parts.element, title: panel.presetName(), address });
  };
  panel.actions = { ...panel.actions, openFiles, showPicture: () => void showIt() };
  listenToDrops(store, openFiles, files);
  document.addEventListener('paste', (event) => {
    const { clipboardData } = event;
    const pasted = [...(clipboardData?.files ?? [])];
    if (pasted.length === 0 && isTyping(event)) return;
    if (pasted.length > 0) openFiles(pasted);
    else void openOne(parts, files, clipboardData?.getData('text/plain') ?? '');
    event.preventDefault();
  });
}

function listenToDrops<K extends Kind>(
  store: Store<K>,
  openFiles: (files: readonly File[]) => void,
  { takeOthers, pictures }: Files<K>,
): void {
  // Where others are taken, the element says by itself what may be dropped on it.
  const hasFrame = takeOthers !== undefined;
  const frame = document.createElement('p');
  const words = frame.appendChild(document.createElement('span'));
  frame.className = 'drop-frame';
  frame.hidden = true;
  if (!hasFrame) document.querySelector('.stage')?.append(frame);
  window.addEventListener('dragover', (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    if (event.dataTransfer) event.dataTransfer.dropEffect = 'copy';
    words.textContent = pictures?.invitation(store.language) ?? later(store.language, 'dropFile');
    frame.hidden = false;
  });
  window.addEventListener('dragleave', ({ relatedTarget }) => {
    frame.hidden ||= relatedTarget === null;
  });
  // Before the element, which would take it for a log. Left alone, the browser would leave the page for the file.
  const take = (event: DragEvent): void => {
    frame.hidden = true;
    if (!hasFiles(event)) return;
    event.preventDefault();
    droppedFiles(event.dataTransfer).then(openFiles, () => openFiles([]));
  };
  window.addEventListener('drop', take, true);
}

/** Whether what is pasted is meant for a field of the page. */
function isTyping(event: Event): boolean {
  const [target] = event.composedPath();
  return target instanceof HTMLElement && (target.isContentEditable || /^(input|textarea|select)$/i.test(target.localName));
}

/** Of several files the first that is a scene. */
async function openAny<K extends Kind>(parts: FileParts<K>, files: Files<K>, given: readonly File[]): Promise<void> {
  for (const file of given.slice(0, MOST_FILES)) if (await isSceneFile(file)) return openOne(parts, files, file);
  const [file] = given;
  if (files.takeOthers) files.takeOthers(given);
  else if (file) await openOne(parts, files, file);
  else parts.store.say((language) => NO_FILES[language], true);
}

async function openOne<K extends Kind>({ store, open }: FileParts<K>, files: Files<K>, file: File | string): Promise<void> {
  let scene: ImportedScene<K>;
  try {
    scene = await importedScene(files.reading, file);
  } catch (thrown) {
    const error = errorInfo(thrown);
    if (files.pictures && error.name === 'ImportForeign' && isPicture(file)) await files.pictures.take(file);
    else await refuse(store, files, file, error);
    return;
  }
  open(scene);
  const name = typeof file === 'string' ? '' : shown(file.name);
  let made: string;
  try {
    made = await files.hash();
  } catch {
    // That is said where it happened.
    return;
  }
  if (scene.hash !== '' && made !== scene.hash) store.say((language) => later(language, 'sceneDiffers', { file: name }));
  else toast(document.body, later(store.language, name === '' ? 'scenePasted' : 'sceneBack', { file: name }), TOAST_MS);
}

function isPicture(file: File | string): file is File {
  return file instanceof File && file.type.startsWith('image/');
}

function otherWords(language: Language, file: File | string, page: string): string {
  return typeof file === 'string'
    ? later(language, 'pastedOther', { page })
    : later(language, 'otherPage', { file: shown(file.name), page });
}

/** Says why nothing came of it; of a scene of the other page, with a button that goes there. */
async function refuse<K extends Kind>(store: Store<K>, files: Files<K>, file: File | string, error: ErrorInfo): Promise<void> {
  try {
    // Parameters that are unknown here may be known there.
    if (error.name !== 'ImportOther' && error.name !== 'UnknownKey') throw error;
    const { name, address } = await files.otherPage(file);
    store.setRemedy({
      text: (language) => otherWords(language, file, translate(language, name)),
      label: (language) => later(language, 'openThere'),
      act: () => location.assign(address),
    });
  } catch {
    store.say((language) => errorText(language, error), true);
  }
}
