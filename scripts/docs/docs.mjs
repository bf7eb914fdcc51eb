// The documentation: www/docs/ and the element's manifest → dist/docs/, plain HTML with one script and one style sheet.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { root } from '../lib/env.mjs';
import { GENERATORS } from '../lib/generators.mjs';
import { commandTables } from './command.mjs';
import { errorNames, troubleshooting } from './errors.mjs';
import { exportOptions, exportTargets, sceneOptions } from './export.mjs';
import { frame, markdown } from './html.mjs';
import { members } from './members.mjs';
import { needed } from '../lib/run.mjs';
import { elementTables, gallery, overview, sections, types } from './reference.mjs';

const SOURCES = path.join(root, 'www', 'docs');

/** In the order of the navigation. `kinds`: of members, a section for each; `prose`: a Markdown file; `make`: all the rest. */
const PAGES = [
  {
    file: 'index.html',
    title: 'Start',
    prose: 'start',
    className: 'prose start',
    description: 'A custom element that grows a field of rocks from one seed: how to put it on a page.',
  },
  {
    file: 'recipes.html',
    title: 'Recipes',
    prose: 'recipes',
    description:
      'rock-field in plain HTML, from a CDN, under a strict policy, in React, Vue, Svelte, Next, with bundlers, in Node and with three.js.',
  },
  {
    file: 'concepts.html',
    title: 'Concepts',
    prose: 'concepts',
    description: 'Links and seeds, gestures and accessibility, performance and many elements, errors.',
  },
  {
    file: 'export.html',
    title: 'Files for other programs',
    prose: 'export',
    description: 'Rocks as GLB, OBJ, STL or PLY for Blender, Unreal, Unity, Godot, three.js and printing: options, units, names, origins.',
  },
  {
    file: 'command-line.html',
    title: 'Command line',
    prose: 'command-line',
    description:
      'Fields of rocks as files from a terminal or a script: thousands of seeds on all cores, maps, NumPy, and what made a file.',
  },
  {
    file: 'cluster.html',
    title: 'On a cluster',
    prose: 'cluster',
    description: 'A hundred thousand scenes on many machines: shards, Dask, Kubernetes, render farms, and nothing lost when one dies.',
  },
  {
    file: 'engines.html',
    title: 'In your own scene',
    prose: 'engines',
    description:
      'A field of rocks in a scene of three.js, React Three Fiber or Babylon.js, in five lines: levels of detail, picking, disposal.',
  },
  {
    file: 'troubleshooting.html',
    title: 'Troubleshooting',
    make: troubleshooting,
    description: 'Every message of rock-field: errors by name, and notices of links and attributes, with cause and remedy.',
  },
  {
    file: 'gallery.html',
    title: 'Gallery',
    make: gallery,
    className: 'wide',
    description: 'All presets, live: natural grounds, and the figures of the two papers.',
  },
  {
    file: 'reference.html',
    title: 'Everything at a glance',
    group: 'Reference',
    make: overview,
    description: 'Every attribute, property, method, event, slot, CSS part and custom property of <rock-field>.',
  },
  {
    file: 'attributes.html',
    title: 'Attributes',
    kinds: ['attribute'],
    description: 'Every attribute of <rock-field>, and the property that goes with it, beside a live example.',
  },
  {
    file: 'properties.html',
    title: 'Properties',
    kinds: ['property'],
    description: 'The properties of <rock-field> that have no attribute, beside live examples.',
  },
  { file: 'methods.html', title: 'Methods', kinds: ['method'], description: 'Every method of <rock-field>, beside a live example.' },
  { file: 'events.html', title: 'Events', kinds: ['event'], description: 'Every event of <rock-field>, beside a live example.' },
  {
    file: 'styling.html',
    title: 'Slots and CSS',
    kinds: ['slot', 'part', 'css-property'],
    description: 'Slots, CSS parts and custom properties of <rock-field>, beside live examples.',
  },
  ...GENERATORS.filter(({ docs }) => docs).map(({ tag, docs }) => ({
    file: `${tag}.html`,
    make: () => elementTables(tag),
    className: 'wide',
    ...docs,
  })),
  {
    file: 'types.html',
    title: 'Types',
    make: types,
    description: 'The types of fields, parameters, cameras and errors, and the functions of rock-field/core.',
  },
];

/** Writes the pages; the script and the style sheet are bundled beside them. Resolves to the files' names. */
export async function writeDocs(folder) {
  mkdirSync(folder, { recursive: true });
  const all = await members();
  for (const page of PAGES) {
    const { heading, body, contents } = await render(page, all);
    writeFileSync(path.join(folder, page.file), frame({ pages: PAGES, current: Object.assign(page, { heading }), body, contents }));
  }
}

/** `{ heading, body, contents }`: the page's own words, and what its navigation lists. */
async function render(page, all) {
  const intro = readProse(page.prose ?? path.basename(page.file, '.html'));
  const heading = needed(/<h1>(.*?)<\/h1>/.exec(intro.html), `heading in the prose of ${page.file}`)[1].replace(/<[^>]*>/g, '');
  if (page.prose) return { heading, body: intro.html, contents: intro.headings.map(({ id, name }) => ({ id, name: decoded(name) })) };
  const { html, contents } = page.kinds
    ? await sections(
        all.filter(({ kind }) => page.kinds.includes(kind)),
        page.kinds,
      )
    : await page.make(all, PAGES);
  return { heading, body: `${intro.html}\n${html}`, contents };
}

function readProse(name) {
  const { html, headings } = markdown(readFileSync(path.join(SOURCES, 'pages', `${name}.md`), 'utf8'));
  const made = {
    errors: errorNames,
    'export targets': exportTargets,
    'export options': exportOptions,
    'scene options': sceneOptions,
    ...commandTables,
  };
  return { html: html.replace(/<!-- (.+?) -->/g, (comment, name) => made[name]?.() ?? comment), headings };
}

function decoded(html) {
  return html.replaceAll('&lt;', '<').replaceAll('&gt;', '>').replaceAll('&quot;', '"').replaceAll('&#39;', "'").replaceAll('&amp;', '&');
}
