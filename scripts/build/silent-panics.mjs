// Takes out of a wasm file what panics would say: wasm has no stderr, and `panic = "abort"` ends in the same trap without it.
import { readFileSync, writeFileSync } from 'node:fs';
import { Failure } from '../lib/run.mjs';
import { WasmReader } from './wasm-reader.mjs';

const DATA_SECTION = 11;

/** What the standard library calls to panic, and never returns from. */
const PANICS =
  /^(core|alloc|std|__rustc)\[\w+\]::(\w+::)*(panic\w*|\w+_fail(ed)?|handle_(alloc_)?error|capacity_overflow|rust_(panic|begin_unwind))$/;

/** The name of a source file, which a `core::panic::Location` points at. */
const SOURCE_FILE = /^[\w/.@-]+\.rs$/;
const LONGEST_NAME = 300;

/**
 * Panics trap at once instead of first writing a message that no one reads, and where they are in the sources becomes zeros, which compress
 * to nothing. (Stable Rust cannot say so yet: `panic = "immediate-abort"`, `-Z location-detail=none`.) Run it before wasm-opt, which drops
 * the functions' names and cuts the data into pieces.
 */
export async function silencePanics(file) {
  const { default: binaryen } = await import('binaryen');
  const module = binaryen.readBinary(readFileSync(file));
  let functions = 0;
  for (let k = 0; k < module.getNumFunctions(); k++) {
    const panics = module.getFunctionByIndex(k);
    const { name, base } = binaryen.getFunctionInfo(panics);
    if (base || !PANICS.test(name)) continue;
    binaryen.Function.setBody(panics, module.unreachable());
    functions++;
  }
  const wasm = module.emitBinary();
  module.dispose();
  const locations = blankLocations(wasm);
  if (functions < 5 || locations < 20)
    throw new Failure(
      `only ${functions} panicking functions and ${locations} places in sources look as scripts/build/silent-panics.mjs knows them`,
    );
  writeFileSync(file, wasm);
}

/**
 * Overwrites every `Location { file: &str, line: u32, col: u32 }` and the file names with zeros; returns how many there were. Four words are
 * taken for one only where the first two are address and length of a file name and the others could be a line and a column.
 */
function blankLocations(wasm) {
  const segments = dataSegments(wasm);
  const view = new DataView(wasm.buffer, wasm.byteOffset, wasm.length);
  const text = new TextDecoder();
  const names = new Map();
  let locations = 0;
  for (const { address, begin, length } of segments) {
    for (let k = (4 - (address % 4)) % 4; k + 16 <= length; k += 4) {
      const [at, size, line, column] = [0, 4, 8, 12].map((offset) => view.getUint32(begin + k + offset, true));
      if (size > LONGEST_NAME || line < 1 || line > 100_000 || column < 1 || column > 1000) continue;
      const holder = segments.find((segment) => at >= segment.address && at + size <= segment.address + segment.length);
      if (!holder) continue;
      const name = holder.begin + at - holder.address;
      if (!names.has(name) && !SOURCE_FILE.test(text.decode(wasm.subarray(name, name + size)))) continue;
      names.set(name, size);
      wasm.fill(0, begin + k, begin + k + 16);
      locations++;
    }
  }
  for (const [name, size] of names) wasm.fill(0, name, name + size);
  return locations;
}

/** The active data segments: where each lies in memory, and where its bytes begin in the file. */
function dataSegments(wasm) {
  const segments = [];
  const reader = new WasmReader(wasm);
  for (const { id } of reader.sections()) {
    if (id !== DATA_SECTION) continue;
    for (let left = reader.number(); left > 0; left--) {
      // Flags 0: memory 0, at `i32.const address; end`. Others are passive, or in other memories: Rust makes none.
      if (reader.number() !== 0) throw new Failure('a data segment is not at a fixed place in memory');
      reader.byte();
      const address = reader.number();
      reader.byte();
      const length = reader.number();
      segments.push({ address, begin: reader.at, length });
      reader.at += length;
    }
  }
  return segments;
}
