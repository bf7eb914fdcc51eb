/** What is said while files are made: how far it is on a terminal, a line of JSON for each file in a pipe, errors always. */

import type { Failure } from './failures.ts';
import { Notes } from './notes.ts';
import { inOptions } from './options.ts';
import type { Made, Task } from './work.ts';

/** Where words go: standard output and standard error. */
export interface Streams {
  out: NodeJS.WriteStream;
  err: NodeJS.WriteStream;
}

export interface Manner {
  /** How many tasks there are. */
  total: number;
  isJson: boolean;
  isQuiet: boolean;
  /** Whether the standard output is the file itself. */
  isFile: boolean;
}

/** A task with its number, from 1 on. */
export interface Item extends Task {
  item: number;
}

/** So many files are named on a terminal; more are counted. */
const MOST_NAMED = 20;
/** The progress is drawn anew after so many ms. */
const REDRAW = 100;
/** Letters of the bar. */
const BAR = 24;

export class Reporter {
  readonly #streams: Streams;
  readonly #manner: Manner;
  readonly #begin = performance.now();
  readonly #fractions = new Map<number, number>();
  readonly #notes = new Notes();
  #done = 0;
  #failed = 0;
  #bytes = 0;
  #drawn = 0;
  #isDrawn = false;

  constructor(streams: Streams, manner: Manner) {
    this.#streams = streams;
    this.#manner = manner;
  }

  /** Whether anybody sees how far it is. */
  get isWatched(): boolean {
    return Boolean(this.#streams.err.isTTY) && !this.#manner.isQuiet;
  }

  get done(): number {
    return this.#done;
  }

  get failed(): number {
    return this.#failed;
  }

  progress({ item }: Item, fraction: number): void {
    this.#fractions.set(item, fraction);
    this.#draw();
  }

  made({ item, scene: { preset, seed, link }, file }: Item, { data: _, notes, ...facts }: Made): void {
    this.#done += 1;
    this.#bytes += facts.bytes;
    this.#fractions.delete(item);
    this.#notes.add(notes);
    const { total, isJson, isQuiet, isFile } = this.#manner;
    if (isJson && !isFile && !isQuiet) this.#json({ item, preset, seed, link, file, ...facts, notes: notes.map(({ code }) => code) });
    else if (!isFile && !isQuiet && total <= MOST_NAMED) this.#line(this.#streams.out, `${file ?? ''}  ${megabytes(facts.bytes)}`);
    if (!isFile) this.#draw();
  }

  wentWrong({ item, scene: { preset, seed, link }, file }: Item, { isStorage: _, ...error }: Failure): void {
    this.#failed += 1;
    this.#fractions.delete(item);
    const { total, isJson, isFile } = this.#manner;
    if (isJson && !isFile) this.#json({ item, preset, seed, link, file, error });
    const which = total > 1 ? `number ${item} (${preset}, seed ${seed}): ` : '';
    this.say(`rock-field: ${which}${inOptions(error)}`);
    this.#draw();
  }

  /** A line for people, which is no result. */
  say(text: string): void {
    this.#line(this.#streams.err, text);
  }

  /** The last words; where it was stopped, those are somebody else's. */
  end(isStopped = false): void {
    this.#erase();
    const { total, isQuiet, isJson } = this.#manner;
    if (isStopped || isQuiet || isJson || !this.#streams.err.isTTY) return;
    for (const line of this.#notes.lines(total)) this.say(line);
    if (total <= 1) return;
    const seconds = (performance.now() - this.#begin) / 1000;
    this.say(`${this.#done} of ${total} files, ${megabytes(this.#bytes)}, in ${duration(seconds)}`);
  }

  #json(line: object): void {
    this.#line(this.#streams.out, JSON.stringify(line));
  }

  #line(stream: NodeJS.WriteStream, text: string): void {
    this.#erase();
    stream.write(`${text}\n`);
  }

  /** How far all of it is, and how long it may take. */
  #draw(): void {
    const now = performance.now();
    if (!this.isWatched || now - this.#drawn < REDRAW) return;
    this.#drawn = now;
    const { total } = this.#manner;
    const over = this.#done + this.#failed;
    const whole = (over + [...this.#fractions.values()].reduce((sum, fraction) => sum + fraction, 0)) / total;
    const seconds = (now - this.#begin) / 1000;
    // The first moments tell nothing.
    const left = whole > 0.02 && seconds > 1 ? `, ${duration((seconds / whole) * (1 - whole))} left` : '';
    const full = Math.round(BAR * whole);
    const counted = total > 1 ? ` ${over} of ${total}` : '';
    const text = `[${'#'.repeat(full)}${'-'.repeat(BAR - full)}] ${Math.floor(100 * whole)} %${counted}${left}`;
    this.#erase();
    this.#streams.err.write(text.slice(0, (this.#streams.err.columns || 80) - 1));
    this.#isDrawn = true;
  }

  #erase(): void {
    if (this.#isDrawn) this.#streams.err.write('\r\x1b[2K');
    this.#isDrawn = false;
  }
}

function megabytes(bytes: number): string {
  if (bytes < 1e6) return `${Math.max(1, Math.round(bytes / 1e3))} kB`;
  return bytes < 1e9 ? `${(bytes / 1e6).toFixed(1)} MB` : `${(bytes / 1e9).toFixed(2)} GB`;
}

function duration(seconds: number): string {
  if (seconds < 60) return `${Math.max(1, Math.round(seconds))} s`;
  const minutes = Math.round(seconds / 60);
  return minutes < 60 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}
