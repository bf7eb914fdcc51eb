/**
 * OBJ: vertices and faces; every other statement is skipped.
 *
 * Written here since the loaders that exist take what they cannot read for something else (`12,5` for 12, lines for faces) and tell no
 * line numbers. Numbers are strict: a log that is silently another is worse than none.
 */

import { GrowingFloats, GrowingIndices } from './growing.ts';
import { MOST_LISTED, MOST_TRIANGLES } from './limits.ts';
import type { Words } from '../../base/language.ts';
import type { Soup } from './mesh.ts';
import { shown } from '../../base/file-name.ts';
import { refused } from './refusal.ts';
import { triangulated } from './triangulate.ts';

/** How often the progress is told, as a share of the text. */
const REPORTS = 64;

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/;
/** A corner of a face: `7`, `7/1`, `7//3`, `7/1/3`; negative numbers count back from the last vertex. */
const CORNER = /^([+-]?\d+)(\/|$)/;

const [TAB, LINE_FEED, FORM_FEED, RETURN, SPACE, HASH, BACKSLASH] = [9, 10, 12, 13, 32, 35, 92];

/** @throws {RockFieldError} `LogFileUnknown`, `LogFileBroken` with the line, or `LogTooLarge`. */
export function readObj(text: string, name: string, onProgress: (fraction: number) => void = () => {}): Soup {
  return new Reader(text, name, onProgress).read();
}

class Reader {
  readonly #text: string;
  readonly #name: string;
  readonly #onProgress: (fraction: number) => void;
  #at = 0;
  #line = 1;
  readonly #coordinates = new GrowingFloats();
  /** Corners of all faces, one face after the other, and where each face ends. */
  readonly #corners = new GrowingIndices();
  readonly #ends = new GrowingIndices();
  readonly #lines = new GrowingIndices();
  #triangles = 0;
  /** The farthest vertex that a face names before it is there. */
  #ahead = { vertex: 0, line: 0 };

  constructor(text: string, name: string, onProgress: (fraction: number) => void) {
    this.#text = text;
    this.#name = name;
    this.#onProgress = onProgress;
  }

  read(): Soup {
    const { length } = this.#text;
    let report = 0;
    while (this.#at < length) {
      if (this.#at >= report) {
        this.#onProgress(this.#at / length);
        report += length / REPORTS;
      }
      const statement = this.#token();
      if (statement === 'v') this.#vertex();
      // `fo` is what the earliest writers called a face.
      else if (statement === 'f' || statement === 'fo') this.#face();
      this.#endLine();
    }
    const count = this.#coordinates.length / 3;
    if (count === 0) throw this.#unknown();
    if (this.#ahead.vertex > count) throw this.#missing(this.#ahead.vertex, count, this.#ahead.line);
    return this.#soup();
  }

  #vertex(): void {
    for (let axis = 0; axis < 3; axis += 1) {
      const token = this.#token();
      // A word of some text that has nothing to do with vertices.
      if (token === '' && this.#coordinates.length === 0) throw this.#unknown();
      if (token === '')
        throw this.#broken(
          { en: `a vertex has ${axis} coordinates; it needs three`, ja: `頂点の座標が ${axis} 個です。3 個必要です` },
          axis,
        );
      const value = Number(token);
      if (!NUMBER.test(token)) {
        const hint = token.includes(',')
          ? { en: '; decimals are written with a point', ja: '。小数点にはピリオドを使います' }
          : { en: '', ja: '' };
        throw this.#broken(
          { en: `"${shown(token)}" is not a number${hint.en}`, ja: `「${shown(token)}」は数値ではありません${hint.ja}` },
          shown(token),
        );
      }
      if (!Number.isFinite(value))
        throw this.#broken({ en: `"${shown(token)}" is too large a number`, ja: `「${shown(token)}」は大きすぎる数値です` }, shown(token));
      this.#coordinates.push(value);
    }
    if (this.#coordinates.length > 3 * MOST_LISTED) throw this.#tooLarge({ en: 'vertices', ja: '頂点' }, MOST_LISTED + 1, MOST_LISTED);
  }

  #face(): void {
    const start = this.#corners.length;
    for (let token = this.#token(); token !== ''; token = this.#token()) {
      this.#corners.push(this.#corner(token));
      // Before the rest of the face is stored.
      if (this.#triangles + this.#corners.length - start - 2 > MOST_TRIANGLES)
        throw this.#tooLarge({ en: 'triangles', ja: '三角形' }, MOST_TRIANGLES + 1, MOST_TRIANGLES);
    }
    this.#triangles += Math.max(0, this.#corners.length - start - 2);
    this.#ends.push(this.#corners.length);
    this.#lines.push(this.#line);
  }

