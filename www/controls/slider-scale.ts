/** Between a value and its place on a slider. */

import type { Bounds } from '../table/row.ts';

/** Stops of a logarithmic slider in an octave, so that powers of two are stops; about 1.5 % from one to the next. */
const STOPS_PER_OCTAVE = 48;

export interface SliderScale {
  min: number;
  max: number;
  step: number;
  /** The slider's own number for a value. */
  positionOf: (value: number) => number;
  /** The value at a slider's number, on the parameter's step; another one than `current` if the slider has moved. */
  valueAt: (position: number, current: number) => number;
}

export function sliderScale({ step, slider }: Bounds): SliderScale {
  if (!slider.logarithmic) {
    return { min: slider.min, max: slider.max, step, positionOf: (value) => value, valueAt: (position) => position + 0 };
  }
  const octaves = Math.log2(slider.max / slider.min);
  const max = Math.round(octaves * STOPS_PER_OCTAVE);
  const positionOf = (value: number) => (Math.log2(Math.max(value, slider.min) / slider.min) / octaves) * max;
  const valueAt = (position: number, current: number) => {
    const value = onStep(slider.min * 2 ** ((position / max) * octaves), step);
    // Where stops are closer than steps, an arrow key has to get past the rounding.
    const moved = Math.sign(position - Math.round(positionOf(current)));
    const next = value === current ? onStep(current + moved * step, step) : value;
    return Math.min(slider.max, Math.max(slider.min, next));
  };
  return { min: 0, max, step: 1, positionOf, valueAt };
}

/** On the parameter's step; three digits are plenty for a drag, so 512 px and not 511.8. */
function onStep(value: number, step: number): number {
  const finest = Math.max(0, Math.round(-Math.log10(step)));
  const sensible = Math.max(0, 2 - Math.floor(Math.log10(value)));
  return Number(value.toFixed(Math.min(finest, sensible)));
}
