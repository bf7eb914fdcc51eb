/** `rock-field/vue`: `<rock-field>` and `<wood-ear-log>` in the templates of Vue 3. */

import type { EmitFn, HTMLAttributes, PublicProps } from 'vue';
import type { RockFieldElement, RockFieldEventMap } from '../entries/element.ts';
import type { WoodEarLogElement, WoodEarLogEventMap } from '../entries/wood-ear-log.ts';
import type { RockFieldProps, WoodEarLogProps } from './props.ts';

type Listened<EventMap> = { [Type in keyof EventMap]: (event: EventMap[Type]) => void };

declare module 'vue' {
  interface GlobalComponents {
    'rock-field': new () => RockFieldElement & {
      $props: Omit<HTMLAttributes, keyof RockFieldProps> & RockFieldProps & PublicProps;
      $emit: EmitFn<Listened<RockFieldEventMap>>;
    };
    'wood-ear-log': new () => WoodEarLogElement & {
      $props: Omit<HTMLAttributes, keyof WoodEarLogProps> & WoodEarLogProps & PublicProps;
      $emit: EmitFn<Listened<WoodEarLogEventMap>>;
    };
  }
}
