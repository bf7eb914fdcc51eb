/** Lists of numbers whose length is not known beforehand; a tenth of the memory of an array. */

export class GrowingFloats {
  #values = new Float64Array(1024);
  length = 0;

  push(value: number): void {
    if (this.length === this.#values.length) this.#values = grown(this.#values, new Float64Array(2 * this.length));
    this.#values[this.length] = value;
    this.length += 1;
  }

  /** Not a copy. */
  get values(): Float64Array {
    return this.#values.subarray(0, this.length);
  }
}

export class GrowingIndices {
  #values = new Uint32Array(1024);
  length = 0;

  push(value: number): void {
    if (this.length === this.#values.length) this.#values = grown(this.#values, new Uint32Array(2 * this.length));
    this.#values[this.length] = value;
    this.length += 1;
  }

  /** Not a copy. */
  get values(): Uint32Array {
    return this.#values.subarray(0, this.length);
  }
}

function grown<List extends Float64Array | Uint32Array>(from: List, to: List): List {
  to.set(from);
  return to;
}
