/** Text and numbers as bytes, in pieces that are joined at the end: a text of a whole mesh would be twice its file, and may be too long for a string. */

import { decimalsFor, POWERS } from './significant.ts';

/** Pieces grow with what is written, within these bounds; bytes. */
const [LEAST_PIECE, MOST_PIECE] = [1 << 14, 1 << 20];
/** A number takes no more: sign, ten digits, point, decimals, and what follows it. */
const LONGEST = 32;
/** Texts up to this length are written letter by letter, which takes less time than a call of the encoder. */
const SHORT = 256;
const ASCII = 127;
/** Texts that JSON has as they are. */
const PLAIN = /^[\w -]*$/;
const [MINUS, POINT, ZERO, QUOTE, E] = [45, 46, 48, 34, 101];
export class ByteWriter {
  #full: Uint8Array[] = [];
  #fullLength = 0;
  #piece = new Uint8Array(0);
  #at = 0;
  #encoder = new TextEncoder();

  /** How many bytes have been written. */
  get length(): number {
    return this.#fullLength + this.#at;
  }

  text(text: string): void {
    const length = text.length;
    if (length > SHORT) {
      this.#encoded(text);
      return;
    }
    this.#room(length);
    const piece = this.#piece;
    const begin = this.#at;
    for (let k = 0; k < length; k++) {
      const code = text.charCodeAt(k);
      if (code > ASCII) {
        this.#encoded(text);
        return;
      }
      piece[begin + k] = code;
    }
    this.#at = begin + length;
  }

  /** A text as JSON has it. */
  quoted(text: string): void {
    if (PLAIN.test(text)) {
      this.codes(QUOTE);
      this.text(text);
      this.codes(QUOTE);
    } else this.text(JSON.stringify(text));
  }

  #encoded(text: string): void {
    const bytes = this.#encoder.encode(text);
    this.#room(bytes.length);
    this.#piece.set(bytes, this.#at);
    this.#at += bytes.length;
  }

  /** Up to a few dozen characters of ASCII, each as its code. */
  codes(...codes: readonly number[]): void {
    this.#room();
    for (const code of codes) this.#piece[this.#at++] = code;
  }

  /** A whole number from 0 on, below 2³¹. */
  whole(value: number): void {
    this.#room();
    this.#digits(value | 0, 1);
  }

  /** A number with at most six decimals, none of them a needless 0. */
  decimal(value: number): void {
    const millionths = Math.round(Math.abs(value) * 1e6);
    const whole = Math.floor(millionths / 1e6);
    // Longer than an integer of 32 bits, or no number at all.
    if (whole < 2 ** 31) this.#short(value < 0, whole, millionths - whole * 1e6);
    else this.text(String(value));
  }

  #short(isNegative: boolean, whole: number, millionths: number): void {
    this.#room();
    if (isNegative && whole + millionths > 0) this.#piece[this.#at++] = MINUS;
    this.#digits(whole | 0, 1);
    this.#fraction(millionths, 6);
  }

  /** A point and the digits after it, if there are any but zeros; `value` is that many digits as an integer of 32 bits. */
  #fraction(value: number, digits: number): void {
    let [rest, places] = [value | 0, digits];
    if (rest === 0) return;
    while (rest % 10 === 0) {
      rest = (rest / 10) | 0;
      places -= 1;
    }
    this.#piece[this.#at++] = POINT;
    this.#digits(rest, places);
  }

  /** What JSON has of a number that is rounded to so many significant digits, which are at most nine. */
  significant(value: number, digits: number): void {
    const size = Math.abs(value);
    let decimals = decimalsFor(size, digits);
    if (decimals < 0) {
      this.text(String(Number(value.toPrecision(digits))));
      return;
    }
    let number = Math.floor(size * POWERS[decimals]! + 0.5);
    if (number === POWERS[digits] && decimals > 0) {
      number = POWERS[digits - 1]!;
      decimals -= 1;
    }
    this.#room();
    if (value < 0) this.#piece[this.#at++] = MINUS;
    const exponent = digits - 1 - decimals;
    if (exponent >= -6) this.#withPoint(number, decimals);
    else {
      // JSON has smaller numbers with an exponent.
      this.#withPoint(number, digits - 1);
      this.#piece[this.#at++] = E;
      this.#piece[this.#at++] = MINUS;
      this.#digits(-exponent, 1);
    }
  }

  /** An integer below 10⁹ divided by a power of ten, without needless zeros at its end. */
  #withPoint(value: number, decimals: number): void {
    const unit = POWERS[decimals]!;
    const whole = Math.floor(value / unit);
    this.#digits(whole, 1);
    this.#fraction(value - whole * unit, decimals);
  }

  /** `value` is an integer of 32 bits; zeros in front make at least `least` digits of it. */
  #digits(value: number, least: number): void {
    let count = 1;
    for (let limit = 10; count < 10 && value >= limit; limit *= 10) count += 1;
    if (count < least) count = least;
    const piece = this.#piece;
    for (let at = this.#at + count - 1, rest = value; at >= this.#at; at--) {
      const shorter = (rest / 10) | 0;
      piece[at] = ZERO + rest - 10 * shorter;
      rest = shorter;
    }
    this.#at += count;
  }

  /** Makes room for so many bytes in a row. */
  #room(bytes = LONGEST): void {
    if (this.#at + bytes <= this.#piece.length) return;
    this.#flush();
    this.#piece = new Uint8Array(Math.max(bytes, Math.min(MOST_PIECE, Math.max(LEAST_PIECE, this.#fullLength))));
  }

  #flush(): void {
    if (this.#at > 0) this.#full.push(this.#piece.subarray(0, this.#at));
    this.#fullLength += this.#at;
    this.#piece = new Uint8Array(0);
    this.#at = 0;
  }

  /** Moves everything that was written to where `to` has it from `at` on; the writer is empty then. Returns where it ends. */
  moveTo(to: Uint8Array, at: number): number {
    this.#flush();
    let end = at;
    for (const piece of this.#full) {
      to.set(piece, end);
      end += piece.length;
    }
    this.#full = [];
    this.#fullLength = 0;
    return end;
  }

  /** Everything that was written; the writer is empty then. */
  bytes(): Uint8Array<ArrayBuffer> {
    const all = new Uint8Array(this.length);
    this.moveTo(all, 0);
    return all;
  }
}

/** The pieces one after the other. */
export function joined(pieces: readonly Uint8Array[]): Uint8Array<ArrayBuffer> {
  const all = new Uint8Array(pieces.reduce((sum, piece) => sum + piece.length, 0));
  let at = 0;
  for (const piece of pieces) {
    all.set(piece, at);
    at += piece.length;
  }
  return all;
}
