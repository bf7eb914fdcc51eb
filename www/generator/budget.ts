/** How much memory a field may need at its peak when the caller does not say. */

const GIB = 2 ** 30;

/** 1.5 GiB; 512 MiB on devices that report 4 GB or less. */
export function defaultMaxBytes(): number {
  const gigabytes = (globalThis.navigator as { deviceMemory?: number } | undefined)?.deviceMemory;
  return gigabytes !== undefined && gigabytes <= 4 ? GIB / 2 : GIB * 1.5;
}
