/** Draws nothing and records every call, for tests that have no graphics. */

import type { Field } from '../data/field.ts';
import type { CameraState, Quality } from '../base/view.ts';
import type { Look } from '../data/look.ts';
import type { SceneRenderer, SceneStyle, Wood } from './renderer.ts';

export type RecordedCall =
  | { name: 'setField'; rocks: number }
  | { name: 'setWood'; individuals: number | null }
  | { name: 'setStyle'; style: SceneStyle }
  | { name: 'setLook'; look: Look }
  | { name: 'setQuality'; level: Quality }
  | { name: 'setCamera'; camera: CameraState }
  | { name: 'resize'; width: number; height: number }
  | { name: 'render' }
  | { name: 'dispose' };

export class NullRenderer implements SceneRenderer {
  readonly backend = 'null';
  readonly canvas: HTMLCanvasElement;
  readonly isLost = false;
  readonly lost: Promise<string>;
  /** In the order made. */
  readonly calls: RecordedCall[] = [];
  /** Pretends a loss. */
  readonly lose: (reason: string) => void;

  constructor(canvas: HTMLCanvasElement) {
    this.canvas = canvas;
    let lose: (reason: string) => void = () => {};
    this.lost = new Promise((resolve) => {
      lose = resolve;
    });
    this.lose = lose;
  }

  setField(field: Field): void {
    this.calls.push({ name: 'setField', rocks: field.rockLayer.length });
  }

  setWood(wood: Wood | null): void {
    this.calls.push({ name: 'setWood', individuals: wood?.colony.stats.individuals ?? null });
  }

  setStyle(style: SceneStyle): void {
    this.calls.push({ name: 'setStyle', style: { ...style } });
  }

  setLook(look: Look): void {
    this.calls.push({ name: 'setLook', look: structuredClone(look) });
  }

  setQuality(level: Quality): void {
    this.calls.push({ name: 'setQuality', level });
  }

  setCamera(camera: CameraState): void {
    this.calls.push({ name: 'setCamera', camera: { ...camera, target: [...camera.target] } });
  }

  resize(width: number, height: number): void {
    this.calls.push({ name: 'resize', width, height });
    [this.canvas.width, this.canvas.height] = [width, height];
  }

  render(): void {
    this.calls.push({ name: 'render' });
  }

  dispose(): void {
    this.calls.push({ name: 'dispose' });
  }
}
