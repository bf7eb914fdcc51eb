// Shortens the names under which a wasm file imports functions of its glue: wasm-bindgen ends each with a hash of 16 digits, which no compression
// makes smaller, and which is downloaded twice, in the file and in the glue.
import { readFileSync, writeFileSync } from 'node:fs';
import { Failure } from '../lib/run.mjs';
import { WasmReader } from './wasm-reader.mjs';

const IMPORT_SECTION = 2;
/** The kind of an import that is a function: Rust imports nothing else. */
const FUNCTION = 0;

/** Renames the imports of the file `wasm`, and what its glue in the file `glue` calls them. */
export function shortenImports(wasm, glue) {
  const bytes = readFileSync(wasm);
  const names = new Map();
  let script = readFileSync(glue, 'utf8');
  /** The glue's own names have no digits after an underscore at their beginning. */
  const shortOf = (name) => {
    if (!names.has(name)) names.set(name, `_${names.size.toString(36)}`);
    return names.get(name);
  };
  writeFileSync(wasm, withImports(bytes, shortOf));
  script = script.replace(/\b__wb\w+/g, (name) => names.get(name) ?? name);
  const lost = [...names].find(([, short]) => !script.includes(`${short}: function`));
  if (lost) throw new Failure(`the glue does not define ${lost[0]} as scripts/build/short-imports.mjs knows it`);
  writeFileSync(glue, script);
}

function withImports(bytes, shortOf) {
  const reader = new WasmReader(bytes);
  for (const { id, begin, end } of reader.sections()) {
    if (id !== IMPORT_SECTION) continue;
    const count = reader.number();
    const parts = [lebOf(count)];
    for (let k = 0; k < count; k++) {
      const [module, name, kind] = [reader.text(), reader.text(), reader.byte()];
      if (kind !== FUNCTION) throw new Failure(`${name} is imported and is no function`);
      parts.push(textOf(module), textOf(shortOf(name)), Buffer.of(kind), lebOf(reader.number()));
    }
    const section = Buffer.concat(parts);
    return Buffer.concat([bytes.subarray(0, begin), Buffer.of(id), lebOf(section.length), section, bytes.subarray(end)]);
  }
  return bytes;
}

function textOf(text) {
  const encoded = Buffer.from(text);
  return Buffer.concat([lebOf(encoded.length), encoded]);
}

function lebOf(value) {
  const bytes = [];
  for (let left = value; ; left = Math.floor(left / 128)) {
    if (left < 128) return Buffer.from([...bytes, left]);
    bytes.push((left % 128) + 128);
  }
}
