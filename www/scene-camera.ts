/** Where the eye is: moved by the user, flying, turning by itself, or framing the whole field, whatever its size. */

import { AutoRotation } from './auto-rotation.ts';
import { CameraFlight } from './camera-flight.ts';
import { METRES_PER_PIXEL, orbitCamera, turnCamera } from './camera-orbit.ts';
import type { Orbit } from './camera-orbit.ts';
import { defaultCamera, isPlan, subjectCamera } from './camera.ts';
import type { Subject } from './camera.ts';
import type { CameraState, View } from './renderer/renderer.ts';

/** What is framed, and through what. */
export interface Frame {
  /** Width and height of the ground, px. */
  extent: [number, number];
  aspect: number;
  view: View;
  /** Fill the picture with ground. */
  closeUp: boolean;
  /** What is framed instead of all of the ground. */
  subject: Subject | null;
}

export class SceneCamera {
  /** Null while the whole field is framed, whatever its size. */
  #camera: CameraState | null = null;
  #flight: CameraFlight | undefined;
  /** What the framing is when the page asks for another than ours. */
  #orbit: Orbit | null = null;
  #metresPerPixel = METRES_PER_PIXEL;
  #rotation = new AutoRotation();
  #frame: () => Frame;

  constructor(frame: () => Frame) {
    this.#frame = frame;
  }

  get current(): CameraState {
    return this.#at(this.#camera ?? this.framing());
  }

  set current(camera: CameraState | null) {
    this.#flight = undefined;
    this.#rotation.angle = 0;
    this.#camera = camera && structuredClone(camera);
  }

  /** The camera that frames the whole field, for the present aspect or another. */
  framing(aspect = this.#frame().aspect): CameraState {
    const { extent, view, closeUp, subject } = this.#frame();
    const camera = subject ? subjectCamera(subject, aspect) : defaultCamera(...extent, aspect, view, closeUp);
    if (!this.#orbit) return camera;
    const orbited = orbitCamera(camera, this.#orbit, this.#centre(), this.#metresPerPixel);
    return subject ? { ...orbited, target: camera.target } : orbited;
  }

  /** As `current`, for a picture of another aspect. */
  forAspect(aspect: number): CameraState {
    return this.#at(this.#camera ?? this.framing(aspect));
  }

  /** Whether the whole field is framed, that is, nobody has moved the camera since. */
  get framed(): boolean {
    return this.#camera === null || this.#flight !== undefined;
  }

  setFraming(orbit: Orbit | null, metresPerPixel: number): void {
    this.#orbit = orbit;
    this.#metresPerPixel = metresPerPixel;
  }

  /** Sets off for the framing of the whole field. */
  flyHome(now: number): void {
    this.#flight = new CameraFlight(this.current, this.framing(), now);
    this.#rotation.angle = 0;
  }

  stay(): void {
    this.#flight = undefined;
  }

  /** The user has moved: what turns by itself waits. */
  pauseRotation(now: number): void {
    this.#rotation.pause(now);
  }

  /** On to the frame at `now`. True while there is more to come. */
  advance(now: number, rotates: boolean): boolean {
    if (this.#flight) {
      this.#camera = this.#flight.at(now);
      if (!this.#camera) this.#flight = undefined;
    }
    const turns = rotates && !this.#flight && !isPlan(this.#frame().view);
    if (turns) this.#rotation.advance(now);
    else this.#rotation.rest();
    return this.#flight !== undefined || turns;
  }

  #at(camera: CameraState): CameraState {
    const { angle } = this.#rotation;
    return angle === 0 ? structuredClone(camera) : turnCamera(camera, this.#centre(), angle);
  }

  #centre(): [number, number] {
    const { extent: [width, height], subject } = this.#frame();
    return subject ? [(subject.low[0] + subject.high[0]) / 2, (subject.low[1] + subject.high[1]) / 2] : [width / 2, height / 2];
  }
}
