/** What every element of a generator shares beside its parameters and attributes: share links, random draws, the panel, words for its result. */

import type { CameraState } from '../base/view.ts';
import { CAN_SHOW } from '../base/document-styles.ts';
import { errorInfo } from '../base/errors.ts';
import type { ErrorDetail } from '../base/error-pace.ts';
import { lazily } from '../base/lazy.ts';
import type { ExportOptions } from '../export/options.ts';
import type { TaskOptions } from '../generator/one-task.ts';
import type { PictureSource } from '../scene/picture.ts';
import type { Progress } from '../generator/protocol.ts';
import type { Kind } from '../table/table.ts';
import { AttributesElement } from './attributes-element.ts';
import type { ControlsButton } from './controls-button.ts';
import type { Definition } from './definition.ts';

/** The events, by name, with their details. None bubbles; all are composed. */
export interface ElementEventMap<Stage extends string> {
  /** The first picture of a cycle has been painted. */
  load: CustomEvent<null>;
  /** A run of more than 200 ms is under way. */
  progress: CustomEvent<Progress<Stage>>;
  /** Something went wrong; at most one a second. `shown`: the element says so itself, over its picture. */
  error: CustomEvent<ErrorDetail>;
  /** The user moved the camera, or asked for everything. */
  'camera-change': CustomEvent<{ camera: CameraState; framed: boolean }>;
  /** The picture is back after a loss of the device. */
  restored: CustomEvent<null>;
  /** An attribute could not be taken as it stood. */
  notice: CustomEvent<{ message: string }>;
}

/**
 * @attribute src - A share link or its fragment, or parameters as JSON; fills everything.
 * @attribute quality - `low`, `medium` or `high`, of natural colours; `auto`: as well as motion flows, and `high` at rest. Slow devices draw fewer pixels in motion.
 * @attribute samples - How many samples of light a picture in natural colours is refined with at rest, 0 … 4096; default 64. Only at `high` and `auto`.
 * @attribute theme - `light`, `dark`, or `auto`: as the system is set.
 * @attribute camera-orbit - Azimuth, angle from above, distance: `45deg 55deg 120%`, each of them perhaps `auto`.
 * @attribute fov - Vertical field of view in degrees, 5 … 120; default 36.
 * @attribute interaction - `cooperative` (the page scrolls through it), `always` or `none`.
 * @attribute navigation - `orbit`, or `walk`: at eye height on the ground, with W A S D, the arrow keys, drags and two fingers, until Escape.
 * @attribute loading - `eager`, or `lazy`: nothing is loaded before the element comes near the screen.
 * @attribute metres-per-pixel - Size of a pixel of the image; default 0.01.
 * @attribute controls - A button in the picture's corner opens a panel with everything that can be set; `open`: it begins open.
 * @attribute backend - `auto`, `webgpu`, `webgl`, `canvas2d` or `null` (draws nothing); read when the element is connected.
 * @csspart hint - Why a gesture did nothing, for a moment.
 * @csspart controls-button - The button that opens the panel.
 * @csspart panel - The panel, while it is open.
 * @fires load - The first picture has been painted.
 * @fires progress - A run of more than 200 ms is under way.
 * @fires error - What went wrong, as data.
 * @fires camera-change - The user moved the camera, or asked for everything.
 * @fires restored - The picture is back after a loss of the device.
 * @fires notice - An attribute could not be taken as it stood. `preventDefault()` keeps the message off the picture.
 */
export abstract class GeneratorElement<K extends Kind> extends AttributesElement<K> {
  readonly #definition: Definition<K, GeneratorElement<K>>;
  #controls: ControlsButton<K, GeneratorElement<K>> | undefined;

  constructor(definition: Definition<K, GeneratorElement<K>>) {
    super(definition);
    this.#definition = definition;
  }

  /**
   * A link to what is shown: `base`, the page's own address by default, with the parameters as its fragment. Parameters that are
   * still to be made are not in it; wait for `generate()` first if they should be.
   */
  shareURL(base: string = addressOf(this.ownerDocument)): string {
    const url = new URL(base, this.ownerDocument.baseURI);
    const { params, preset } = this.history.settled;
    url.hash = this.#definition.encode({ params, preset, ...this.seenSettled });
    return url.href;
  }

