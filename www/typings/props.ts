/** What can be written on the element in a template: attributes and properties by name, and listeners as each framework spells them. */

import type { Backend, RockFieldElement, RockFieldEventMap } from '../element.ts';
import type { ParameterProperties } from '../parameter-properties.ts';
import type { ReflectedProperties } from '../reflected-properties.ts';

type Parameters = { [Name in keyof ParameterProperties]: ParameterProperties[Name] | Text<ParameterProperties[Name]> };
type Reflected = { [Name in keyof ReflectedProperties]: Exclude<ReflectedProperties[Name], ''> };
type Others = Pick<RockFieldElement, 'params' | 'layers' | 'view' | 'color' | 'quality' | 'interaction' | 'cameraOrbit' | 'metresPerPixel' | 'theme'> & {
  camera: RockFieldElement['camera'] | null;
  /** Read when the element is connected; `null` draws nothing. */
  backend: 'auto' | Backend;
  /** A button that opens the panel; `open`: it begins open. */
  controls: boolean | 'open';
};

/** What an attribute says in the place of the property's value: a word, a number, or a list as `90 30 10`. */
type Text<Value> = Value extends string | boolean ? Value : Value extends number ? `${number}` : string;

/** `image-width` */
type Kebab<Name extends string> = Name extends `${infer First}${infer Rest}` ? `${First extends Lowercase<First> ? First : `-${Lowercase<First>}`}${Kebab<Rest>}` : '';

/** Properties whose attribute has another name. */
type Renamed = ParameterProperties & Pick<ReflectedProperties, 'autoRotate'> & Pick<RockFieldElement, 'cameraOrbit' | 'metresPerPixel'>;
type Attributes = {
  [Name in keyof Renamed as Kebab<Name> extends Name ? never : Kebab<Name>]: Text<Renamed[Name]> | Extract<Renamed[Name], number>;
};

type Optional<Props> = { [Name in keyof Props]?: Props[Name] | undefined };

export type RockFieldProps = Optional<Parameters & Reflected & Others & Attributes>;

/** `ongenerate`, `oncamera-change`, …: React 19 and Svelte 5 listen to whatever follows the `on`. */
export type RockFieldListeners = {
  [Type in keyof RockFieldEventMap as `on${Type}`]?: ((event: RockFieldEventMap[Type]) => void) | undefined;
};
