// What the camera frames by itself.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { defaultCamera, groundPoint } from '../../www/camera.ts';

const SIZES = [[640, 640], [900, 300], [300, 900]] as const;
const ASPECTS = [0.3, 0.5, 1, 1.6, 3];

test('close up, a picture of any shape shows the field to its edges and nothing beside it', () => {
  for (const [width, height] of SIZES) {
    for (const aspect of ASPECTS) {
      const camera = defaultCamera(width, height, aspect, '3d', true);
      const sides = [[-1, -1], [1, -1], [-1, 1], [1, 1]].map(([x, y]) => groundPoint(camera, x!, y!, aspect));
      assert(sides.every((point) => point && point[0] > 0 && point[0] < width && point[1] > 0 && point[1] < height), `${width} × ${height} at ${aspect}`);
      const spans = [0, 1].map((axis) => Math.max(...sides.map((point) => point![axis]!)) - Math.min(...sides.map((point) => point![axis]!)));
      assert(Math.max(spans[0]! / width, spans[1]! / height) > 0.9, 'it could be farther away');
    }
  }
});

test('plans are framed as they are, close up or not', () => {
  for (const view of ['diagrams', 'selection'] as const) assert.deepEqual(defaultCamera(640, 480, 1.5, view, true), defaultCamera(640, 480, 1.5, view));
});
