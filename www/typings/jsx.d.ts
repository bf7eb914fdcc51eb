/** `rock-field/jsx`: `<rock-field>` and `<wood-ear-log>` in the JSX of React 19. */

import type { HTMLAttributes, RefAttributes } from 'react';
import type { RockFieldElement } from '../entries/element.ts';
import type { WoodEarLogElement } from '../entries/wood-ear-log.ts';
import type { RockFieldListeners, RockFieldProps, WoodEarLogListeners, WoodEarLogProps } from './props.ts';

declare module 'react' {
  namespace JSX {
    interface IntrinsicElements {
      'rock-field': Omit<HTMLAttributes<RockFieldElement>, keyof RockFieldProps> &
        RefAttributes<RockFieldElement> &
        RockFieldProps &
        RockFieldListeners;
      'wood-ear-log': Omit<HTMLAttributes<WoodEarLogElement>, keyof WoodEarLogProps | keyof WoodEarLogListeners> &
        RefAttributes<WoodEarLogElement> &
        WoodEarLogProps &
        WoodEarLogListeners;
    }
  }
}
