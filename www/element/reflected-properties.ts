/** Properties that are their attributes and nothing else. Frameworks assign a property where there is one; only so is `false` no text. */

import type { Loading } from '../base/view.ts';
import { wrongType } from '../table/param-checks.ts';

export interface ReflectedProperties<Preset extends string> {
  src: string;
  preset: Preset | '';
  loading: Loading | '';
  poster: string;
  disabled: boolean;
  autoRotate: boolean;
}

const TEXTS: readonly (keyof ReflectedProperties<string>)[] = ['src', 'preset', 'loading', 'poster'];
const FLAGS: Readonly<Partial<Record<keyof ReflectedProperties<string>, string>>> = { disabled: 'disabled', autoRotate: 'auto-rotate' };

export const REFLECTED_PROPERTIES: readonly string[] = [...TEXTS, ...Object.keys(FLAGS)];

export function defineReflectedProperties(prototype: HTMLElement): void {
  for (const name of TEXTS) {
    define(prototype, name, {
      get(this: HTMLElement) {
        return this.getAttribute(name) ?? '';
      },
      set(this: HTMLElement, value: unknown) {
        writeAttribute(this, name, value);
      },
    });
  }
  for (const [name, attribute] of Object.entries(FLAGS)) {
    define(prototype, name, {
      get(this: HTMLElement) {
        return this.hasAttribute(attribute);
      },
      set(this: HTMLElement, value: unknown) {
        this.toggleAttribute(attribute, Boolean(value));
      },
    });
  }
}

/**
 * Nothing, be it `undefined`, takes the attribute away.
 *
 * @throws {RockFieldError} for what is no text and has no way to become one.
 */
export function writeAttribute(element: HTMLElement, name: string, value: unknown): void {
  let text: string;
  try {
    text = String(value ?? '');
  } catch {
    throw wrongType(name, value, 'text');
  }
  if (text === '') element.removeAttribute(name);
  else element.setAttribute(name, text);
}

function define(prototype: HTMLElement, name: string, accessors: PropertyDescriptor): void {
  Object.defineProperty(prototype, name, { configurable: true, enumerable: true, ...accessors });
}
