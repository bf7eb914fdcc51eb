/** The figures of the papers that are presets, by the presets' names. */

/** The papers whose figures are presets, as the presets' names begin. */
export const PAPERS = ['journal', 'conference'] as const;
export type Paper = (typeof PAPERS)[number];

/** The paper of a preset that is a figure. */
export function paperOf(name: string): Paper {
  return PAPERS.find((paper) => name.startsWith(paper)) ?? PAPERS[0];
}

/** `journal-fig11a` → `Fig. 11 (a)`. */
export function figureOf(name: string): string {
  const [, number = '', part = ''] = /fig(\d+)([a-z]?)$/.exec(name) ?? [];
  return `Fig. ${number}${part && ` (${part})`}`;
}
