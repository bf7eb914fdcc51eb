/** What a scene says when a gesture does nothing, and when gestures are others; few ever read it, so it is fetched when it is said. */

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
  walk: {
    en: 'W A S D or arrows to walk, Shift to run, drag to look, double-click to go there, Esc to leave',
    ja: 'W A S D か矢印キーで歩く、Shift で走る、ドラッグで見回す、ダブルクリックでその場所へ、Esc で終了',
  },
  walkByTouch: {
    en: 'Drag to look, two fingers to walk, tap twice to go there',
    ja: 'ドラッグで見回す、2本指で歩く、2回タップでその場所へ',
  },
} as const;
