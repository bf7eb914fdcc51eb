/** How the command line ends, and what is thrown to end it. */

import type { ErrorInfo } from '../base/errors.ts';

/** Exit codes. The documentation's table is made of this one. */
export const EXITS = {
  done: { code: 0, means: 'everything was made' },
  failed: { code: 1, means: 'something could not be made, or a check failed; the other files are there, and each is whole' },
  usage: { code: 2, means: 'the command line is wrong; nothing was made' },
  storage: { code: 3, means: 'files cannot be written: no space, no permission; those that are there are whole' },
  hangup: { code: 129, means: 'the terminal was closed (SIGHUP)' },
  interrupted: { code: 130, means: 'stopped by Ctrl-C (SIGINT)' },
  pipe: { code: 141, means: 'whatever read the output has gone (a closed pipe)' },
  terminated: { code: 143, means: 'stopped by SIGTERM' },
} as const;

export type Exit = keyof typeof EXITS;

/** The run ends here, with a message for people and an exit code. */
export class Ending extends Error {
  readonly exit: Exit;

  constructor(exit: Exit, message: string, options?: ErrorOptions) {
    super(message, options);
    this.exit = exit;
  }
}

/** What was typed cannot be done; nothing has been made yet. */
export function misuse(message: string): Ending {
  return new Ending('usage', message);
}

/** What failed in one item, as it crosses from a worker. */
export interface Failure extends Omit<ErrorInfo, 'name'> {
  /** A name of the closed list, or the system's code: `ENOSPC`. */
  name: string;
  /** Of the file system: every other item would fail in the same way. */
  isStorage: boolean;
}

/** The codes of the system that say that files cannot be written here, and what they mean. */
const STORAGE: Readonly<Record<string, string>> = {
  ENOSPC: 'there is no space left on the device',
  EDQUOT: 'the quota of the disk is used up',
  EACCES: 'permission denied',
  EPERM: 'the system does not permit it',
  EROFS: 'the file system is read-only',
  EISDIR: 'there is a folder of this name',
  ENOTDIR: 'a part of the path is a file, not a folder',
  ENAMETOOLONG: 'the name is too long',
  EMFILE: 'too many files are open',
  EIO: 'the device failed',
  ENOENT: 'there is no such file or folder',
};

/** What was written to the standard output is lost. */
export function outputLost(error: NodeJS.ErrnoException): Ending {
  if (error.code === 'EPIPE') return new Ending('pipe', 'whatever read the output has gone');
  return new Ending('storage', `the output cannot be written: ${failureOf(error).message}`);
}

/** A file that was named cannot be read. */
export function unreadable(file: string, cause: unknown): Ending {
  return new Ending('usage', `${file} cannot be read: ${failureOf(cause).message.replace(`${file}: `, '')}`, { cause });
}

/** What was thrown, as data. */
export function failureOf(thrown: unknown): Failure {
  if (!(thrown instanceof Error)) return { name: 'Internal', message: String(thrown), isStorage: false };
  const { code, path } = thrown as NodeJS.ErrnoException;
  if (code !== undefined && /^E[A-Z]+$/.test(code)) {
    const reason = STORAGE[code] ?? thrown.message;
    return { name: code, message: path === undefined ? reason : `${path}: ${reason}`, isStorage: true };
  }
  // Whatever comes from the exporter has these, also where it has crossed a boundary.
  const { name, message, key, layer, value, min, max } = thrown as Error & Partial<ErrorInfo>;
  return { name, message, key, layer, value, min, max, isStorage: false };
}
