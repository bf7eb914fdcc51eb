/** Sentences with gaps. */

export type Slots = Record<string, string | number | undefined>;

/** `text` with its `{…}` filled in. */
export function filled(text: string, slots: Slots): string {
  return text.replace(/\{(\w+)\}/g, (_, name: string) => String(slots[name] ?? ''));
}
