/** What has to be exported, and to which files: all that can be refused is refused here, before anything is made. */

import { accessSync, constants, existsSync, statSync } from 'node:fs';
import path from 'node:path';
import { RockFieldError } from '../base/errors.ts';
import { MAPS, OPTIONS, resolveOptions } from '../export/options.ts';
import type { ExportOptions, ResolvedOptions } from '../export/options.ts';
import { colonyOptions } from '../wood-ear/export-options.ts';
import { Ending, misuse } from './failures.ts';
import { EXPORT_KEYS, inOptions, ofCode } from './options.ts';
import type { Arguments } from './parse.ts';
import { filesOf } from './pattern.ts';
import type { Values } from './pattern.ts';
import type { Scene } from './scenes.ts';
import { didYouMean } from './suggest.ts';
import type { Task } from './work.ts';

const FORMATS: readonly string[] = OPTIONS.format.choices;

/**
 * A task for each scene, and for each of the maps.
 *
 * @param maps that are wanted; an empty word stands for what the options say.
 * @throws {Ending} about options that contradict each other, and files that would be lost.
 */
export function exportTasks(args: Arguments, scenes: readonly Scene[], maps: readonly string[], preferred: ExportOptions = {}): Task[] {
  const out = args.get('out') ?? '';
  const wanted = scenes.flatMap((scene) => maps.map((map) => ({ scene, options: optionsOf(args, scene, map, out, preferred) })));
  const values = wanted.map(
    ({ scene: { preset, seed }, options: { given, resolved } }, index): Values => ({
      preset,
      seed,
      index: index + 1,
      map: resolved.map,
      target: given.target ?? 'gltf',
      format: endingOf(resolved),
    }),
  );
  const isOneMap = wanted.some(({ options: { resolved } }) => resolved.format !== 'zip' && isMapFormat(resolved.format));
  const files = placesOf(args, values, isOneMap ? '{preset}-{seed}-{map}.{format}' : '{preset}-{seed}.{format}');
  wanted.forEach(({ options: { resolved } }, index) => checkEnding(files[index]!, resolved));
  refuseUnknownEndings(args, files, preferred.format === undefined ? FORMATS : Object.keys(MAPS));
  return tasksOf(
    args,
    wanted.map(({ scene, options }, index) => ({
      ...{ scene, wanted: { as: 'export', options: options.given }, isWatched: false },
      file: files[index]!,
    })),
  );
}

/** Where each is written: the pattern, or in the folder that it names the file as it is called by itself. */
export function placesOf(args: Arguments, values: readonly Values[], called: string): (string | null)[] {
  const out = args.get('out') ?? called;
  if (out === '-') {
    if (values.length > 1) throw misuse(`--out -: the standard output takes one file, and these are ${values.length}`);
    return [null];
  }
  if (/[\\/]$/.test(out) || isFolder(out)) return filesOf(path.join(out, called), values);
  // A program tells a file by its ending.
  if (path.extname(out) === '')
    throw misuse(`--out ${out}: is that the file ${out}.${values[0]?.format ?? 'glb'}, or, with / at its end, the folder ${out}/?`);
  return filesOf(out, values);
}

/**
 * A file with another ending would be one that no program opens. Where `--format` says what it is, it may be called as somebody wants it, such as
 * `height.raw`.
 */
export function refuseUnknownEndings(args: Arguments, files: readonly (string | null)[], formats: readonly string[]): void {
  if (args.get('format') !== undefined) return;
  for (const file of files) {
    const ending = path.extname(file ?? '');
    if (file === null || formats.includes(ending.slice(1).toLowerCase())) continue;
    const stem = file.slice(0, file.length - ending.length);
    const meant = didYouMean(ending.slice(1), formats, (format) => `${stem}.${format}`);
    throw misuse(
      `--out ${file}: ${ending} is no kind of file that is written here${meant ? `.${meant}` : `: ${formats.join(', ')}.`} With --format it may have any ending.`,
    );
  }
}

