/**
 * Every error that the package can give, by its `name`. The type `ErrorName` and the documentation's tables are made from this list, and a
 * test compares it with what is thrown. Import its types alone from code that is shipped: its sentences are for the documentation.
 *
 * To add an error, add a row here, then throw it.
 */

export interface ErrorEntry {
  group: ErrorGroup;
  /** The message as people meet it; what stands in `{…}` differs. */
  message: string;
  cause: string;
  /** What the reader can do about it. Markdown within a line, as is `cause`. */
  remedy: string;
}

/** What the errors of one group have in common, in the order of the documentation. */
export const ERROR_GROUPS = {
  request: { title: 'Parameters', means: 'a value that is not allowed; `key` names it, and nothing has changed' },
  log: { title: 'Logs from files and meshes', means: 'a log that cannot be read or grown on; the old log stays' },
  export: { title: 'Exports', means: 'a file that cannot be made so; nothing has been written' },
  import: { title: 'Files that bring a scene back', means: 'a file that brings none; nothing has changed' },
  element: { title: 'Element and picture', means: 'the element is in no document, or there is no picture to take' },
  graphics: { title: 'Graphics', means: 'this device or browser cannot draw the picture' },
  loading: { title: 'Loading', means: 'a file did not arrive, or a policy forbids it' },
  internal: { title: 'Faults of rock-field', means: 'our fault; please report it with the link' },
} as const;

export type ErrorGroup = keyof typeof ERROR_GROUPS;

/** Keeps the names apart from one another in the declarations, without their sentences. */
function listed<Name extends string>(entries: Record<Name, ErrorEntry>): Record<Name, ErrorEntry> {
  return entries;
}

