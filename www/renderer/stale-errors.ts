/** Errors of a renderer's wasm that trapped and was replaced. */

/** To be called after a new instance has taken the place of a renderer's wasm that trapped: errors that callbacks of the old one still throw are not reported. */
export function ignoreStale(): void {
  for (const type of ['error', 'unhandledrejection']) addEventListener(type, ignoreIfStale, true);
}

function ignoreIfStale(event: Event): void {
  const { error, reason } = event as Event & { error?: unknown; reason?: unknown };
  if (!/previous WASM instance/i.test(String(error ?? reason))) return;
  event.preventDefault();
  event.stopImmediatePropagation();
}