/** The tasks whose files are to be made, once nothing is lost by that. */
export function tasksOf(args: Arguments, tasks: readonly Task[]): Task[] {
  const there = new Set(tasks.filter(({ file }) => file !== null && existsSync(file)));
  const other = [...there].find(({ file }) => !statSync(file!).isFile());
  if (other) throw misuse(`${other.file} is no file but a ${isFolder(other.file!) ? 'folder' : 'device'}, and is left alone`);
  if (args.is('force') && args.is('skip-existing')) throw misuse('--force and --skip-existing contradict each other');
  if (there.size > 0 && !args.is('force') && !args.is('skip-existing')) throw misuse(wouldBeLost([...there], tasks.length));
  const left = args.is('skip-existing') ? tasks.filter((task) => !there.has(task)) : [...tasks];
  for (const folder of new Set(left.flatMap(({ file }) => (file === null ? [] : [path.dirname(path.resolve(file))])))) checkFolder(folder);
  return left;
}

function wouldBeLost(there: readonly Task[], all: number): string {
  const [{ file }] = there as [Task];
  const others = there.length > 1 ? ` and ${there.length - 1} more of ${all}` : '';
  return `${file}${others} ${there.length > 1 ? 'are' : 'is'} there already. --force makes ${there.length > 1 ? 'them' : 'it'} anew, --skip-existing only what is missing.`;
}

/** What can be seen of a folder before anything is made for it. */
function checkFolder(folder: string): void {
  let above = folder;
  while (!existsSync(above) && path.dirname(above) !== above) above = path.dirname(above);
  if (!isFolder(above)) throw misuse(`${folder} cannot be a folder: ${above} is a file`);
  try {
    accessSync(above, constants.W_OK);
  } catch (cause) {
    throw new Ending('storage', `${above}: nothing may be written there`, { cause });
  }
}

function isFolder(name: string): boolean {
  return statSync(name, { throwIfNoEntry: false })?.isDirectory() ?? false;
}

/** What was asked for by name, and all that follows from it. */
interface Chosen {
  given: ExportOptions;
  resolved: ResolvedOptions;
}

function optionsOf(args: Arguments, { generator }: Scene, map: string, out: string, preferred: ExportOptions): Chosen {
  const given: Record<string, unknown> = { ...preferred, ...givenOptions(args) };
  if (map !== '') given['map'] = map;
  // As in other programs, the ending says what kind of file it is.
  const ending = path.extname(out).slice(1).toLowerCase();
  if (args.get('format') === undefined && FORMATS.includes(ending) && !(ending === 'zip' && Number(given['parts'] ?? 1) > 1))
    given['format'] = ending;
  return { given, resolved: resolvedFor(generator, given) };
}

/** All options, of what a generator makes. */
export function resolvedFor(generator: Scene['generator'], given: ExportOptions): ResolvedOptions {
  try {
    return (generator === 'rocks' ? resolveOptions : colonyOptions)(given);
  } catch (thrown) {
    throw thrown instanceof RockFieldError ? misuse(thrown.name === 'UnknownKey' ? ofCode(thrown) : inOptions(thrown)) : thrown;
  }
}

/** The options of exports that were typed, by their keys. */
export function givenOptions(args: Arguments): ExportOptions {
  const given: Record<string, unknown> = {};
  const target = args.get('target');
  if (target !== undefined) given['target'] = target;
  for (const [name, key] of EXPORT_KEYS) {
    const row = OPTIONS[key];
    const value = row.kind === 'switch' ? args.switched(name) : args.get(name);
    if (value === undefined) continue;
    given[key] = row.kind === 'choice' || row.kind === 'switch' ? value : numberOf(name, String(value));
  }
  return given;
}

function numberOf(name: string, value: string): number {
  const number = value.trim() === '' ? NaN : Number(value);
  if (Number.isNaN(number)) throw misuse(`--${name} ${value}: it must be a number`);
  return number;
}

function isMapFormat(format: string): boolean {
  return ['png', 'r16', 'exr', 'zip'].includes(format);
}

/** Without its point. */
export function endingOf({ parts, format }: ResolvedOptions): string {
  return parts > 1 ? 'zip' : format;
}

/** A file is what its ending says. */
function checkEnding(file: string | null, resolved: ResolvedOptions): void {
  const ending = path
    .extname(file ?? '')
    .slice(1)
    .toLowerCase();
  if (!FORMATS.includes(ending) || ending === endingOf(resolved)) return;
  throw misuse(
    resolved.parts > 1
      ? `--out ${file}: ${resolved.parts} parts are in a ZIP; let the name end in .zip`
      : `--out ${file}: the file is one of format ${resolved.format}; let the name end in .${resolved.format}, or leave --format out`,
  );
}
