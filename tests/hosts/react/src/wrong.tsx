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
  // @ts-expect-error no such rule
  <wood-ear-log collisions="never" />,
  // @ts-expect-error not a number
  <wood-ear-log density="dense" />,
  // @ts-expect-error the rocks', not the log's
  <wood-ear-log imageWidth={800} />,
];

/** And what they have to take. */
export const right = (
  <wood-ear-log
    preset="wet-colony"
    density={40}
    log-length="120"
    bases="0 -15 20"
    ground="shingle"
    editable
    onchange={({ detail }) => detail.params.bases}
  />
);
