// What the types have to refuse; a line that they let pass is an error of its own.
import type {} from 'rock-field/jsx';

export const wrong = [
  // @ts-expect-error no such view
  <rock-field view="4d" />,
  // @ts-expect-error no such preset
  <rock-field preset="journal-fig99" />,
  // @ts-expect-error not a number
  <rock-field seed="seven" />,
  // @ts-expect-error a list, one radius for each layer
  <rock-field radius={90} />,
  // @ts-expect-error not a number, as an attribute
  <rock-field image-width="wide" />,
  // @ts-expect-error no such choice
  <rock-field swing="both" />,
  // @ts-expect-error no such parameter
  <rock-field imageSize={800} />,
  // @ts-expect-error a generate event has no camera
  <rock-field ongenerate={({ detail }) => detail.camera} />,
  // @ts-expect-error a camera event has no statistics
  <rock-field oncamera-change={({ detail }) => detail.stats} />,
];
