/** A postcard of what is shown: the picture, where that is, and a code that opens it on a telephone. As wide and as high as links are previewed. */

import { correction, generate } from 'lean-qr/nano';
import type { Language } from '../base/language.ts';
import { KEYWORD } from '../export/origin/origin.ts';
import { textOf, withText } from '../export/origin/png-text.ts';

export const POSTCARD = { width: 1200, height: 630 } as const;

/** Distance of words and code from the edge, px. */
const MARGIN = 48;
/** Widest code with its quiet zone, and the least size of one of its modules that telephones tell apart. */
const [MOST_CODE, LEAST_MODULE, MOST_MODULE] = [200, 2, 4];
/** Modules around a code that stay white (ISO/IEC 18004). */
const QUIET = 4;

const FONTS: Record<Language, { title: string; rest: string }> = {
  en: {
    title: `600 68px "Iowan Old Style", "Palatino Linotype", Palatino, "URW Palladio L", "Book Antiqua", Georgia, "Times New Roman", serif`,
    rest: `500 25px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif`,
  },
  ja: {
    title: `600 62px "Hiragino Mincho ProN", "Yu Mincho", YuMincho, "Noto Serif CJK JP", "Noto Serif JP", serif`,
    rest: `500 25px "Hiragino Sans", "Yu Gothic", "Noto Sans CJK JP", "Noto Sans JP", system-ui, sans-serif`,
  },
};

export interface PostcardParts {
  /** Of the size of a postcard, a PNG that carries its link. */
  picture: Blob;
  /** Where that is. */
  title: string;
  /** Below it. */
  line: string;
  /** What the code opens; the whole address. */
  address: string;
  language: Language;
}

/** A PNG that carries the same link as the picture. A link too long for a code of this size goes without one. */
export async function postcardOf({ picture, title, line, address, language }: PostcardParts): Promise<Blob> {
  const { width, height } = POSTCARD;
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [width, height];
  const context = canvas.getContext('2d', { alpha: false });
  if (!context) throw new Error('there is no 2D canvas');
  const bitmap = await createImageBitmap(picture);
  context.drawImage(bitmap, 0, 0, width, height);
  bitmap.close();
  const code = codeOf(address);
  const side = code ? sideOf(code) : 0;
  drawWords(context, { title, line, language, width: width - 2 * MARGIN - (code ? side + MARGIN : 0) });
  if (code) drawCode(context, code);
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, 'image/png'));
  if (!blob) throw new Error('the browser made no file of the postcard');
  const text = await textOf(picture, KEYWORD);
  return text === undefined ? blob : withText(blob, KEYWORD, text);
}

type Code = ReturnType<typeof generate>;

/** In the lower right corner, on white. */
function drawCode(context: CanvasRenderingContext2D, code: Code): void {
  const side = sideOf(code);
  const module = side / (code.size + 2 * QUIET);
  const [left, top] = [POSTCARD.width - MARGIN - side, POSTCARD.height - MARGIN - side];
  context.fillStyle = '#fff';
  context.beginPath();
  context.roundRect(left, top, side, side, 6);
  context.fill();
  context.fillStyle = '#14161a';
  for (let y = 0; y < code.size; y += 1)
    for (let x = 0; x < code.size; x += 1)
      if (code.get(x, y)) context.fillRect(left + module * (x + QUIET), top + module * (y + QUIET), module, module);
}

/** With its quiet zone, in whole pixels for each module. */
function sideOf({ size }: Code): number {
  const modules = size + 2 * QUIET;
  return modules * Math.min(MOST_MODULE, Math.floor(MOST_CODE / modules));
}

/** Undefined where it would be too fine to be read. */
function codeOf(address: string): Code | undefined {
  try {
    const code = generate(address, { minCorrectionLevel: correction.L });
    return LEAST_MODULE * (code.size + 2 * QUIET) <= MOST_CODE ? code : undefined;
  } catch {
    // Longer than any code.
    return undefined;
  }
}

interface Caption {
  title: string;
  line: string;
  language: Language;
  /** Of the longest line, px. */
  width: number;
}

function drawWords(context: CanvasRenderingContext2D, { title, line, language, width }: Caption): void {
  const { height } = POSTCARD;
  const { title: titleFont, rest } = FONTS[language];
  // Words are read on any picture: towards the lower edge it darkens, more where they are.
  const shade = context.createLinearGradient(0, height - 300, 0, height);
  for (const [at, opacity] of [
    [0, 0],
    [0.35, 0.12],
    [0.7, 0.42],
    [1, 0.66],
  ] as const)
    shade.addColorStop(at, `rgb(12 13 16 / ${opacity})`);
  context.fillStyle = shade;
  context.fillRect(0, height - 300, POSTCARD.width, 300);
  context.fillStyle = '#fff';
  context.shadowColor = 'rgb(12 13 16 / 0.45)';
  context.shadowBlur = 12;
  context.font = titleFont;
  const share = Math.min(1, width / context.measureText(title).width);
  if (share < 1) context.font = titleFont.replace(/\d+(?=px)/, (size) => String(Math.floor(Number(size) * share)));
  context.fillText(title, MARGIN - 2, height - MARGIN - 44);
  context.font = rest;
  context.globalAlpha = 0.88;
  context.fillText(line, MARGIN, height - MARGIN - 2, width);
  context.globalAlpha = 1;
  context.shadowBlur = 0;
}
