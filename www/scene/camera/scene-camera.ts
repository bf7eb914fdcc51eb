/** Where the eye is: moved by the user, flying, turning by itself, or framing the whole field, whatever its size. */

import type { AutoRotation } from './auto-rotation.ts';
import type { CameraFlight } from './flight.ts';
import { METRES_PER_PIXEL, orbitCamera, turnCamera } from './orbit.ts';
import type { Orbit } from './orbit.ts';
import { boxCamera, defaultCamera } from './camera.ts';
import type { Subject } from './camera.ts';
import { FOV } from '../../base/fov.ts';
import type { CameraState } from '../../base/view.ts';

/** What is framed, and through what. */
export interface Frame {
  /** Width and height of the ground, px. */
  extent: [number, number];
  aspect: number;
  /** Seen from straight above, whatever the camera's angles. */
  plan: boolean;
  /** Fill the picture with ground. */
  closeUp: boolean;
  /** What is framed instead of all of the ground. */
  subject: Subject | null;
  /** Of the highest rock, px. */
  height: () => number;
}

/** Share of the picture that the whole field takes. */
const WHOLE_ROOM = 0.9;

export class SceneCamera {
  /** Null while the field is framed, whatever its size. */
  #camera: CameraState | null = null;
  /** From where all of the field is shown, with a margin; null: as the default camera frames it. */
  #whole: Pick<CameraState, 'azimuth' | 'elevation'> | null = null;
  /** How the default camera framed the field before another colour was chosen, which must not move it. */
  #heldCloseUp: boolean | undefined;
  #flight: CameraFlight | undefined;
  /** What the framing is when the page asks for another than ours. */
  #orbit: Orbit | null = null;
  metresPerPixel = METRES_PER_PIXEL;
  /** Of cameras that have none of their own, degrees. */
  #fov = FOV;
  /** What turns it by itself, once there are hands that could stop it. */
  rotation: AutoRotation | undefined;
  #frame: () => Frame;

  constructor(frame: () => Frame) {
    this.#frame = frame;
  }

  get current(): CameraState {
    return this.forAspect();
  }

  set current(camera: CameraState | null) {
    this.#flight = undefined;
    if (this.rotation) this.rotation.angle = 0;
    this.#whole = null;
    this.#heldCloseUp = undefined;
    this.#camera = camera && structuredClone(camera);
  }

  /** The default camera, for the present aspect or another. */
  framing(aspect = this.#frame().aspect, closeUp = this.#frame().closeUp, plan = this.#frame().plan): CameraState {
    const { extent, subject } = this.#frame();
    const camera = subject ? subject.camera(aspect, plan, this.#fov) : defaultCamera(...extent, aspect, plan, closeUp, this.#fov);
    if (!this.#orbit) return camera;
    const orbited = orbitCamera(camera, this.#orbit, this.#centre(), this.metresPerPixel);
    return subject ? { ...orbited, target: camera.target } : orbited;
  }

  /** As `current`, for a picture of another aspect. */
  forAspect(aspect?: number): CameraState {
    return this.#at(this.#camera ?? this.#framed(aspect));
  }

  /** What is shown while nobody has moved the camera. */
  #framed(aspect = this.#frame().aspect): CameraState {
    const {
      extent: [width, height],
      plan,
      subject,
      height: rocks,
    } = this.#frame();
    // Plans are framed whole as they are.
    if (!this.#whole || plan) return this.framing(aspect, this.#heldCloseUp);
    const high = Math.max(rocks(), subject?.high[2] ?? 0);
    return boxCamera({ low: [0, 0, 0], high: [width, height, high] }, aspect, { ...this.#whole, fov: this.#fov }, WHOLE_ROOM);
  }

  get fov(): number {
    return this.current.fov ?? this.#fov;
  }

  /** Of every camera that does not say it; the present one does not from now on. */
  set fov(degrees: number) {
    this.#fov = degrees;
    if (this.#camera) this.#camera.fov = undefined;
  }

  /** Whether the camera is the default one, which no link has to tell. */
  get isDefault(): boolean {
    const { closeUp } = this.#frame();
    return this.framed && !this.#whole && (this.#heldCloseUp ?? closeUp) === closeUp && this.#fov === FOV;
  }

  /** The colour is about to change: what frames the field stays where it is until `release`. */
  hold(): void {
    if (this.isDefault) this.#heldCloseUp = this.#frame().closeUp;
  }

  release(): void {
    this.#heldCloseUp = undefined;
  }

  /** Whether the field is framed, that is, nobody has moved the camera since. */
  get framed(): boolean {
    return this.#camera === null || this.#flight !== undefined;
  }

  setFraming(orbit: Orbit | null, metresPerPixel: number): void {
    this.#orbit = orbit;
    this.metresPerPixel = metresPerPixel;
  }

  /**
   * Frames all of the field with a margin, seen as now; where that is so already, as the default camera does. With `fly` it is on its way
   * there first. Returns where it will be.
   */
  frameAll(fly?: (from: CameraState, to: CameraState) => CameraFlight): CameraState {
    const from = this.current;
    const whole = this.framed && this.#whole ? null : { azimuth: from.azimuth, elevation: from.elevation };
    this.current = null;
    if (!this.#frame().plan) this.#whole = whole;
    const to = this.#framed();
    this.#flight = fly?.(from, to);
    return to;
  }

  stay(): void {
    this.#flight = undefined;
  }

  /** On to the frame at `now`. True while there is more to come. */
  advance(now: number, rotates: boolean): boolean {
    if (this.#flight) {
      this.#camera = this.#flight.at(now);
      if (!this.#camera) this.#flight = undefined;
    }
    const turns = rotates && !this.#flight && !this.#frame().plan && this.rotation !== undefined;
    if (turns) this.rotation?.advance(now);
    else this.rotation?.rest();
    return this.#flight !== undefined || turns;
  }

  #at(camera: CameraState): CameraState {
    const { angle = 0 } = this.rotation ?? {};
    const seen = { ...structuredClone(camera), fov: camera.fov ?? this.#fov };
    return angle === 0 ? seen : turnCamera(seen, this.#centre(), angle);
  }

  #centre(): [number, number] {
    const {
      extent: [width, height],
      subject,
    } = this.#frame();
    return subject ? [(subject.low[0] + subject.high[0]) / 2, (subject.low[1] + subject.high[1]) / 2] : [width / 2, height / 2];
  }
}
