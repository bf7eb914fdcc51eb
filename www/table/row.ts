/** One row of a parameter table: all that there is to know of a parameter. The rows are generated from the Rust tables. */

/** In pixels, or as the conference paper writes lengths: in a hundredth of the width, heights in the radius. */
export type Notation = 'px' | 'relative';

export interface Bounds {
  min: number;
  max: number;
  step: number;
  default: number | null;
  slider: { min: number; max: number; logarithmic: boolean };
}

/** One row of a parameter table. */
export interface Row extends Bounds {
  key: string;
  /** Part of a triple: 0 base, 1 per rock, 2 per vertex. */
  component: number | null;
  url: string;
  /** Of the whole, or of each item of the list that goes with it. */
  scope: 'field' | 'layer' | 'base';
  kind: 'real' | 'integer' | 'optional-real' | 'optional-integer' | 'choice';
  /** First stage an edit re-runs; `look` re-runs none and is drawn at once. */
  stage: string;
  /** Bounds in the conference's notation where they differ. */
  relative: Bounds | null;
  unit: Record<Notation, string>;
  /** In English, as those of the choices; `labelOf` has them in Japanese. */
  label: string;
  choices: readonly { value: string; label: string }[];
}

/** An edit of such a row is drawn at once and makes nothing. */
export const isLook = ({ stage }: Row): boolean => stage === 'look';
/** An edit of such a row makes a new result. */
export const isMade = (row: Row): boolean => !isLook(row);
