/** What a scene says when something cannot be had or done; few ever read it, so it is fetched when it is said. */

/** What zooms with the wheel, as it is called there. */
const MODIFIER = /mac/i.test(globalThis.navigator?.platform ?? '') ? '⌘' : 'Ctrl';

export const HINTS = {
  noGpu: {
    en: 'This browser offers neither WebGPU nor WebGL2 here, so the plan is drawn instead of the rocks.',
    ja: 'WebGPU も WebGL2 も使えないため、立体ではなく平面図を表示しています。',
  },
  wheel: {
    en: `${MODIFIER} + scroll to zoom, or click the picture first`,
    ja: `${MODIFIER} を押しながらスクロールするか、先に画像をクリックすると拡大・縮小できます`,
  },
  touch: {
    en: 'Drag sideways, or tap then drag, to turn; two fingers to zoom and move',
    ja: '横にドラッグ、またはタップしてからドラッグで回転、2本指で拡大・移動できます',
  },
} as const;
