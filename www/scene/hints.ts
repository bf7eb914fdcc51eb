/** What a scene says when a gesture does nothing; few ever read it, so it is fetched when it is said. */

/** What zooms with the wheel, as it is called there. */
const MODIFIER = /mac/i.test(globalThis.navigator?.platform ?? '') ? '⌘' : 'Ctrl';

export const HINTS = {
  wheel: {
    en: `${MODIFIER} + scroll to zoom, or click the picture first`,
    ja: `${MODIFIER} を押しながらスクロールするか、先に画像をクリックすると拡大・縮小できます`,
  },
  touch: {
    en: 'Drag sideways, or tap then drag, to turn; two fingers to zoom and move',
    ja: '横にドラッグ、またはタップしてからドラッグで回転、2本指で拡大・移動できます',
  },
} as const;
