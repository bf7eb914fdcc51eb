/**
 * What page and worker say to each other. Every message carries a type; answers carry the id of what they answer.
 *
 * Several clients share a worker: what concerns one of them carries its number, what has none concerns the whole worker. Ids
 * are unique within a client.
 *
 * The worker reads its messages between slices, so it hears within about 25 ms; a run that takes turns with others answers
 * when its turn comes.
 */

import type { ErrorInfo } from '../base/errors.ts';

export type StageName = 'sites' | 'cells' | 'selection' | 'shape' | 'mesh';

/** In the order of the numbers that `Generator.stage()` gives. */
export const STAGES: readonly StageName[] = ['sites', 'cells', 'selection', 'shape', 'mesh'];

export interface Progress<Stage extends string = StageName> {
  stage: Stage;
  /** 0…1 of the whole run. */
  fraction: number;
  /** How much longer the run takes, by how far it came in the time it has had; absent in its first half second, and in every other stage's. */
  secondsLeft?: number;
}

/** A field of rocks to generate, in the form that crosses every boundary. */
export interface FlatRequest {
  /** `encodeParams` of the request. */
  params: Float64Array;
  /** The wasm does not tell these back, and the worker has no parameter table to look them up in `params`. */
  imageWidth: number;
  imageHeight: number;
  /** A request whose estimate is above this is refused. */
  maxBytes: number;
  /** Where something else stands and no rock may grow: six numbers for each triangle, px. */
  footprint?: Float64Array | undefined;
  /** How dense the rocks stand where, row by row from the top, 0 … 255. */
  mask?: { width: number; rows: Uint8Array } | undefined;
  /** Painted strokes, as links have them. */
  strokes?: string | undefined;
}

/**
 * Generate this; a newer `start` supersedes it.
 *
 * Replies: any number of `progress` (only once the run has taken 200 ms), perhaps a `preview`, then exactly one of `result`, `rejected`,
 * `dropped`, `crashed`, `failed`.
 */
export interface StartMessage<Flat = unknown> {
  type: 'start';
  id: number;
  request: Flat;
}

/** Give up run `id`, keeping its finished stages. Replies: `dropped`, or nothing when the run had already been answered. */
export interface CancelMessage {
  type: 'cancel';
  id: number;
}

/** A fresh random seed. Replies: `seed`, `failed` or `crashed`. */
export interface SeedMessage {
  type: 'seed';
  id: number;
}

/** This client is gone: drop its run, free its cache. No reply; nothing of this client follows. */
export interface CloseMessage {
  type: 'close';
}

/** Are you alive, and did you get all my messages? Replies: `pong`. */
export interface PingMessage {
  type: 'ping';
}

/** What one client asks for. */
export type ToLoop<Flat = unknown> = StartMessage<Flat> | CancelMessage | SeedMessage;

export type Addressed<Message> = Message & { client: number };

export type ToWorker<Flat = unknown> = Addressed<ToLoop<Flat> | CloseMessage> | PingMessage;

/** The worker's script has run: from now on it answers pings, also while its wasm is on the way. */
export interface StartedMessage {
  type: 'started';
}

/** The wasm is compiled. */
export interface ReadyMessage {
  type: 'ready';
}

/** The wasm could not be loaded; every request of every client, before and after, is answered by this. Discard the worker. */
export interface FailedMessage {
  type: 'failed';
  error: ErrorInfo;
}

export interface ProgressMessage<Stage extends string = string> {
  type: 'progress';
  id: number;
  progress: Progress<Stage>;
}

/** The run is finished. Its buffers are transferred. */
export interface ResultMessage<Result = unknown> {
  type: 'result';
  id: number;
  result: Result;
}

/** There is something to show, and the run goes on. */
export interface PreviewMessage<Result = unknown> {
  type: 'preview';
  id: number;
  result: Result;
}

/** The request was refused before anything changed. */
export interface RejectedMessage {
  type: 'rejected';
  id: number;
  error: ErrorInfo;
}

/** The run was cancelled or superseded. */
export interface DroppedMessage {
  type: 'dropped';
  id: number;
}

/** The wasm trapped: the state of the worker, whatever it holds of other clients included, is undefined. Discard it. */
export interface CrashedMessage {
  type: 'crashed';
  id: number;
  error: ErrorInfo;
}

export interface SeedReply {
  type: 'seed';
  id: number;
  seed: number;
}

export interface PongMessage {
  type: 'pong';
  /** How many messages of the page have arrived, this ping included. */
  heard: number;
}

/** What one client is told. */
export type FromLoop<Result = unknown, Stage extends string = string> =
  | ProgressMessage<Stage>
  | ResultMessage<Result>
  | PreviewMessage<Result>
  | RejectedMessage
  | DroppedMessage
  | CrashedMessage
  | SeedReply;

export type FromWorker<Result = unknown, Stage extends string = string> =
  | Addressed<FromLoop<Result, Stage>>
  | StartedMessage
  | ReadyMessage
  | FailedMessage
  | PongMessage;
