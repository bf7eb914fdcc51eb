/** What a page does when a file of its build cannot be had: it says so, in words that are true, and offers to reload. */

import { RockFieldError } from '../base/errors.ts';
import { later } from '../controls/strings-later.ts';
import type { Store } from '../controls/store.ts';
import type { onMissingFile } from '../base/lazy.ts';
import type { Words } from '../base/language.ts';
import type { Kind } from '../table/table.ts';

const WORDS = {
  newer: {
    en: 'There is a newer version of this page. Reload to go on from here.',
    ja: 'このページには新しいバージョンがあります。再読み込みすると、今の状態から続けられます。',
  },
  missing: {
    en: 'A part of this page could not be fetched. Check the connection, then reload.',
    ja: 'ページの一部を読み込めませんでした。接続を確認して、再読み込みしてください。',
  },
  log: { en: 'The log from a file must be chosen again.', ja: 'ファイルから読み込んだ丸太は、もう一度選び直す必要があります。' },
  undo: { en: 'What you could undo is not kept.', ja: '取り消しの履歴は残りません。' },
  reload: { en: 'Reload', ja: '再読み込み' },
} as const satisfies Record<string, Words>;

const BUILD = 'meta[name=rock-field-build]';

/** The build that this page was made by. */
export function ownBuild(): string {
  return document.querySelector<HTMLMetaElement>(BUILD)?.content ?? '';
}

/** The build that a visitor would get now; undefined when the server cannot be reached. */
async function newestBuild(): Promise<string | undefined> {
  try {
    const response = await fetch(location.pathname, { cache: 'no-cache' });
    const page = new DOMParser().parseFromString(await response.text(), 'text/html');
    return response.ok ? (page.querySelector<HTMLMetaElement>(BUILD)?.content ?? '') : undefined;
  } catch {
    return undefined;
  }
}

/** `listen` is how to hear of files that are missing. `save` is called before the page is reloaded; `hasUnsavedLog` says whether a log from a file will be lost all the same. */
export function offerNewerVersion<K extends Kind>(
  listen: typeof onMissingFile,
  store: Store<K>,
  save: () => void,
  hasUnsavedLog: () => boolean,
): void {
  let isAsking = false;

  async function offer(isSaid: boolean): Promise<void> {
    if (isAsking || store.remedy) return;
    isAsking = true;
    const newest = await newestBuild();
    isAsking = false;
    const isNewer = newest !== undefined && newest !== ownBuild();
    // The element says what is missing, and trying again helps.
    if (isSaid && !isNewer) return;
    const words = isNewer ? WORDS.newer : WORDS.missing;
    store.setRemedy({
      text: (language) =>
        [words, ...(hasUnsavedLog() ? [WORDS.log] : []), ...(store.canUndo ? [WORDS.undo] : [])].map((part) => part[language]).join(' '),
      label: (language) => WORDS.reload[language],
      act: () => void reload(),
    });
  }

  async function reload(): Promise<void> {
    // Without a network the page as it is is better than none.
    if ((await newestBuild()) === undefined) return;
    save();
    location.reload();
  }

  listen((isSaid) => void offer(isSaid));
}

/** What nobody caught is said, not swallowed. */
export function sayUncaught<K extends Kind>(store: Store<K>): void {
  window.addEventListener('unhandledrejection', ({ reason }) => {
    const message = reason instanceof RockFieldError ? reason.message : String(reason);
    if (reason?.name !== 'AbortError' && !store.remedy) store.say((language) => later(language, 'pageFailed', { message }), true);
  });
}
