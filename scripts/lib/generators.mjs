// The generators that there are, each with all that building, packing, documenting, measuring and testing have to know about it.
//
// A generator more is an entry more, and its own files. `npm test -- --only generators` names those that are missing, and the lines that
// cannot be derived from here, in package.json, in Cargo.toml and in a few files of src/ and www/.

/**
 * What every generator has needs no field: `src/<name>/`, `src/params/<name>/` and `src/bindings/<wasm>.rs`; element.ts, table.ts,
 * panel.ts, load-panel.ts, load-panel.cdn.ts and param-docs.gen.ts in `www/<name>/`; and its page's script, `www/pages/<name>.ts`.
 *
 * @typedef {object} Generator
 * @property {string} name Its folder in www/; with an underscore for a hyphen, also in src/ and src/params/.
 * @property {string} tag Its element. `www/entries/<tag>.ts` registers it, and is the entry of the package by that name; that of the first
 *   generator is the package itself.
 * @property {string} classEntry The entry that has the element's class: `tag`, or one that registers nothing.
 * @property {string} [on] The name of the generator that makes what its own things lie on: its modules may use that one's, and its page needs it.
 * @property {string} wasm The cargo feature, and the name of the artefact in pkg/.
 * @property {{ profile: string, optimise: string[], rustc?: string[], silent?: boolean }} compile How the artefact is made: the profile in Cargo.toml,
 *   the flags of wasm-opt and of rustc, and whether panics say nothing.
 * @property {number} budget The most bytes that the artefact and its glue may take after brotli; 1 kB = 1000 bytes.
 * @property {string} worker The entry that runs the artefact in a worker.
 * @property {string[]} otherWorkers Entries that run something else in workers, none of them for the first picture.
 * @property {string} panel The name of the element's panel in dist/.
 * @property {string} cdn The name of the classic script in dist/ that registers the element.
 * @property {{ file: string, script: string, title?: string, description?: string }} page The page's file and the name of its script in
 *   dist/; what it says of itself, where that is not what index.html says.
 * @property {{ title: string, description: string }} [docs] The page of the documentation that lists the element's members, whose beginning is
 *   `www/docs/pages/<tag>.md`. The rest of the documentation is about the first element, which has none.
 * @property {string} table The name of its table of parameters in www/<name>/table.ts.
 * @property {string} paramDocs The name of its sentences in www/<name>/param-docs.gen.ts.
 * @property {boolean} hasItemAttributes Whether the rows of its items are attributes of the element too, as lists.
 * @property {string} goldens The test program of the crate whose `every_preset_has_its_golden_hash` compares its hashes.
 * @property {Record<string, string | number>} small Attributes with which the element has little to do.
 */

