// What the bundler is told about the panel of an element: it is a file of its own, and has its styles in it.
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { ts } from '@custom-elements-manifest/analyzer';
import * as esbuild from 'esbuild';
import { root } from '../lib/env.mjs';
import { GENERATORS } from '../lib/generators.mjs';

/**
 * What an element with `controls` loads when its panel is opened, by its name in dist/. In one file: what it shares with the element is little,
 * and would be cut out of the element's file, which everybody loads.
 */
export const PANELS = Object.fromEntries(GENERATORS.map(({ name, panel }) => [panel, `www/${name}/panel.ts`]));

/** Whoever loads a panel asks for panel.js, which lies beside every chunk; `names` says what it is really called. */
export function panelApart(names = new Map()) {
  return {
    name: 'panel-apart',
    setup(build) {
      build.onResolve({ filter: /\/panel\.ts$/ }, ({ kind, path: file, resolveDir }) => {
        const source = path.relative(root, path.join(resolveDir, file)).replaceAll(path.sep, '/');
        const name = `${Object.keys(PANELS).find((panel) => PANELS[panel] === source)}.js`;
        return kind === 'dynamic-import' ? { path: `./${names.get(name) ?? name}`, external: true } : undefined;
      });
    },
  };
}

/** Some packages have a class for Node beside the one for browsers, of which nothing is left; scripts/checks/check-deps.mjs sees to it. */
export const nodeless = {
  name: 'nodeless',
  setup(build) {
    build.onResolve({ filter: /^node:/ }, ({ path: name, kind }) =>
      kind === 'dynamic-import' ? { path: name, external: true, sideEffects: false } : undefined,
    );
  },
};

/** In a classic script of another origin an import has no address to be relative to. */
export const panelByAddress = {
  name: 'panel-by-address',
  setup(build) {
    build.onResolve({ filter: /\/load-panel\.ts$/ }, ({ path: file, resolveDir }) => ({
      path: path.join(resolveDir, file.replace(/\.ts$/, '.cdn.ts')),
    }));
  },
};

/** A style sheet that a script imports is its text, with all that it imports itself. */
export const sheetsAsText = {
  name: 'sheets-as-text',
  setup(build) {
    build.onResolve({ filter: /\.css$/ }, ({ path: name, importer, resolveDir }) =>
      importer.endsWith('.ts') ? { path: path.relative(root, path.join(resolveDir, name)), namespace: 'sheet' } : undefined,
    );
    build.onLoad({ filter: /./, namespace: 'sheet' }, async ({ path: file }) => {
      const { outputFiles } = await esbuild.build({
        absWorkingDir: root,
        entryPoints: [file],
        bundle: true,
        minify: true,
        write: false,
        logLevel: 'warning',
      });
      return { contents: outputFiles[0].text.trim(), loader: 'text' };
    });
  },
};

/** In templates of Lit, a line's end and the next one's indent are one space: to a browser it is the same. */
export const templatesInOneLine = {
  name: 'templates-in-one-line',
  setup(build) {
    build.onLoad({ filter: /[\\/]www[\\/].*controls[\\/].*\.ts$/ }, ({ path: file }) => {
      const text = readFileSync(file, 'utf8');
      return text.includes('html`') ? { contents: inOneLine(text), loader: 'ts' } : undefined;
    });
  },
};

function inOneLine(text) {
  const places = [];
  const visit = (node) => {
    if (ts.isTaggedTemplateExpression(node) && node.tag.getText() === 'html') {
      const { template } = node;
      const parts = ts.isTemplateExpression(template)
        ? [template.head, ...template.templateSpans.map(({ literal }) => literal)]
        : [template];
      places.push(...parts.map((part) => [part.getStart(), part.end]));
    }
    ts.forEachChild(node, visit);
  };
  visit(ts.createSourceFile('', text, ts.ScriptTarget.ES2022, true));
  return places
    .sort(([a], [b]) => b - a)
    .reduce((all, [start, end]) => all.slice(0, start) + all.slice(start, end).replaceAll(/\n\s*/g, ' ') + all.slice(end), text);
}
