/** A worker of the rocks whose every word is written by a test. */
import assert from 'node:assert/strict';
import type { WorkerLike } from '../../www/generator/pool-worker.ts';
import type { Addressed, FlatRequest, FromWorker, StartMessage, ToWorker } from '../../www/generator/protocol.ts';

export type Heard = ToWorker<FlatRequest>;
export type Start = Addressed<StartMessage<FlatRequest>>;

export class SilentWorker implements WorkerLike {
  onmessage: WorkerLike['onmessage'] = null;
  onerror: WorkerLike['onerror'] = null;
  onmessageerror: WorkerLike['onmessageerror'] = null;
  heard: Heard[] = [];
  ended = false;

  postMessage(message: Heard): void {
    assert(!this.ended, 'a message to a worker that has ended');
    this.heard.push(structuredClone(message));
  }

  terminate(): void {
    this.ended = true;
  }

  tells(data: FromWorker): void {
    this.onmessage?.({ data } as MessageEvent<FromWorker>);
  }

  dies(message = ''): void {
    this.onerror?.({ message, preventDefault: () => {} } as ErrorEvent);
  }
}
