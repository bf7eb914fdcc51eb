/** What the page asks the worker for that reads log files. Its answer is a `LogFile`. */

export interface FileTask {
  file: Blob;
  name: string;
}
