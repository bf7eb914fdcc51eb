// Reads the bytes of a wasm file from its first section on.

/** Where the sections begin: after the magic number and the version. */
const HEADER = 8;

/** A place in `bytes`, which moves on with what is read. */
export class WasmReader {
  at = HEADER;

  /** @param {Buffer | Uint8Array} bytes */
  constructor(bytes) {
    this.bytes = bytes;
  }

  byte() {
    return this.bytes[this.at++];
  }

  /** The next number: LEB128, unsigned. */
  number() {
    let value = 0;
    for (let factor = 1; ; factor *= 128) {
      const byte = this.byte();
      value += (byte & 127) * factor;
      if (byte < 128) return value;
    }
  }

  /** The next name. */
  text() {
    const length = this.number();
    this.at += length;
    return new TextDecoder().decode(this.bytes.subarray(this.at - length, this.at));
  }

  /** One section after the other, each with the reader at its content; `begin` is where its header begins, `end` where the next one does. */
  *sections() {
    while (this.at < this.bytes.length) {
      const begin = this.at;
      const id = this.byte();
      const size = this.number();
      const end = this.at + size;
      yield { id, begin, end };
      this.at = end;
    }
  }
}
