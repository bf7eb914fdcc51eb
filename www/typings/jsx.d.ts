/** `rock-field/jsx`: `<rock-field>` in the JSX of React 19. */

import type { HTMLAttributes, RefAttributes } from 'react';
import type { RockFieldElement } from '../element.ts';
import type { RockFieldListeners, RockFieldProps } from './props.ts';

declare module 'react' {
  namespace JSX {
    interface IntrinsicElements {
      'rock-field': Omit<HTMLAttributes<RockFieldElement>, keyof RockFieldProps> & RefAttributes<RockFieldElement> & RockFieldProps & RockFieldListeners;
    }
  }
}
