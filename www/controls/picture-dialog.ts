/** The dialog that saves what is shown as a picture: a postcard, or the picture itself, of any size, with the ground or without. */

import { html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import { errorInfo, isAbort } from '../base/errors.ts';
import type { ErrorInfo } from '../base/errors.ts';
import type { GeneratorElement } from '../element/generator-element.ts';
import { MAX_SIDE } from '../renderer/limits.ts';
import type { Kind } from '../table/table.ts';
import { showDialog } from './dialogs.ts';
import { icon } from './icons.ts';
import { menu } from './menu.ts';
import { segments } from './parts.ts';
import { POSTCARD, postcardOf } from './postcard.ts';
import { saveFile } from './save-file.ts';
import type { Store } from './store.ts';
import { errorText, later } from './strings-later.ts';

export interface PictureParts<K extends Kind> {
  store: Store<K>;
  element: GeneratorElement<K>;
  /** What the present preset is called. */
  title: string;
  /** The whole address of what is shown. */
  address: string;
}

/** Longer sides, px; the screen's own first. */
const SIZES = ['screen', '3840', '7680', '16384'] as const;
/** Of the picture on the screen, and of means of samples. */
const SAMPLES = ['none', '16', '64', '256'] as const;
/** f-numbers, with samples: what is in the middle of the picture is sharp. */
const APERTURES = ['none', '8', '2.8', '1.2', '0.4'] as const;
const KINDS = ['postcard', 'picture', 'cutout'] as const;

/** What was chosen last counts the next time, as long as the page is open. */
const chosen: {
  kind: (typeof KINDS)[number];
  size: (typeof SIZES)[number];
  samples: (typeof SAMPLES)[number];
  aperture: (typeof APERTURES)[number];
} = {
  kind: 'postcard',
  size: 'screen',
  samples: 'none',
  aperture: 'none',
};

interface State {
  /** What is looked at before it is saved; a postcard is saved as it is. */
  preview: Blob | null;
  /** Of the file that is being made: 0 … 1. */
  progress: number | null;
  error: ErrorInfo | null;
}

/** px of the preview of a picture. */
const PREVIEW = 960;

/** Opens the dialog. */
export function showPicture<K extends Kind>(parts: PictureParts<K>): void {
  const { store, element, title, address } = parts;
  const state: State = { preview: null, progress: null, error: null };
  let url = '';
  let making = new AbortController();
  const name = `${store.shown.preset}-${store.shown.params.seed}`;

  const show = (): HTMLDialogElement =>
    showDialog(store, document.body, store.text('picture'), content(store, state, url, hasSamples(element), { choose, save, share }));

  const set = (change: Partial<State>): void => {
    Object.assign(state, change);
    if (change.preview !== undefined) {
      URL.revokeObjectURL(url);
      url = change.preview ? URL.createObjectURL(change.preview) : '';
    }
    show();
  };

  const attempt = async (work: (signal: AbortSignal) => Promise<Partial<State>>): Promise<void> => {
    making.abort();
    making = new AbortController();
    const { signal } = making;
    let change: Partial<State>;
    try {
      change = await work(signal);
    } catch (thrown) {
      change = isAbort(thrown) ? {} : { error: errorInfo(thrown) };
    }
    if (!signal.aborted) set({ ...change, progress: null });
  };

  const look = (): Promise<void> => {
    set({ preview: null, error: null, progress: null });
    return attempt(async (signal) => {
      if (chosen.kind !== 'postcard')
        return { preview: await element.toBlob({ ...sizeOf(element, PREVIEW), ground: chosen.kind === 'picture', signal }) };
      const picture = await element.toBlob({ ...POSTCARD, signal });
      const line = `${later(store.language, 'postcardSeed', { seed: store.shown.params.seed })}   ·   ${placeOf(address)}`;
      return { preview: await postcardOf({ picture, title, line, address, language: store.language }) };
    });
  };

  const choose = (change: Partial<typeof chosen>): void => {
    Object.assign(chosen, change);
    if (change.kind) void look();
    else show();
  };

  const save = (): void => {
    if (chosen.kind === 'postcard') {
      if (state.preview) saveFile(new File([state.preview], `${name}-postcard.png`, { type: 'image/png' }));
      return;
    }
    set({ error: null, progress: 0 });
    void attempt(async (signal) => {
      const side = chosen.size === 'screen' ? undefined : Number(chosen.size);
      const blob = await element.toBlob({
        ...sizeOf(element, side),
        ground: chosen.kind === 'picture',
        ...(hasSamples(element) && chosen.samples !== 'none' && sampled()),
        signal,
        onProgress: (progress) => set({ progress }),
      });
      saveFile(new File([blob], `${name}.png`, { type: 'image/png' }));
      return {};
    });
  };

  const share = (file: File): void => {
    navigator.share({ files: [file], title }).catch((thrown: unknown) => {
      if (!isAbort(thrown)) set({ error: errorInfo(thrown) });
    });
  };

  show().addEventListener(
    'close',
    () => {
      making.abort();
      URL.revokeObjectURL(url);
    },
    { once: true },
  );
  void look();
}

/** Whether what is chosen can be the mean of samples. */
function hasSamples(element: { color: string; view: string; backend: string | null }): boolean {
  return chosen.kind === 'picture' && element.color === 'natural' && element.view === '3d' && element.backend !== 'canvas2d';
}

function sampled(): { samples: number; aperture?: number } {
  return { samples: Number(chosen.samples), ...(chosen.aperture !== 'none' && { aperture: Number(chosen.aperture) }) };
}

/** `side`: the longer one, device pixels; as on the screen where it is left out. */
function sizeOf(element: HTMLElement, side?: number): { width?: number; height?: number } {
  const { width, height } = element.getBoundingClientRect();
  if (side === undefined || width === 0 || height === 0) return {};
  const scale = Math.min(side, MAX_SIDE) / Math.max(width, height);
  return { width: Math.max(1, Math.round(scale * width)), height: Math.max(1, Math.round(scale * height)) };
}

/** Of an address, what a person would write down. */
function placeOf(address: string): string {
  const { host, pathname } = new URL(address);
  return `${host}${pathname.replace(/\/(index\.html)?$/, '')}`;
}

/** What the dialog does. */
interface Acts {
  choose: (change: Partial<typeof chosen>) => void;
  save: () => void;
  share: (file: File) => void;
}

function content<K extends Kind>(
  store: Store<K>,
  state: State,
  url: string,
  canBeSampled: boolean,
  { choose, save, share }: Acts,
): TemplateResult {
  const { language } = store;
  const { preview, progress, error } = state;
  const isPostcard = chosen.kind === 'postcard';
  const file = isPostcard && preview ? new File([preview], 'postcard.png', { type: 'image/png' }) : null;
  const canShare = file !== null && navigator.canShare?.({ files: [file] });
  return html`
    ${segments({
      name: 'picture-kind',
      label: later(language, 'pictureKind'),
      hideLabel: true,
      options: KINDS.map((value) => ({ value, label: later(language, `picture-${value}`) })),
      value: chosen.kind,
      action: (kind) => choose({ kind }),
    })}
    <div class="picture-preview ${isPostcard ? 'is-postcard' : ''} ${chosen.kind === 'cutout' ? 'is-bare' : ''}" aria-busy=${!preview && !error}>
      ${url ? html`<img src=${url} alt=${later(language, `picture-${chosen.kind}`)} />` : nothing}
    </div>
    ${
      isPostcard
        ? nothing
        : menu({
            name: 'picture-size',
            label: later(language, 'pictureSize'),
            options: SIZES.map((value) => ({ value, label: later(language, `size-${value}`) })),
            value: chosen.size,
            action: (size) => choose({ size }),
          })
    }
    ${
      canBeSampled
        ? menu({
            name: 'picture-samples',
            label: later(language, 'pictureSamples'),
            options: SAMPLES.map((value) => ({ value, label: later(language, `samples-${value}`) })),
            value: chosen.samples,
            action: (samples) => choose({ samples }),
          })
        : nothing
    }
    ${
      canBeSampled && chosen.samples !== 'none'
        ? menu({
            name: 'picture-aperture',
            label: later(language, 'pictureAperture'),
            options: APERTURES.map((value) => ({ value, label: later(language, `aperture-${value}`) })),
            value: chosen.aperture,
            action: (aperture) => choose({ aperture }),
          })
        : nothing
    }
    <p class="quiet">${later(language, isPostcard ? 'postcardNote' : 'pictureNote')}</p>
    <div role="status">
      ${progress === null ? nothing : html`<progress max="1" .value=${progress} aria-label=${later(language, 'exportWriting')}></progress>`}
      ${error ? html`<p class="control-problem">${errorText(language, error)}</p>` : nothing}
    </div>
    <div class="button-row">
      ${canShare && file ? html`<button class="button" type="button" @click=${() => share(file)}>${icon('share')}${later(language, 'shareFile')}</button>` : nothing}
      <button class="button button-primary" type="button" ?disabled=${!preview || progress !== null} @click=${save}>${icon('save')}${later(language, 'save')}</button>
    </div>
  `;
}
