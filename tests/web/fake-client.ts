// A client of the generator whose workers say what a test writes.
import assert from 'node:assert/strict';
import type { TestContext } from 'node:test';
import { RockFieldError } from '../../www/base/errors.ts';
import type { Field } from '../../www/data/field.ts';
import { GeneratorClient } from '../../www/rocks/client.ts';
import type { FieldJob } from '../../www/rocks/client.ts';
import type { ClientOptions } from '../../www/generator/worker-client.ts';
import type { FailedMessage, FromLoop, FromWorker, PongMessage, ReadyMessage, StartedMessage } from '../../www/generator/protocol.ts';
import { defaultParams } from '../../www/rocks/request.ts';
import { SilentWorker } from './fake-worker.ts';
import type { Start } from './fake-worker.ts';

/** The first of its pool, and here the only one. */
export const CLIENT = 1;

export class FakeWorker extends SilentWorker {
  says(message: FromLoop | StartedMessage | ReadyMessage | FailedMessage | PongMessage): void {
    this.tells({ client: CLIENT, ...message } as FromWorker);
  }

  finishes(id: number): void {
    this.says({ type: 'result', id, result: fieldOf(id) });
  }

  get starts(): Start[] {
    return this.heard.filter((message) => message.type === 'start');
  }

  get lastStart(): Start {
    return this.starts.at(-1) ?? assert.fail('nothing was started');
  }
}

function fieldOf(id: number): Field {
  return { stats: { rocks: id } } as Field;
}

/** A client, the workers it made, and what it gave out for display. */
export function setUp(options: ClientOptions<FieldJob, Field> = {}) {
  const workers: FakeWorker[] = [];
  const shown: [number, boolean][] = [];
  const client = new GeneratorClient({
    spawn: () => {
      workers.push(new FakeWorker());
      return workers.at(-1)!;
    },
    onResult: (field, { superseded }) => shown.push([field.stats.rocks, superseded]),
    ...options,
  });
  const worker = () => workers.at(-1) ?? assert.fail('no worker');
  return { client, workers, shown, worker };
}

export function params(seed: number) {
  return { ...defaultParams(), seed };
}

export function isAbort(error: unknown): boolean {
  return error instanceof DOMException && error.name === 'AbortError';
}

export function isNamed(name: string): (error: unknown) => boolean {
  return (error) => error instanceof RockFieldError && error.name === name;
}

export function mockTimers(t: TestContext) {
  t.mock.timers.enable({ apis: ['setTimeout'] });
  return t.mock.timers;
}

/** For the microtasks of promises that have been settled. */
export const settle = () => new Promise((resolve) => setImmediate(resolve));
