// `npm run bench -- --shaders DIR`: what the pipelines are made of, for compilers that tell what a pixel costs on a device that is not at hand.
import { mkdirSync, readdirSync } from 'node:fs';
import path from 'node:path';
import { cargoEnv, root } from '../scripts/lib/env.mjs';
import { Failure, run } from '../scripts/lib/run.mjs';

/** The Rust test that makes the files, and the variable that tells it where to. */
const TEST = 'shading::shaders::complete::every_pipeline_has_a_complete_shader_that_says_what_it_is_made_for';
const FOLDER = 'ROCK_FIELD_SHADERS';

/** Writes a file for every pass, quality and recipe: vertex and fragment shader, with the pipeline's constants put in. Returns their names. */
export async function writeShaders(folder) {
  const target = path.resolve(folder);
  mkdirSync(target, { recursive: true });
  await run('cargo', ['test', '--quiet', '--lib', '--', '--exact', TEST], { env: { ...cargoEnv, [FOLDER]: target }, cwd: root });
  const files = readdirSync(target).filter((name) => name.endsWith('.wgsl'));
  if (files.length === 0) throw new Failure(`nothing was written to ${target}: there is no test ${TEST}`);
  return files;
}
