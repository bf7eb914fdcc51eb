/** Text and numbers as bytes, in pieces that are joined at the end: a text of a whole mesh would be twice its file, and may be too long for a string. */

const PIECE = 1 << 20;
/** A number takes no more: sign, ten digits, point, decimals, and what follows it. */
const LONGEST = 32;
const [MINUS, POINT, ZERO] = [45, 46, 48];

export class ByteWriter {
  #full: Uint8Array[] = [];
  #piece = new Uint8Array(PIECE);
  #at = 0;
  #encoder = new TextEncoder();

  text(text: string): void {
    const bytes = this.#encoder.encode(text);
    if (this.#at + bytes.length > PIECE) this.#next();
    // Longer than a piece: one by itself.
    if (bytes.length > PIECE) this.#full.push(bytes);
    else {
      this.#piece.set(bytes, this.#at);
      this.#at += bytes.length;
    }
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
    let rest = millionths | 0;
    if (rest === 0) return;
    let places = 6;
    while (rest % 10 === 0) {
      rest = (rest / 10) | 0;
      places -= 1;
    }
    this.#piece[this.#at++] = POINT;
    this.#digits(rest, places);
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

  #room(): void {
    if (this.#at + LONGEST > PIECE) this.#next();
  }

  #next(): void {
    this.#full.push(this.#piece.subarray(0, this.#at));
    this.#piece = new Uint8Array(PIECE);
    this.#at = 0;
  }

  /** Everything that was written. */
  bytes(): Uint8Array<ArrayBuffer> {
    this.#next();
    const all = new Uint8Array(this.#full.reduce((sum, piece) => sum + piece.length, 0));
    let at = 0;
    for (const piece of this.#full) {
      all.set(piece, at);
      at += piece.length;
    }
    return all;
  }
}
