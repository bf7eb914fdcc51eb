/** `rock-field/vue`: `<rock-field>` in the templates of Vue 3. */

import type { EmitFn, HTMLAttributes, PublicProps } from 'vue';
import type { RockFieldElement, RockFieldEventMap } from '../element.ts';
import type { RockFieldProps } from './props.ts';

type Listened = { [Type in keyof RockFieldEventMap]: (event: RockFieldEventMap[Type]) => void };

declare module 'vue' {
  interface GlobalComponents {
    'rock-field': new () => RockFieldElement & { $props: Omit<HTMLAttributes, keyof RockFieldProps> & RockFieldProps & PublicProps; $emit: EmitFn<Listened> };
  }
}
