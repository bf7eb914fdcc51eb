/** Whether the system asks for less motion. */
export function prefersStillness(view: Window): boolean {
  return view.matchMedia('(prefers-reduced-motion: reduce)').matches;
}
