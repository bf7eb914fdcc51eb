/** What somebody meant who mistyped a word. */

/** The word of `known` that is nearest to `given`, if one is near: it begins with it, has it in it, or differs by a few letters. */
export function nearest(given: string, known: Iterable<string>): string | undefined {
  const wanted = given.toLowerCase();
  // A third of the letters may be wrong, of short words one.
  const most = Math.max(1, Math.floor(wanted.length / 3));
  let best: { word: string; apart: number } | undefined;
  for (const word of known) {
    const other = word.toLowerCase();
    const isPart = wanted.length > 2 && (other.startsWith(wanted) || other.split('-').includes(wanted));
    const apart = isPart ? 0.5 : typos(wanted, other, most);
    if (apart <= most && (best === undefined || apart < best.apart)) best = { word, apart };
  }
  return best?.word;
}

/** ` Did you mean riverbed?`, or nothing where no word is near. */
export function didYouMean(given: string, known: Iterable<string>, shown: (word: string) => string = (word) => word): string {
  const word = nearest(given, known);
  return word === undefined ? '' : ` Did you mean ${shown(word)}?`;
}

/** Letters to be put in, left out, replaced or swapped with their neighbour to make one word of the other; above `most`, some number above it. */
function typos(one: string, other: string, most: number): number {
  if (Math.abs(one.length - other.length) > most) return most + 1;
  let before: number[] = [];
  let last = Array.from({ length: other.length + 1 }, (_, j) => j);
  for (let i = 1; i <= one.length; i++) {
    const row = [i];
    for (let j = 1; j <= other.length; j++) {
      const isSame = one[i - 1] === other[j - 1];
      let least = Math.min(last[j]! + 1, row[j - 1]! + 1, last[j - 1]! + (isSame ? 0 : 1));
      if (i > 1 && j > 1 && one[i - 1] === other[j - 2] && one[i - 2] === other[j - 1]) least = Math.min(least, before[j - 2]! + 1);
      row.push(least);
    }
    [before, last] = [last, row];
  }
  return last[other.length]!;
}
