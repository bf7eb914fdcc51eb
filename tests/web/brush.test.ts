// What a brush leaves on the ground, without a picture.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { mulberry32 } from '../../www/controls/mulberry32.ts';
import { shapeOf, strokeAlong, thinned } from '../../www/rocks/controls/painting/brush.ts';
import { project } from '../../www/scene/camera/pick.ts';
import { strokesToText } from '../../www/rocks/strokes.ts';

/** A hand's way: it turns a little at every step. */
function way(seed: number, count: number): number[] {
  const random = mulberry32(seed);
  const points = [0.5, 0.5];
  let angle = 6 * random();
  for (let k = 1; k < count; k += 1) {
    angle += 0.8 * (random() - 0.5);
    points.push(points[2 * k - 2]! + 0.004 * Math.cos(angle), points[2 * k - 1]! + 0.004 * Math.sin(angle));
  }
  return points;
}

function toLine([x, y]: readonly [number, number], line: readonly number[]): number {
  let nearest = Infinity;
  for (let k = 0; k + 3 < line.length; k += 2) {
    const [ax, ay, bx, by] = line.slice(k, k + 4) as [number, number, number, number];
    const share = Math.min(1, Math.max(0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2 || 1)));
    nearest = Math.min(nearest, Math.hypot(ax + share * (bx - ax) - x, ay + share * (by - ay) - y));
  }
  return nearest;
}

test('a stroke keeps its ends, and lies within the tolerance of every point that was left out', () => {
  for (let seed = 1; seed <= 40; seed += 1) {
    const points = way(seed, 120);
    const thin = thinned(points, 0.003);
    assert.deepEqual([thin.slice(0, 2), thin.slice(-2)], [points.slice(0, 2), points.slice(-2)]);
    for (let k = 0; k < points.length; k += 2)
      assert.ok(toLine([points[k]!, points[k + 1]!], thin) <= 0.003 + 1e-12, `seed ${seed}, point ${k / 2}`);
    assert.ok(thin.length < points.length / 2, `seed ${seed}: ${thin.length} of ${points.length} numbers`);
  }
});

test('a hand that rests leaves a dot, and one that comes back to its beginning a line', () => {
  assert.deepEqual(thinned([0.5, 0.5, 0.5, 0.5, 0.5, 0.5], 0.01), [0.5, 0.5]);
  assert.deepEqual(thinned([0.5, 0.5], 0.01), [0.5, 0.5]);
  assert.deepEqual(thinned([0, 0, 1, 0, 0, 0], 0.01), [0, 0, 1, 0, 0, 0]);
});

test('what goes beyond what a stroke can say ends there', () => {
  const stroke = strokeAlong({ mode: 'path', layer: null, width: 0.1 }, [0.5, 0.5, 40, 0.5]);
  assert.deepEqual(stroke.points, [0.5, 0.5, 16, 0.5]);
  assert.doesNotThrow(() => strokesToText([stroke]));
});

test('a stroke in a picture covers what it covers on the ground, whatever the camera, and goes round one way', () => {
  const stroke = { width: 0.1, points: [0.3, 0.4, 0.6, 0.5, 0.6, 0.7] };
  for (const [azimuth, elevation, isPlan] of [
    [0, Math.PI / 2, false],
    [0.6, 0.7, false],
    [2.5, 0.35, true],
  ] as const) {
    const camera = { azimuth, elevation, distance: 300, target: [100, 100, 0] as [number, number, number] };
    const shape = shapeOf(stroke, 200, { camera, aspect: 1.6, isPlan });
    for (const polygon of shape) assert.ok(area(polygon) > 0, 'clockwise');
    const seen = isPlan ? { ...camera, azimuth: 0, elevation: Math.PI / 2 } : camera;
    const random = mulberry32(7);
    for (let k = 0; k < 500; k += 1) {
      const ground: [number, number] = [random(), random()];
      const distance = toLine(ground, stroke.points);
      // Circles have corners.
      if (Math.abs(distance - 0.05) < 0.001) continue;
      const point = project(seen, [200 * ground[0], 200 * ground[1], 0], 1.6);
      assert.ok(point);
      assert.equal(
        shape.some((polygon) => contains(polygon, point)),
        distance < 0.05,
        `${ground.join(', ')}`,
      );
    }
  }
});

type Polygon = [number, number][];

function area(polygon: Polygon): number {
  return polygon.reduce((sum, [x, y], k) => {
    const [nextX, nextY] = polygon[(k + 1) % polygon.length]!;
    return sum + (x * nextY - nextX * y) / 2;
  }, 0);
}

/** In a convex polygon that goes counter-clockwise. */
function contains(polygon: Polygon, [x, y]: [number, number]): boolean {
  return polygon.every(([ax, ay], k) => {
    const [bx, by] = polygon[(k + 1) % polygon.length]!;
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0;
  });
}
