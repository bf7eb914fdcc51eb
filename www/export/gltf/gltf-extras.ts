/** What a binary glTF file says of itself, out of the beginning of its JSON, or its end: a file of thousands of rocks has megabytes of it. */

import { Refused } from '../origin/refused.ts';

const JSON_CHUNK = 0x4e4f534a;
/** Header of the file and of its first chunk. */
const HEAD = 20;
/** So much of the JSON is looked through, from its beginning and at its end, bytes; and so much of it is parsed, characters. */
const [MOST_JSON, MOST_TAIL, MOST_PARSED] = [1 << 22, 1 << 18, 1 << 16];

/**
 * The extras of the file's `asset` and of its scenes. What optimisers write has them in either place.
 *
 * @throws {Refused} `broken`: it is no glTF 2.0 file.
 */
export async function gltfExtras(glb: Blob): Promise<unknown[]> {
  const head = new DataView(await glb.slice(0, HEAD).arrayBuffer());
  if (head.byteLength < HEAD || head.getUint32(16, true) !== JSON_CHUNK) throw new Refused('broken');
  const length = head.getUint32(12, true);
  if (length > glb.size - HEAD) throw new Refused('broken');
  const read = Math.min(length, MOST_JSON);
  const text = await glb.slice(HEAD, HEAD + read).text();
  const members = topMembers(text, ['asset', 'scenes']);
  if (!members.scenes && read < length) {
    // Some write them last.
    const tail = await glb.slice(HEAD + length - MOST_TAIL, HEAD + length).text();
    const at = tail.lastIndexOf('"scenes"');
    if (at >= 0) Object.assign(members, topMembers(`{${tail.slice(at)}`, ['scenes']));
  }
  if (!members.asset && !members.scenes && read === length) throw new Refused('broken');
  const scenes = members.scenes ? parsed(members.scenes) : [];
  return [members.asset ? parsed(members.asset) : undefined, ...(Array.isArray(scenes) ? scenes : [])].map(
    (one) => (one as { extras?: unknown } | null | undefined)?.extras,
  );
}

function parsed(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch (thrown) {
    throw new Refused('broken', { cause: thrown });
  }
}

/**
 * The texts of an object's members, as far as `text`, which may end anywhere, has them whole and they are not too long. Other members are
 * passed over without a look at what is in them. By hand, since a pattern for strings would take quadratic time over some texts.
 */
function topMembers<Name extends string>(text: string, names: readonly Name[]): Partial<Record<Name, string>> {
  const found: Partial<Record<Name, string>> = {};
  let depth = 0;
  let name: string | undefined;
  let from = 0;
  for (let at = 0; at < text.length; at += 1) {
    const character = text[at];
    if (character === '"') {
      const end = endOfString(text, at);
      if (depth === 1 && name === undefined) {
        name = text.slice(at + 1, end);
        from = text.indexOf(':', end) + 1;
        if (from === 0) break;
      }
      at = end;
    } else if (character === '{' || character === '[') depth += 1;
    else if (character === '}' || character === ']') {
      depth -= 1;
      if (depth === 0) break;
      const known = depth === 1 && at - from < MOST_PARSED && names.find((one) => one === name);
      if (known) found[known] ??= text.slice(from, at + 1);
    } else if (character === ',' && depth === 1) name = undefined;
  }
  return found;
}

/** Where the string that begins at `start` ends, or the text does. */
function endOfString(text: string, start: number): number {
  for (let at = start + 1; at < text.length; at += 1) {
    if (text[at] === '\\') at += 1;
    else if (text[at] === '"') return at;
  }
  return text.length;
}