/** @type {Generator[]} */
export const GENERATORS = [
  {
    name: 'rocks',
    tag: 'rock-field',
    classEntry: 'element',
    wasm: 'generator',
    // Made for speed. Functions called once stay functions: V8 makes a third slower code of very large ones.
    compile: {
      profile: 'release',
      rustc: ['-C', 'no-vectorize-loops', '-C', 'llvm-args=-inline-threshold=90 -unroll-runtime=false -unroll-allow-partial=false'],
      silent: true,
      optimise: [
        '-O3',
        '--one-caller-inline-max-function-size',
        '0',
        '--low-memory-unused',
        '--strip-target-features',
        '--strip-producers',
      ],
    },
    budget: 67_500,
    worker: 'worker',
    otherWorkers: ['full-worker', 'export-worker'],
    panel: 'panel',
    cdn: 'cdn',
    page: { file: 'index.html', script: 'main' },
    table: 'ROCKS',
    paramDocs: 'PARAM_DOCS',
    hasItemAttributes: true,
    goldens: 'golden',
    small: { 'image-width': 64, 'image-height': 64 },
  },
  {
    name: 'wood-ear',
    tag: 'wood-ear-log',
    classEntry: 'wood-ear-log',
    // The log lies on rocks.
    on: 'rocks',
    wasm: 'wood-ear',
    // Small, and as fast as with everything: the size levels of the compiler are as large and half as fast; vectorised loops, the deepest
    // inlining and loops unrolled in part take 2.6 kB and save no time that can be measured; what panics say, and where in the sources they
    // are, takes 3.7 kB, and nobody reads it. Nor does anything need the names of the tools and of the features of wasm; and nothing is ever stored below
    // address 1024, where the stack ends, which lets the optimiser join more addresses.
    compile: {
      profile: 'wood-ear',
      rustc: ['-C', 'no-vectorize-loops', '-C', 'llvm-args=-inline-threshold=150 -unroll-runtime=false -unroll-allow-partial=false'],
      silent: true,
      optimise: [
        '-Os',
        '--one-caller-inline-max-function-size',
        '0',
        '--low-memory-unused',
        '--strip-target-features',
        '--strip-producers',
      ],
    },
    budget: 40_500,
    worker: 'wood-ear-worker',
    otherWorkers: ['wood-ear-file-worker', 'wood-ear-export-worker'],
    panel: 'wood-ear-panel',
    cdn: 'wood-ear-cdn',
    page: {
      file: 'wood-ear.html',
      script: 'wood-ear',
      title: 'rock-field – wood ears on a fallen log',
      description:
        'A colony of wood-ear fungus on a fallen log, grown in the browser from one seed. Place it, let it dry, wrinkle and curl, share the link.',
    },
    docs: {
      title: 'Wood ears',
      description:
        'A second element, <wood-ear-log>: a colony of wood-ear fungus on a fallen log. Its attributes, properties, methods and events.',
    },
    table: 'WOOD_EARS',
    paramDocs: 'WOOD_EAR_DOCS',
    hasItemAttributes: false,
    goldens: 'wood_ear_properties',
    small: { ground: '', density: 0 },
  },
];

/**
 * Artefacts beside, each fetched when it is first asked for, with the fields of the same names as a generator has.
 *
 * @type {Pick<Generator, 'wasm' | 'compile' | 'budget'>[]}
 */
export const LATER = [
  // The generator of rocks with what few fields ask for, which takes its place for those (`www/rocks/needs-full.ts`).
  {
    wasm: 'generator-full',
    compile: { ...GENERATORS[0].compile, profile: 'generator-full' },
    budget: 69_000,
  },
  // For exports.
  {
    wasm: 'ground-mesh',
    // As the wood ears', which is as fast as the rocks' way, and 12 kB smaller.
    compile: { ...GENERATORS[1].compile, profile: 'ground-mesh' },
    budget: 60_000,
  },
];

/** The generator and those that it stands on, itself first. */
export function withGround(generator, all = GENERATORS) {
  const ground = all.find(({ name }) => name === generator.on);
  return ground ? [generator, ...withGround(ground, all)] : [generator];
}

/** The names of the entries of the package that have to do with one generator alone. */
export function entriesOf({ tag, classEntry }) {
  return [...new Set([tag, classEntry])];
}

/** The names of the entries that run in workers. */
export function workersOf({ worker, otherWorkers }) {
  return [worker, ...otherWorkers];
}

/** Entries of the package that work without a page. Each has a variant for Node, `www/entries/<name>.node.ts`. */
export const HEADLESS = ['core', 'export', 'three'];

/** Packages that whoever uses an entry has already: they are peers in package.json, and no part of what is built. */
export const PEERS = ['three'];

/** The source file of an entry. */
export function entryFile(name) {
  return `www/entries/${name}.ts`;
}

/** The source file of a generator's page. */
export function pageScript({ name }) {
  return `www/pages/${name}.ts`;
}

/** The function of www/entries/variants/inline-worker.ts that gives the address of a worker. */
export function addressFunction(worker) {
  return `${camelCase(worker)}Address`;
}

/** `wood-ear` → `wood_ear`, as Rust spells it. */
export function inRust(name) {
  return name.replaceAll('-', '_');
}

/** `wood-ear` → `woodEar`. */
export function camelCase(name) {
  return name.replace(/-([a-z])/g, (_, letter) => letter.toUpperCase());
}
