// Programs of a WebGL2 context that are linked beside the page, on a context of our own.
import assert from 'node:assert/strict';
import { beforeEach, describe, it } from 'node:test';
import { Programs } from '../../www/renderer/programs.ts';

const LINK_STATUS = 0x8b82;
const COMPILE_STATUS = 0x8b81;
const UNSIGNALED = 0x9118;

/** What a page waits for, and what it only gives to the device. */
const ASKS = ['getProgramParameter', 'getProgramInfoLog', 'getShaderInfoLog', 'getUniformBlockIndex', 'getUniformLocation', 'useProgram'];

/** Everything that was called, in order. */
let calls: string[];
/** The device has come to the fence, and whether its programs link. */
let isLinked: boolean;
let links: boolean;
let gl: WebGL2RenderingContext;
let programs: Programs;

beforeEach(() => {
  calls = [];
  isLinked = false;
  links = true;
  gl = context();
  programs = new Programs(gl);
});

function context(): WebGL2RenderingContext {
  const answers: Record<string, (...values: unknown[]) => unknown> = {
    getProgramParameter: (_, name) => (name === LINK_STATUS ? links : 0),
    getProgramInfoLog: () => (links ? '' : 'varyings differ'),
    getShaderInfoLog: (shader) => `log of ${shader}`,
    getAttachedShaders: () => ['vertices', 'fragments'],
    getShaderParameter: () => false,
    getUniformBlockIndex: (_, name) => (name === 'second' ? 7 : 3),
    getUniformLocation: (_, name) => `place of ${name}`,
    fenceSync: () => 'fence',
    getSyncParameter: () => (isLinked ? UNSIGNALED + 1 : UNSIGNALED),
  };
  const names = [
    ...Object.keys(answers),
    ...['deleteProgram', 'deleteSync', 'flush', 'linkProgram', 'uniform1i', 'uniform1ui', 'uniformBlockBinding', 'useProgram'],
    'validateProgram',
  ];
  const methods = names.map((name) => [
    name,
    (...values: unknown[]) => {
      calls.push([name, ...values].join(' '));
      return answers[name]?.(...values);
    },
  ]);
  return {
    ...Object.fromEntries(methods),
    LINK_STATUS,
    COMPILE_STATUS,
    UNSIGNALED,
    SYNC_STATUS: 0x9114,
    SYNC_GPU_COMMANDS_COMPLETE: 0x9117,
  };
}

/** As wgpu makes a program of this name. */
function make(name: string): { first: WebGLUniformLocation | null } {
  const program = name as unknown as WebGLProgram;
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, LINK_STATUS)) throw new Error(String(gl.getProgramInfoLog(program)));
  assert.equal(gl.getProgramInfoLog(program), '');
  gl.useProgram(program);
  for (const [slot, block] of ['first', 'second'].entries()) gl.uniformBlockBinding(program, gl.getUniformBlockIndex(program, block), slot);
  gl.uniform1i(gl.getUniformLocation(program, 'map'), 5);
  return { first: gl.getUniformLocation(program, 'naga_vs_first_instance') };
}

const asked = (): string[] => calls.filter((call) => ASKS.includes(call.split(' ')[0] ?? ''));

/** Calls `beside` until nothing is to come; the device links what it has after the first time. */
function finish(): void {
  for (let turn = 0; turn < 10; turn += 1) {
    if (!programs.beside(() => false)) return;
    isLinked = true;
  }
  assert.fail('it does not end');
}

describe('Programs that are linked beside the page', () => {
  it('nothing is asked of them before they are linked; then they get what was set', () => {
    assert.equal(
      programs.beside(() => make('one') !== null),
      true,
    );
    assert.deepEqual(asked(), []);
    assert.ok(programs.isLinking);
    calls = [];
    finish();
    assert.ok(!programs.isLinking);
    assert.deepEqual(
      calls.filter((call) => /^(uniform|use)/.test(call)),
      ['useProgram one', 'useProgram one', 'uniformBlockBinding one 3 0', 'uniformBlockBinding one 7 1', 'uniform1i place of map 5'],
    );
  });

  it('whoever makes more is told that nothing can be drawn meanwhile', () => {
    const told: boolean[] = [];
    const tell = (isReady: boolean): boolean => {
      const isMaking = told.push(isReady) < 3;
      if (isMaking) make(String(told.length));
      return isMaking;
    };
    for (let turn = 0; turn < 4; turn += 1) assert.ok(programs.beside(tell));
    isLinked = true;
    while (programs.beside(tell));
    assert.deepEqual(told, [true, false, false, false, false, false, false, true]);
  });

  it('one that is drawn with sooner is waited for', () => {
    let first: WebGLUniformLocation | null = null;
    programs.beside(() => {
      ({ first } = make('one'));
      return true;
    });
    calls = [];
    gl.useProgram('one' as unknown as WebGLProgram);
    gl.uniform1ui(first, 9);
    assert.ok(calls.indexOf('uniform1i place of map 5') > calls.indexOf('useProgram one'));
    assert.equal(calls.at(-1), 'uniform1ui place of naga_vs_first_instance 9');
    assert.ok(!programs.isLinking);
  });

  it('one that does not link is an error that says why', () => {
    links = false;
    programs.beside(() => make('one') !== null);
    for (let turn = 0; turn < 2; turn += 1)
      assert.throws(finish, { message: 'varyings differ log of vertices log of fragments' }, 'also when it is asked again');
  });

  it('one that was deleted is forgotten', () => {
    programs.beside(() => make('one') !== null);
    gl.deleteProgram('one' as unknown as WebGLProgram);
    calls = [];
    finish();
    assert.deepEqual(calls, []);
  });

  it('others are made as ever, but for the state of their shaders, which their link tells', () => {
    make('one');
    assert.ok(calls.includes('useProgram one'));
    assert.ok(!programs.isLinking);
    assert.equal(gl.getShaderParameter('shader' as unknown as WebGLShader, COMPILE_STATUS), true);
    links = false;
    assert.throws(() => make('two'), { message: 'varyings differ log of vertices log of fragments' });
  });
});
