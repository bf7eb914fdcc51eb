// A log as a modelling program would write it.

const LOG = { around: 24, rings: 30, radius: 8, length: 100 };

export const LOG_VERTICES = LOG.around * LOG.rings + 2;

/** A closed cylinder as an OBJ file, in cm. */
export function logAsObj() {
  const { around, rings, radius, length } = LOG;
  const lines = [];
  const vertex = (ring, k, share = 1) => {
    const angle = (2 * Math.PI * k) / around;
    const point = [(length * ring) / (rings - 1) - length / 2, share * radius * Math.cos(angle), share * radius * Math.sin(angle)];
    lines.push(`v ${point.map((coordinate) => coordinate.toFixed(3)).join(' ')}`);
  };
  const face = (...corners) => lines.push(`f ${corners.map((corner) => corner + 1).join(' ')}`);
  for (let ring = 0; ring < rings; ring += 1) for (let k = 0; k < around; k += 1) vertex(ring, k);
  vertex(0, 0, 0);
  vertex(rings - 1, 0, 0);
  const [left, right] = [around * rings, around * rings + 1];
  for (let k = 0; k < around; k += 1) {
    const next = (k + 1) % around;
    for (let ring = 0; ring + 1 < rings; ring += 1) {
      const at = ring * around;
      face(at + k, at + next, at + around + next, at + around + k);
    }
    face(left, next, k);
    face(right, around * (rings - 1) + k, around * (rings - 1) + next);
  }
  return lines.join('\n');
}
