/** The items of a batch, of a list in a file or of what a command line asks for. */

import { createHash } from 'node:crypto';
import { createReadStream } from 'node:fs';
import { RockFieldError } from '../../base/errors.ts';
import type { ExportOptions, ResolvedOptions } from '../../export/options.ts';
import { VERSION } from '../../data/version.ts';
import { Ending, misuse, unreadable } from '../failures.ts';
import { resolvedFor } from '../export-tasks.ts';
import { generatorOfPreset, sceneOfLink } from '../generators.ts';
import { ofCode } from '../options.ts';
import { linkOfRequest } from '../scenes.ts';
import type { Scene } from '../scenes.ts';
import { MOST_ITEMS } from './folder.ts';
import { isIn } from './shards.ts';
import type { Shard } from './shards.ts';

export interface Item {
  index: number;
  scene: Scene;
  /** As they were asked for. */
  given: ExportOptions;
  /** All of them, with their values. */
  options: ResolvedOptions;
}

/** What was read: those items that the shard makes, and what there is to say of all of them. */
export interface List {
  /** In the whole list. */
  count: number;
  /** SHA-256 of all items: two lists with the same items are the same list. */
  hash: string;
  /** Of the shard. */
  items: Item[];
}

/** Characters of a line: more than the longest link, or parameters, have. */
const MOST_LINE = 1 << 18;
/** Lines that a message tells of. */
const MOST_TOLD = 10;

/**
 * Reads a list. All of its lines are checked in every shard: a slip in one is told before anything is made, not the next morning.
 *
 * @param file a path; `-` is the standard input.
 * @param options what every item has, where its line does not say otherwise.
 * @throws {Ending} naming the lines that are wrong.
 */
export async function readList(file: string, options: ExportOptions, shard: Shard): Promise<List> {
  const collector = new Collector(shard);
  const wrong: string[] = [];
  let number = 0;
  for await (const line of linesOf(file)) {
    number += 1;
    const text = line.trim();
    if (text === '' || text.startsWith('#')) continue;
    try {
      const { scene, own } = sceneOfLine(text);
      collector.add(scene, { ...options, ...own }, Object.keys(own).length > 0);
    } catch (thrown) {
      if (!(thrown instanceof Ending) || thrown.exit !== 'usage') throw thrown;
      wrong.push(`${calledOf(file)}, line ${number}: ${thrown.message}`);
    }
  }
  if (wrong.length > 0) {
    const others = wrong.length - MOST_TOLD;
    throw misuse([...wrong.slice(0, MOST_TOLD), ...(others > 0 ? [`… and ${others} more`] : [])].join('\n'));
  }
  const list = collector.list();
  if (list.count === 0) throw misuse(`${calledOf(file)} has no lines with a scene`);
  return list;
}

/** The list of scenes that all have the same options. */
export function listOf(scenes: readonly Scene[], options: ExportOptions, shard: Shard): List {
  const collector = new Collector(shard);
  for (const scene of scenes) collector.add(scene, options, false);
  return collector.list();
}

/** SHA-256 of everything that the file of an item depends on: its scene, all options with their values, and the version that makes it. */
export function keyOf({ scene: { generator, link }, options }: Pick<Item, 'scene' | 'options'>): string {
  return createHash('sha256')
    .update(JSON.stringify([VERSION, generator, link, options]))
    .digest('hex');
}

class Collector {
  readonly #shard: Shard;
  readonly #items: Item[] = [];
  readonly #hash = createHash('sha256');
  #count = 0;

  constructor(shard: Shard) {
    this.#shard = shard;
  }

  /** @param isOwn whether some of the options are of this item alone; those of all are told by the batch. */
  add(scene: Scene, given: ExportOptions, isOwn: boolean): void {
    const options = resolvedFor(scene.generator, given);
    if (this.#count === MOST_ITEMS) throw misuse(`the list has more than ${MOST_ITEMS} scenes: make several batches of it`);
    this.#hash.update(`${JSON.stringify([scene.generator, scene.link, isOwn ? options : null])}\n`);
    if (isIn(this.#shard, this.#count)) this.#items.push({ index: this.#count, scene, given, options });
    this.#count += 1;
  }

  list(): List {
    return { count: this.#count, hash: this.#hash.copy().digest('hex'), items: this.#items };
  }
}

/** A link, or an object with the parameters of a scene; its `export` has options of this item alone. */
function sceneOfLine(text: string): { scene: Scene; own: ExportOptions } {
  if (!text.startsWith('{')) return { scene: linked(text), own: {} };
  let json: Record<string, unknown>;
  try {
    json = JSON.parse(text) as Record<string, unknown>;
  } catch (thrown) {
    throw misuse(`this begins like JSON, but is none (${(thrown as Error).message})`);
  }
  const { export: own = {}, link, ...request } = json;
  if (typeof own !== 'object' || own === null || Array.isArray(own)) throw misuse('export must be an object with options of exports');
  if (link === undefined) return { scene: requested(request), own };
  const [other] = Object.keys(request);
  if (other !== undefined) throw misuse(`a line has a link or parameters, and this one has a link and ${JSON.stringify(other)}`);
  if (typeof link !== 'string') throw misuse('link must be a text');
  return { scene: linked(link), own };
}

/** On a page a slip in a link is told and passed over; nobody reads what is told of a hundred thousand. */
function linked(text: string): Scene {
  const { generator, params, preset, notices } = sceneOfLink(text);
  const [notice] = notices;
  if (notice) throw misuse(notice.text);
  return { generator: generator.name, link: generator.encode(params, preset), preset, seed: params.seed };
}

function requested(request: Record<string, unknown>): Scene {
  if (typeof request['preset'] === 'string') generatorOfPreset(request['preset']);
  try {
    return linked(linkOfRequest(request));
  } catch (thrown) {
    throw thrown instanceof RockFieldError ? misuse(ofCode(thrown)) : thrown;
  }
}

/** As a list is called in messages. */
function calledOf(file: string): string {
  return file === '-' ? 'the standard input' : file;
}

/** The lines of a file, one by one, without their ends. */
async function* linesOf(file: string): AsyncGenerator<string> {
  const called = calledOf(file);
  const stream = file === '-' ? process.stdin : createReadStream(file);
  stream.setEncoding('utf8');
  let rest = '';
  try {
    for await (const piece of stream) {
      // As Windows PowerShell writes what is led to a file.
      if (String(piece).includes('\0')) throw misuse(`${called} is no text in UTF-8: save it as that`);
      const lines = (rest + String(piece)).split('\n');
      rest = lines.pop() ?? '';
      if (rest.length > MOST_LINE) throw misuse(`${called} has a line of more than ${MOST_LINE} characters: it is no list`);
      yield* lines;
    }
  } catch (cause) {
    if (cause instanceof Ending) throw cause;
    throw unreadable(called, cause);
  }
  yield rest;
}
