/** The dialog that saves rocks as a file: meshes, points or maps. */

import { html, nothing } from 'lit';
import { exportDialog } from '../../controls/export-dialog.ts';
import { fittingMesh, meshControls } from '../../controls/export-meshes.ts';
import type { MeshWords } from '../../controls/export-meshes.ts';
import { segments } from '../../controls/parts.ts';
import type { Rocks } from '../table.ts';
import { CONTENTS, contentOf, fittingMap, mapControls, pointControls, retarget, turnTo } from './export-maps.ts';

const MESHES: MeshWords = {
  label: 'exportMesh',
  forms: { rocks: 'mesh-rocks', kit: 'mesh-kit', one: 'mesh-one' },
  solid: 'exportBottom',
  open: 'bottom-open',
  closed: 'bottom-closed',
  areRocks: true,
};

export const showExport = /* @__PURE__ */ exportDialog<Rocks>({
  exporter: async () => (await import('../export-client.ts')).exportInWorker,
  forms: MESHES.forms,
  controls: (choosing, { imageWidth, imageHeight }) => {
    const { words, options, target, choose } = choosing;
    const content = contentOf(options);
    return html`
      ${segments({
        name: 'export-content',
        label: words('exportContent'),
        options: CONTENTS.map((value) => ({ value, label: words(`content-${value}`) })),
        value: content,
        action: (next) => choose(turnTo(next, options, target)),
      })}
      ${content === 'maps' ? mapControls(choosing, Math.max(imageWidth, imageHeight)) : nothing}
      ${content === 'points' ? pointControls(choosing) : nothing} ${content === 'meshes' ? meshControls(choosing, MESHES) : nothing}
    `;
  },
  fitting: (options, change) => {
    const content = contentOf(options);
    if (content === 'maps') return fittingMap(options, change);
    return content === 'points' ? options : fittingMesh(options, change, MESHES);
  },
  retarget,
});