export const ERRORS = /* @__PURE__ */ listed({
  OutOfRange: {
    group: 'request',
    message: '{key} is {value}; it must be between {min} and {max}',
    cause: 'A number outside its bounds, NaN, or a word that is not among the choices.',
    remedy:
      'Pass a value between `min` and `max` of the error, or one of the words in its message. [Attributes](attributes.html) lists all bounds.',
  },
  NotAnInteger: {
    group: 'request',
    message: '{key} is {value}; it must be a whole number',
    cause: 'A fraction where only whole numbers mean something: `seed`, `imageWidth`, `cellCount`.',
    remedy: 'Round it before you pass it.',
  },
  WrongType: {
    group: 'request',
    message: '{key} is {value}; it must be a number',
    cause: 'Text where a number is expected, a number where a list is expected, a hole in a list, and the like.',
    remedy: 'Pass the type that the message names. Numbers from form fields are text: use `valueAsNumber` or `Number(…)`.',
  },
  UnknownKey: {
    group: 'request',
    message: 'there is no parameter called "{key}"',
    cause: 'A key that no parameter has, often a misspelt one.',
    remedy: 'Compare with the [types](types.html). TypeScript finds these before they run.',
  },
  UnknownPreset: {
    group: 'request',
    message: 'there is no preset called "{value}"',
    cause: 'A preset that does not exist, or one of the other element.',
    remedy: 'Take a name from the [gallery](gallery.html), or from `presets` of `rock-field/core`.',
  },
  TooManyLayers: {
    group: 'request',
    message: 'there are {value} layers; there may be at most {max}',
    cause: 'More entries in `layers` than are allowed.',
    remedy: 'Leave the surplus layers out, or merge layers of similar radius.',
  },
  DuplicateLayerId: {
    group: 'request',
    message: 'two layers have the id {value}',
    cause: 'Two entries of `layers` with the same `id`, so both would make the same random choices.',
    remedy: 'Give each layer an `id` of its own, or leave `id` out.',
  },
  MalformedRequest: {
    group: 'request',
    message: 'the request is {value}; it must be an object',
    cause: 'Parameters that are not an object, `base` together with `bases`, or a page and a worker that belong to different releases.',
    remedy: 'Pass one object as in the [types](types.html). On a server of your own, deploy all files of one release together.',
  },
  MaskUnreadable: {
    group: 'request',
    message: 'the mask at {value} could not be fetched: status 404',
    cause:
      'A mask that is not where its address says, or of another origin that does not allow it; or a file that is no picture, or a damaged one.',
    remedy: 'Open the address in the browser. Save the picture as PNG, JPEG, WebP or GIF.',
  },
  OverBudget: {
    group: 'request',
    message: 'this field (or colony) would need about {value} MiB and the budget is {max} MiB; change {key}',
    cause:
      'The run would need more memory than `maxBytes`: 1.5 GiB by default, 512 MiB on small devices. The run ends before it takes that memory; stages that were finished before are kept.',
    remedy:
      'Change the parameter that the message names: larger radii and a smaller image need less. Where there is more memory, pass a larger `maxBytes` to `rock-field/core`.',
  },

  LogNotInThrees: {
    group: 'log',
    message: 'the log’s positions and its indices must come in threes; there are {value}',
    cause: 'The length of `positions` or `indices` is not a multiple of three.',
    remedy: 'Pass x, y, z for each vertex and three indices for each triangle.',
  },
  LogTooLarge: {
    group: 'log',
    message: 'the log has {value} vertices or triangles; it may have at most {max}',
    cause: 'A mesh that is finer than a log may be.',
    remedy: 'Decimate the mesh in your modelling program; wood ears hide what is lost.',
  },
  LogBadPosition: {
    group: 'log',
    message: 'vertex {n} of the log has the coordinate {value}, not within 100 m of the origin',
    cause: 'A coordinate that is NaN or infinite, or a mesh far away from its origin.',
    remedy: 'Move the mesh to the origin, and check its units: `positions` are centimetres.',
  },
  LogBadIndex: {
    group: 'log',
    message: 'triangle {n} of the log names vertex {value}, which is not there',
    cause: 'An index that is negative, a fraction, or past the last vertex.',
    remedy: 'Count vertices from 0, and export the mesh anew.',
  },
  LogNoArea: {
    group: 'log',
    message: 'no triangle of the log has an area',
    cause: 'All triangles are points or lines.',
    remedy: 'Check that the mesh has faces, and that it is not scaled to zero.',
  },
  LogFileTooLarge: {
    group: 'log',
    message: '{file} is {value} MB; a log file may be at most {max} MB',
    cause: 'A file that is larger than any log has to be, or one that unpacks to more.',
    remedy: 'Simplify the mesh, and leave textures out of the file.',
  },
  LogFileUnreadable: {
    group: 'log',
    message: '{file} could not be read: it is a folder, or it has been moved or changed since it was chosen',
    cause: 'The browser could not open the file.',
    remedy: 'Choose the file again; of a folder, the file in it.',
  },
  LogFileUnknown: {
    group: 'log',
    message: '{file} is an FBX file, neither a GLB nor an OBJ file; save the log as one of those',
    cause: 'Another format, an archive, or a file whose beginning is damaged. The message says what it is where that can be told.',
    remedy: 'Export the mesh as GLB (binary glTF) or OBJ. Unpack archives first.',
  },
  LogFileUnsupported: {
    group: 'log',
    message: '{file} cannot be read: its geometry is compressed with Draco; save it without, or with meshopt',
    cause:
      'Geometry in a form that is not read: compressed with Draco, in a file beside the `.gltf`, glTF 1, or a ragged face of more than 10,000 corners.',
    remedy: 'Do what the message says. Textures, materials and their extensions are never the reason.',
  },
  LogFileBroken: {
    group: 'log',
    message: '{file}, line {n}: "12,5" is not a number; decimals are written with a point',
    cause: 'A file that was cut short, or whose numbers contradict each other. The message names the line, or the part of the glTF file.',
    remedy: 'Export the mesh anew, and check that it opens in another program.',
  },
  LogFileNoMesh: {
    group: 'log',
    message: '{file} has no triangles',
    cause: 'A file with points, lines, cameras or lights alone.',
    remedy: 'Select the mesh when you export it.',
  },

  ExportImpossible: {
    group: 'export',
    message: '{key} is {value}, which cannot be exported: {reason}',
    cause:
      'Two options that contradict each other, such as a kit, whose rocks share meshes, in a format that has no objects, or textures in one that has none.',
    remedy: 'The message names what fits. `exportSchema` of `rock-field/export` lists all options.',
  },
  ExportTooLarge: {
    group: 'export',
    message:
      'the file would be about {value} MB; it may be at most {max} MB: choose mesh "kit", or parts 3, or a smaller image or less detail',
    cause:
      'More rocks or triangles than fit into a file of 2 GB, a map that takes more than 1.5 GiB of memory, or more rocks than have room in textures of this size.',
    remedy:
      'Export a kit, in which rocks share meshes and only its kinds are in the textures, or several files (`parts`); the message names how many fit. Of a map, the message names the `side` that fits; of textures, larger ones have more room.',
  },

  ImportForeign: {
    group: 'import',
    message: '{file} brings no scene back: it was not made here, or what it said of its scene was taken out of it',
    cause:
      'A picture, model or archive of another program, or one that has lost the text with its link: chat programs, web sites and the clipboard drop it from pictures.',
    remedy: 'Take the file as it was saved, or the link itself.',
  },
  ImportBroken: {
    group: 'import',
    message: '{file} is damaged: the scene in it cannot be read',
    cause: 'A file that was cut short or changed, or one that has been moved since it was chosen.',
    remedy: 'Save or download it again.',
  },
  ImportOther: {
    group: 'import',
    message: '{file} shows a scene of another kind',
    cause: 'A file of wood ears that is opened as rocks, or the other way round; or one of a preset that this version does not have.',
    remedy: 'Pass it to `importFile()` of the other element, or drop it on the other page.',
  },

  NotConnected: {
    group: 'element',
    message: 'put the element into the document first',
    cause: '`generate()`, `getField()` and the like of an element that stands in no document.',
    remedy: 'Append the element, or use `rock-field/core`, which needs no document.',
  },
  NoPicture: {
    group: 'element',
    message: 'there is no picture',
    cause: '`toBlob()` of an element that has no renderer or no size, or a browser that makes no file of the type asked for.',
    remedy: 'Wait for `ready`, give the element a size, and ask for `image/png`.',
  },

  NoRenderer: {
    group: 'graphics',
    message: 'The rocks cannot be drawn here. {reasons}',
    cause:
      'Neither WebGPU nor WebGL2 nor a 2D canvas could be opened, or the renderer’s file did not arrive. The message says why for each.',
    remedy:
      'Check the connection, then press the button that tries again. Switch hardware acceleration on, and update browser and graphics driver.',
  },
  RendererFailed: {
    group: 'graphics',
    message: 'the picture could not be made: {reason}',
    cause: 'The renderer refused this field, mostly because a buffer of it is larger than the graphics device takes.',
    remedy: 'Make the image smaller or the radii larger. The old picture stays until then.',
  },
  DeviceLost: {
    group: 'graphics',
    message: 'the graphics device was lost {n} times: {reason}',
    cause:
      'The browser or the driver took the graphics device away, and gave none back at once, or took it several times in a row; a plan without 3D is shown.',
    remedy:
      'Wait: 3D is tried again from time to time, when the page is seen again, and by the button. It may help to close other pages that use the GPU.',
  },
  NoAdapter: {
    group: 'graphics',
    message: 'no graphics adapter: {reason}',
    cause: 'The browser offers WebGPU or WebGL2, but no graphics device for it. Part of the message of `NoRenderer`.',
    remedy: 'Switch hardware acceleration on, and update the graphics driver.',
  },
  NoDevice: {
    group: 'graphics',
    message: 'the graphics adapter refused a device: {reason}',
    cause: 'The graphics device is busy, or too small. Part of the message of `NoRenderer`.',
    remedy: 'Close other pages that use the GPU, then reload.',
  },
  NoSurface: {
    group: 'graphics',
    message: 'the canvas cannot be drawn to: {reason}',
    cause: 'The canvas was lost or taken by another context. `toBlob()` rejects with it; elsewhere it is part of `RendererFailed`.',
    remedy: 'Try again once the picture is back.',
  },
  FieldTooLarge: {
    group: 'graphics',
    message:
      'the {buffer} of this field need {value} bytes in one buffer, this graphics device takes {max}: make the image smaller or the discs larger',
    cause:
      'A field with so many triangles that one of its buffers does not fit this graphics device. Part of the message of `RendererFailed`.',
    remedy: 'Make the image smaller or the radii larger.',
  },
  MalformedField: {
    group: 'internal',
    message: 'the field is malformed: {reason}',
    cause: 'The buffers of a result contradict each other. Part of the message of `RendererFailed`.',
    remedy: 'Please report it with the link.',
  },

  ThreeUnsuitable: {
    group: 'loading',
    message: 'three.js is r{value}; rock-field/three needs r169 or newer',
    cause:
      'An older revision of three.js, whose `BatchedMesh` cannot do what is needed. `build()` rejects with it before anything is made.',
    remedy: 'Install a newer `three`. `npm ls three` says which one a project has, and who asked for it.',
  },
  WasmUnavailable: {
    group: 'loading',
    message: 'the generator could not be loaded: {reason}',
    cause:
      'The `.wasm` file did not arrive, stopped arriving for 10 s, arrived damaged, or a policy forbids compiling it. The next run tries again.',
    remedy:
      'Look at the browser’s network panel; allow `wasm-unsafe-eval`: see [strict policies](recipes.html#under-a-strict-content-security-policy).',
  },
  ScriptUnavailable: {
    group: 'loading',
    message: 'a script could not be fetched',
    cause:
      'A part that is loaded when it is wanted is not on the server any more, since a newer version was put there while the page was open; or there is no network.',
    remedy:
      'Reload the page. On your own server, keep the files of the last version for a while: see [your own server](recipes.html#on-a-server-of-your-own).',
  },
  WorkerUnavailable: {
    group: 'loading',
    message: 'the generator’s worker could not be started',
    cause:
      'The worker’s file is missing on the server, does not arrive, or does nothing; or a policy forbids workers. The next run tries again.',
    remedy:
      'Serve all files of the package together, and allow `worker-src`: see [strict policies](recipes.html#under-a-strict-content-security-policy).',
  },

  WorkerLost: {
    group: 'internal',
    message: 'the generator stopped without an answer, twice; try smaller settings',
    cause: 'The worker ended twice while it worked on the same request, mostly for want of memory. Another worker has taken its place.',
    remedy: 'Try smaller settings. If those fail too, please report it with the link.',
  },
  Internal: {
    group: 'internal',
    message: 'the generator failed ({reason}); please report this with its link',
    cause: 'A fault of ours; the worker has been replaced, and the next run starts afresh.',
    remedy: 'Please report it with the link.',
  },
});

/** A name of the list. */
export type ErrorName = keyof typeof ERRORS;
