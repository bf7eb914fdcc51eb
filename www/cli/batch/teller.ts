/** What is said while a shard is made: a line of JSON for each item in a pipe, how far it is on a terminal, and errors always. */

import type { Failure } from '../failures.ts';
import type { Streams } from '../reporter.ts';
import { Notes } from '../notes.ts';
import { inOptions } from '../options.ts';
import type { ItemDone } from './item.ts';
import type { Item } from './list.ts';

/** Milliseconds between two pictures of the progress. */
const REDRAW = 200;
/** Failures that are told in words; of more there are the lines. */
const MOST_TOLD = 20;

export class Teller {
  readonly #streams: Streams;
  readonly #total: number;
  readonly #isJson: boolean;
  readonly #isQuiet: boolean;
  #drawn = -Infinity;
  #isDrawn = false;
  readonly #notes = new Notes();
  readonly counts = { made: 0, skipped: 0, failed: 0 };

  constructor(streams: Streams, { total, isJson, isQuiet }: { total: number; isJson: boolean; isQuiet: boolean }) {
    this.#streams = streams;
    this.#total = total;
    this.#isJson = isJson;
    this.#isQuiet = isQuiet;
  }

  done({ index, scene: { link } }: Item, { status, file, bytes, sha256, notes }: ItemDone): void {
    this.counts[status] += 1;
    this.#notes.add(notes);
    const codes = status === 'made' ? { notes: notes.map(({ code }) => code) } : {};
    if (!this.#isQuiet) this.#json({ index, status, file, bytes, sha256, link, ...codes });
    this.#draw();
  }

  failed({ index, scene: { link } }: Item, { isStorage: _, ...error }: Failure): void {
    this.counts.failed += 1;
    this.#json({ index, status: 'failed', error, link });
    const { failed } = this.counts;
    if (failed <= MOST_TOLD) this.say(`rock-field: item ${index} (${link}): ${inOptions(error)}`);
    else if (failed === MOST_TOLD + 1) this.say('rock-field: others failed too; the lines of JSON name them');
    this.#draw();
  }

  /** A line for people. */
  say(text: string): void {
    this.#erase();
    this.#streams.err.write(`${text}\n`);
  }

  end(): void {
    this.#erase();
    if (!this.#streams.err.isTTY || this.#isQuiet) return;
    for (const line of this.#notes.lines(this.counts.made)) this.say(line);
    this.say(this.#words());
  }

  #json(line: object): void {
    if (!this.#isJson) return;
    this.#erase();
    this.#streams.out.write(`${JSON.stringify(line)}\n`);
  }

  #words(): string {
    const { made, skipped, failed } = this.counts;
    const others = [...(skipped > 0 ? [`${skipped} there already`] : []), ...(failed > 0 ? [`${failed} failed`] : [])];
    return [`${made} made`, ...others, `of ${this.#total}`].join(', ');
  }

  #draw(): void {
    const now = performance.now();
    if (!this.#streams.err.isTTY || this.#isQuiet || now - this.#drawn < REDRAW) return;
    this.#drawn = now;
    this.#erase();
    this.#streams.err.write(this.#words());
    this.#isDrawn = true;
  }

  #erase(): void {
    if (this.#isDrawn) this.#streams.err.write('\r\x1b[2K');
    this.#isDrawn = false;
  }
}
