/** Hands a file to the browser, which saves it as it saves downloads. */

/** The browser has taken the file by then, ms. */
const TAKEN_MS = 60_000;

export function saveFile(file: File): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(file);
  link.download = file.name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), TAKEN_MS);
}
