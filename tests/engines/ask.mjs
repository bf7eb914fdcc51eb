// Asking a page in an engine, and saying what is not as it should be.
import assert from 'node:assert/strict';

/** The answer of the page's `examined`, in which nothing may have gone wrong. */
export async function ask(engine, call) {
  // A page counts as loaded before its modules have run, in some engines.
  const arrived = `new Promise((done) => { const look = () => (globalThis.examined ? done(examined.${call}) : setTimeout(look, 20)); look(); })`;
  const { complaints, ...answer } = await engine.evaluate(arrived);
  same([...complaints, ...engine.complaints()], [], 'what went wrong in the page');
  return answer;
}

export function same(actual, expected, what) {
  assert.deepEqual(actual, expected, `${what}: ${JSON.stringify(actual)} instead of ${JSON.stringify(expected)}`);
}
