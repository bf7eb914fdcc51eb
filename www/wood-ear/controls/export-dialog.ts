/** The dialog that saves a colony of wood ears as a file. */

import { exportDialog } from '../../controls/export-dialog.ts';
import { fittingMesh, meshControls } from '../../controls/export-meshes.ts';
import type { MeshWords } from '../../controls/export-meshes.ts';
import type { WoodEars } from '../table.ts';

const MESHES: MeshWords = {
  label: 'exportEars',
  forms: { rocks: 'mesh-rocks', one: 'mesh-one-colony' },
  solid: 'exportSurfaces',
  open: 'surfaces-grown',
  closed: 'bottom-closed',
  areRocks: false,
};

export const showExport = /* @__PURE__ */ exportDialog<WoodEars>({
  exporter: async () => (await import('../export-client.ts')).exportInWorker,
  forms: MESHES.forms,
  controls: (choosing) => meshControls(choosing, MESHES),
  fitting: (options, change) => fittingMesh(options, change, MESHES),
});
