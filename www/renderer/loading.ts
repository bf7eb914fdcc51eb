/** What is said while the renderer is on its way. */

import { filled } from '../base/filled.ts';
import type { Language } from '../base/language.ts';

const LOADING = { en: 'Loading the renderer {percent} %', ja: '3D 描画プログラムを読み込み中：{percent} %' } as const;

/** @param arrived share of the renderer that has arrived, 0 … 1. Told in tens: screen readers say every change. */
export function loadingText(language: Language, arrived: number): string {
  return filled(LOADING[language], { percent: 10 * Math.floor(10 * arrived) });
}
