// What the types have to refuse; a line that they let pass is an error of its own.
import type { Group, Intersection } from 'three';
import { RockField, RockFieldError } from 'rock-field/three';
import type { FoundRock, RockFieldOptions } from 'rock-field/three';

export const wrong = [
  // @ts-expect-error no such preset
  () => new RockField({ preset: 'river bed' }),
  // @ts-expect-error not a number
  () => new RockField({ seed: 'seven' }),
  // @ts-expect-error a file's, not a scene's
  () => new RockField({ mesh: 'points' }),
  // @ts-expect-error no such option
  () => new RockField({ colour: 'natural' }),
  // @ts-expect-error not a number
  () => new RockField().setSeed('seven'),
  // @ts-expect-error no such method
  () => new RockField().setColour('natural'),
  // @ts-expect-error a promise
  (): Group => new RockField().build(),
];

/** And what they have to take. */
export async function right(hit: Intersection, options: RockFieldOptions): Promise<FoundRock | null> {
  const rocks: RockField = new RockField(options).setPreset('riverbed').setSeed(7).setMesh('kit');
  try {
    const group: Group = await rocks.build({
      signal: AbortSignal.timeout(1000),
      onProgress: ({ stage, fraction }) => console.log(stage, fraction),
    });
    return group.children.length > 0 ? rocks.rockOf(hit) : null;
  } catch (error) {
    if (error instanceof RockFieldError && error.name === 'ThreeUnsuitable') console.log(error.min);
    throw error;
  }
}
