/** What is fetched beside the renderer, for the case that it is slow, does not arrive, or is lost where no network is: one file, which is smaller than three. */

export { Canvas2dRenderer } from '../renderer/canvas2d.ts';
export { Recovery } from '../renderer/recovery.ts';
export { standIn } from './stand-in.ts';
