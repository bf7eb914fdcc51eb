// Shortens the names under which a wasm file imports functions of its glue: wasm-bindgen ends each with a hash of 16 digits, which no compression
// makes smaller, and which is downloaded twice, in the file and in the glue.
import { readFileSync, writeFileSync } from 'node:fs';
import { Failure } from '../lib/run.mjs';

const IMPORT_SECTION = 2;
/** Kinds of imports: the bytes that say what is imported are only copied for functions, and Rust imports nothing else. */
const FUNCTION = 0;

/** Renames the imports of the file `wasm`, and what its glue in the file `glue` calls them. */
export function shortenImports(wasm, glue) {
  const bytes = readFileSync(wasm);
  const names = new Map();
  let script = readFileSync(glue, 'utf8');
  /** A name that the glue has for nothing else. */
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
  let at = 8;
  const leb = () => {
    let value = 0;
    for (let factor = 1; ; factor *= 128) {
      const byte = bytes[at++];
      value += (byte & 127) * factor;
      if (byte < 128) return value;
    }
  };
  const text = () => {
    const length = leb();
    at += length;
    return bytes.toString('utf8', at - length, at);
  };
  while (at < bytes.length) {
    const begin = at;
    const id = bytes[at++];
    const size = leb();
    const end = at + size;
    if (id === IMPORT_SECTION) {
      const count = leb();
      const parts = [lebOf(count)];
      for (let k = 0; k < count; k++) {
        const [module, name, kind] = [text(), text(), bytes[at++]];
        if (kind !== FUNCTION) throw new Failure(`${name} is imported and is no function`);
        parts.push(textOf(module), textOf(shortOf(name)), Buffer.of(kind), lebOf(leb()));
      }
      const section = Buffer.concat(parts);
      return Buffer.concat([bytes.subarray(0, begin), Buffer.of(id), lebOf(section.length), section, bytes.subarray(end)]);
    }
    at = end;
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