  /** Index of the vertex, from 0. */
  #corner(token: string): number {
    const [, digits] = CORNER.exec(token) ?? [];
    const count = this.#coordinates.length / 3;
    if (digits === undefined)
      throw this.#broken(
        { en: `"${shown(token)}" is not the number of a vertex`, ja: `「${shown(token)}」は頂点の番号ではありません` },
        shown(token),
      );
    const number = Number(digits);
    // Far out of range, the index would not fit its list.
    if (number === 0 || -number > count || number > MOST_LISTED) throw this.#missing(number, count, this.#line);
    if (number > this.#ahead.vertex && number > count) this.#ahead = { vertex: number, line: this.#line };
    return number > 0 ? number - 1 : count + number;
  }

  /** The next word of the statement; empty at its end. */
  #token(): string {
    const text = this.#text;
    while (this.#at < text.length) {
      const code = text.charCodeAt(this.#at);
      if (isBlank(code)) this.#at += 1;
      else if (code !== BACKSLASH || !this.#continued()) break;
    }
    const start = this.#at;
    while (this.#at < text.length) {
      const code = text.charCodeAt(this.#at);
      if (isBlank(code) || code === LINE_FEED || code === RETURN || code === HASH || (code === BACKSLASH && this.#continuation() > 0))
        break;
      this.#at += 1;
    }
    return text.slice(start, this.#at);
  }

  /** Goes to the next line where a backslash ends this one. */
  #continued(): boolean {
    const end = this.#continuation();
    if (end === 0) return false;
    this.#at = end;
    this.#line += 1;
    return true;
  }

  /** Where the next line begins if the backslash here continues this one; else 0. */
  #continuation(): number {
    const text = this.#text;
    let at = this.#at + 1;
    while (isBlank(text.charCodeAt(at))) at += 1;
    const code = text.charCodeAt(at);
    if (code === RETURN) return text.charCodeAt(at + 1) === LINE_FEED ? at + 2 : at + 1;
    return code === LINE_FEED ? at + 1 : 0;
  }

  /** Skips what is left of a statement. A backslash there continues nothing: it may end the path of a file. */
  #endLine(): void {
    const text = this.#text;
    while (this.#at < text.length) {
      const code = text.charCodeAt(this.#at);
      this.#at += 1;
      if (code !== LINE_FEED && code !== RETURN) continue;
      if (code === RETURN && text.charCodeAt(this.#at) === LINE_FEED) this.#at += 1;
      break;
    }
    this.#line += 1;
  }

  #soup(): Soup {
    const positions = this.#coordinates.values;
    const corners = this.#corners.values;
    const indices = new GrowingIndices();
    let start = 0;
    this.#ends.values.forEach((end, face) => {
      const line = this.#lines.values[face] ?? 0;
      const emit = (a: number, b: number, c: number) => {
        indices.push(a);
        indices.push(b);
        indices.push(c);
      };
      triangulated(positions, corners.subarray(start, end), emit, (corner, max) => this.#tooRagged(corner, max, line));
      start = end;
    });
    return { positions, indices: indices.values };
  }

  #unknown(): Error {
    return refused('LogFileUnknown', {
      en: `${this.#name} is neither a GLB nor an OBJ file; save the log as one of those`,
      ja: `${this.#name} は GLB・OBJ ファイルではありません。どちらかの形式で保存してください`,
    });
  }

  #broken(reason: Words, value: unknown, line = this.#line): Error {
    return refused(
      'LogFileBroken',
      { en: `${this.#name}, line ${line}: ${reason.en}`, ja: `${this.#name} の ${line} 行目：${reason.ja}` },
      { value },
    );
  }

  #missing(number: number, count: number, line: number): Error {
    const [en, ja] = [
      `a face names vertex ${number}, and there are ${count} vertices`,
      `面が頂点 ${number} を参照していますが、頂点は ${count} 個です`,
    ];
    return refused(
      'LogFileBroken',
      { en: `${this.#name}, line ${line}: ${en}`, ja: `${this.#name} の ${line} 行目：${ja}` },
      { value: number, min: 1, max: count },
    );
  }

  #tooLarge(what: Words, value: number, max: number): Error {
    return refused(
      'LogTooLarge',
      {
        en: `${this.#name} has more than ${max} ${what.en} (line ${this.#line}); a log may have at most ${max}. Simplify the mesh before saving it`,
        ja: `${this.#name} の${what.ja}は ${max} 個を超えています（${this.#line} 行目）。メッシュを簡略化してください`,
      },
      { value, max },
    );
  }

  #tooRagged(value: number, max: number, line: number): Error {
    return refused(
      'LogFileUnsupported',
      {
        en: `${this.#name}, line ${line}: a face that is not convex has ${value} corners; at most ${max} are read. Triangulate the mesh before saving it`,
        ja: `${this.#name} の ${line} 行目：凸でない面の頂点が ${value} 個あります（上限 ${max} 個）。三角形に分割して保存してください`,
      },
      { value, max },
    );
  }
}

function isBlank(code: number): boolean {
  return code === SPACE || code === TAB || code === FORM_FEED;
}
