/** What can be written on the elements in a template: attributes and properties by name, and listeners as each framework spells them. */

import type { Backend, RockFieldElement, RockFieldEventMap } from '../entries/element.ts';
import type { ParameterProperties, PresetName } from '../rocks/params.ts';
import type { ReflectedProperties } from '../element/reflected-properties.ts';
import type { WoodEarPresetName, WoodEarProperties } from '../wood-ear/request.ts';
import type { WoodEarLogElement, WoodEarLogEventMap } from '../entries/wood-ear-log.ts';

type Parameters<Properties> = { [Name in keyof Properties]: Properties[Name] | Text<Properties[Name]> };
type Reflected<Preset extends string> = { [Name in keyof ReflectedProperties<Preset>]: Exclude<ReflectedProperties<Preset>[Name], ''> };
type SceneProperty =
  | 'params'
  | 'view'
  | 'color'
  | 'quality'
  | 'samples'
  | 'interaction'
  | 'navigation'
  | 'cameraOrbit'
  | 'metresPerPixel'
  | 'theme';

/** Whatever both elements have. */
interface Shared {
  camera: RockFieldElement['camera'] | null;
  /** Vertical, degrees. */
  fov: number | `${number}`;
  /** Read when the element is connected; `null` draws nothing. */
  backend: 'auto' | Backend;
  /** A button that opens the panel; `open`: it begins open. */
  controls: boolean | 'open';
}

/** What an attribute says in the place of the property's value: a word, a number, or a list as `90 30 10`. */
type Text<Value> = Value extends string | boolean ? Value : Value extends number ? `${number}` : string;

/** `image-width` */
type Kebab<Name extends string> = Name extends `${infer First}${infer Rest}`
  ? `${First extends Lowercase<First> ? First : `-${Lowercase<First>}`}${Kebab<Rest>}`
  : '';

/** Properties whose attribute has another name. */
type Renamed<Properties> = Properties &
  Pick<ReflectedProperties<string>, 'autoRotate'> &
  Pick<RockFieldElement, 'cameraOrbit' | 'metresPerPixel'>;
type Attributes<Properties> = {
  [Name in keyof Properties & string as Kebab<Name> extends Name ? never : Kebab<Name>]:
    | Text<Properties[Name]>
    | Extract<Properties[Name], number>;
};

type Optional<Props> = { [Name in keyof Props]?: Props[Name] | undefined };

export type RockFieldProps = Optional<
  Parameters<ParameterProperties> &
    Reflected<PresetName> &
    Pick<RockFieldElement, SceneProperty | 'layers'> &
    Shared &
    Attributes<Renamed<ParameterProperties>>
>;

export type WoodEarLogProps = Optional<
  Parameters<WoodEarProperties> &
    Reflected<WoodEarPresetName> &
    Pick<WoodEarLogElement, SceneProperty | 'editable'> &
    Shared &
    Attributes<Renamed<WoodEarProperties>> & { bases: WoodEarLogElement['bases'] | string; ground: string }
>;

/** `ongenerate`, `oncamera-change`, …: React 19 and Svelte 5 listen to whatever follows the `on`. */
type Listeners<EventMap> = { [Type in keyof EventMap & string as `on${Type}`]?: ((event: EventMap[Type]) => void) | undefined };

export type RockFieldListeners = Listeners<RockFieldEventMap>;
export type WoodEarLogListeners = Listeners<WoodEarLogEventMap>;