  /**
   * Shows the scene of a file that was made here, a PNG picture, a glTF model, an archive with one of them, or parameters as JSON: as one
   * step of `undo`. Resolves when it is on screen.
   *
   * @throws {RockFieldError} `ImportForeign`, `ImportBroken` or `ImportOther` where the file brings none, and nothing has changed; `NotConnected`; what `generate()` rejects with.
   */
  async importFile(file: Blob): Promise<void> {
    const { importFile } = await lazily(() => import('./import-file.ts'));
    const scene = await importFile(this.#definition, this, file);
    // A step of its own, however soon it comes after another edit.
    this.hold(true);
    this.showLink(scene);
    this.hold(false);
    for (const { text } of scene.notices) this.notify(text);
    this.start();
    await this.newest();
  }

  protected override get pictureSource(): PictureSource {
    const { onScreen, seenSettled, result, metresPerPixel } = this;
    return { definition: this.#definition, settled: this.history.settled, onScreen, seenSettled, result, metresPerPixel };
  }

  /**
   * What is shown as a file, as soon as it is finished; written in a worker. It needs no picture.
   *
   * @param options what to write; `metresPerPixel` and `color` are the element's, unless given.
   */
  async exportFile(options: ExportOptions = {}, run: TaskOptions = {}): Promise<File> {
    const exportInWorker = await lazily(() => this.#definition.loadExporter());
    const newest = async () => ({ result: await this.newest(), params: this.params, preset: this.presetInUse });
    const shown = { color: this.color, backend: this.getAttribute('backend') };
    const { file } = await exportInWorker(newest, { metresPerPixel: this.metresPerPixel, ...options }, run, shown);
    return file;
  }

  /**
   * Another of the kind by lot, of parameters by lot. Properties named in `lock` keep their values.
   *
   * @throws {RockFieldError} `UnknownKey` for a name in `lock` that is no parameter.
   */
  async randomize({ lock = [] }: { lock?: readonly string[] } = {}): Promise<void> {
    const { lockedDraw } = await lazily(() => import('./locked-draw.ts'));
    const params = await lockedDraw(this.#definition, this.params, () => this.freshSeed(), { preset: this.presetInUse, lock });
    this.hold(true);
    this.params = params;
    this.hold(false);
  }

  // Words for the result.

  protected override async describeResult(result: K['result']): Promise<void> {
    try {
      const words = await this.#definition.describe(result, this.metresPerPixel, this.language);
      if (this.result === result) this.describe(words);
    } catch (thrown) {
      // Without these words the picture is still a picture.
      console.warn(thrown);
    }
  }

  protected override relabel(): void {
    super.relabel();
    this.changed();
    if (this.result) void this.describeResult(this.result);
  }

  // The panel.

  /** Whether there is a button for the panel; assigning `open` opens it. */
  get controls(): boolean {
    return this.hasAttribute('controls');
  }

  set controls(controls: boolean | 'open') {
    if (controls === 'open') this.setAttribute('controls', controls);
    else this.toggleAttribute('controls', Boolean(controls));
  }

  protected override opened(): void {
    super.opened();
    this.#controls?.begin();
  }

  protected override closed(): void {
    this.#controls?.close();
    super.closed();
  }

  protected override changed(): void {
    this.#controls?.sync();
  }

  protected override readManners(): void {
    super.readManners();
    if (this.controls && !this.#controls && CAN_SHOW) void this.#loadControls();
    this.#controls?.update();
  }

  /** Few elements have a panel: for the others nothing of it is fetched. */
  async #loadControls(): Promise<void> {
    try {
      const { ControlsButton } = await lazily(() => import('./controls-button.ts'));
      this.#controls ??= this.#newControls(ControlsButton);
      this.#controls.update();
    } catch (thrown) {
      this.report(errorInfo(thrown));
    }
  }

  #newControls(Button: typeof ControlsButton): ControlsButton<K, GeneratorElement<K>> {
    return new Button<K, GeneratorElement<K>>({
      element: this,
      root: this.shadowRoot as ShadowRoot,
      language: () => this.language,
      isOpen: () => this.canRun,
      isSettled: () => this.isUpToDate,
      chosenColor: () => this.chosenColor,
      history: () => this.history,
      result: () => this.result,
      random: this.#definition.random,
      loadPanel: this.#definition.loadPanel,
      say: (text) => this.notify(text),
    });
  }
}

/** A document's own address, whatever its `<base>` says; one that was written into a frame has that of the page around it. */
function addressOf({ URL: address, baseURI }: Document): string {
  return address.startsWith('about:') ? baseURI : address;
}
