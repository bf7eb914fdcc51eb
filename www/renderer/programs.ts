/**
 * How a WebGL2 context makes its programs. Browsers compile and link beside the page, and have it wait as soon as it asks for anything of a program, which
 * wgpu does at once. Here its questions are answered before the program is linked, and what it sets is kept until then.
 */

/** The uniform whose place wgpu asks for last when it makes a program. */
const LAST = 'naga_vs_first_instance';

const METHODS = [
  'deleteProgram',
  'getProgramInfoLog',
  'getProgramParameter',
  'getShaderInfoLog',
  'getShaderParameter',
  'getUniformBlockIndex',
  'getUniformLocation',
  'linkProgram',
  'uniform1i',
  'uniform1ui',
  'uniformBlockBinding',
  'useProgram',
] as const;

type Methods = Pick<WebGL2RenderingContext, (typeof METHODS)[number]>;

/** A program that is being linked. */
interface Link {
  /** Names of blocks of uniforms, by the indices that were answered. */
  blocks: string[];
  /** What is to be done when it is linked. */
  later: (() => void)[];
  /** All was asked that belongs to its making: whoever uses it now draws. */
  isWhole: boolean;
  /** The device was told to use it. */
  isUsed: boolean;
}

/** The place of a uniform, which was asked for before the program was linked. */
class Place {
  readonly link: Link;
  found: WebGLUniformLocation | null = null;

  constructor(link: Link) {
    this.link = link;
  }
}

export class Programs {
  readonly #context: WebGL2RenderingContext;
  readonly #own: Methods;
  readonly #links = new Map<WebGLProgram, Link>();
  /** The device comes to it when it has done what they need. */
  #fence: WebGLSync | null = null;
  /** Programs are linked beside the page now. */
  #isBeside = false;
  #failure: Error | undefined;

  /** `context`: nothing was drawn on it yet. */
  constructor(context: WebGL2RenderingContext) {
    this.#context = context;
    this.#own = Object.fromEntries(METHODS.map((name) => [name, (context[name] as () => unknown).bind(context)])) as unknown as Methods;
    Object.assign(context, this.#answers());
  }

  /** Whether programs are being linked. */
  get isLinking(): boolean {
    return this.#links.size > 0;
  }

  /**
   * Calls `make`, whose programs are linked beside the page. It is told whether all programs are there, and may draw only then; it returns whether it
   * has made anything. True while there is more to make, or to wait for.
   *
   * @throws an Error saying why a program does not link.
   */
  beside(make: (isLinked: boolean) => boolean): boolean {
    const isLinked = !this.#finishNext();
    this.#isBeside = true;
    try {
      return make(isLinked) || !isLinked;
    } finally {
      this.#isBeside = false;
    }
  }

  /** Takes the next step with the programs if the device has done the last one. False if there were none. */
  #finishNext(): boolean {
    const context = this.#context;
    const [first] = this.#links;
    if (first && (!this.#fence || context.getSyncParameter(this.#fence, context.SYNC_STATUS) !== context.UNSIGNALED)) {
      const [program, { isUsed }] = first;
      if (isUsed) this.#finish(program);
      else this.#use();
    }
    if (this.#failure) throw this.#failure;
    return first !== undefined;
  }

  /**
   * Keeps a program in mind that is being linked. Chromium has no `KHR_parallel_shader_compile` where software draws; but a fence tells when a program is
   * linked, if the device has to validate it first.
   */
  #link(program: WebGLProgram): void {
    this.#links.set(program, { blocks: [], later: [], isWhole: false, isUsed: false });
    this.#context.validateProgram(program);
    this.#setFence();
  }

  /** Programs that are linked are optimised when they are used for the first time, which takes as long again. */
  #use(): void {
    for (const [program, link] of this.#links) {
      link.isUsed = true;
      this.#own.useProgram(program);
    }
    this.#setFence();
  }

  #setFence(): void {
    const context = this.#context;
    context.deleteSync(this.#fence);
    this.#fence = context.fenceSync(context.SYNC_GPU_COMMANDS_COMPLETE, 0);
    context.flush();
  }

  /** Does what was to be done when a program is linked, for which the page waits if it is not. */
  #finish(program: WebGLProgram): void {
    const { LINK_STATUS } = this.#context;
    const later = this.#links.get(program)?.later ?? [];
    this.#links.delete(program);
    if (this.#own.getProgramParameter(program, LINK_STATUS) === false) this.#failure ??= new Error(this.#log(program));
    this.#own.useProgram(program);
    for (const act of later) act();
  }

  #log(program: WebGLProgram): string {
    const logs = [this.#own.getProgramInfoLog(program)];
    if (!this.#own.getProgramParameter(program, this.#context.LINK_STATUS))
      logs.push(...(this.#context.getAttachedShaders(program) ?? []).map(this.#own.getShaderInfoLog));
    return logs.join(' ');
  }

  /** The context's methods from now on. */
  #answers(): Methods {
    const { COMPILE_STATUS, LINK_STATUS } = this.#context;
    const own = this.#own;
    const links = this.#links;
    return {
      ...own,
      // Whether a program links, which is asked later, tells the same, and then also why it does not.
      getShaderParameter: (shader, name) => name === COMPILE_STATUS || own.getShaderParameter(shader, name),
      getShaderInfoLog: () => '',
      linkProgram: (program) => {
        own.linkProgram(program);
        if (this.#isBeside) this.#link(program);
      },
      getProgramParameter: (program, name) => (name === LINK_STATUS && links.has(program)) || own.getProgramParameter(program, name),
      getProgramInfoLog: (program) => (links.has(program) ? '' : this.#log(program)),
      useProgram: (program) => {
        const link = program && links.get(program);
        if (link && !link.isWhole) return;
        if (link) this.#finish(program);
        own.useProgram(program);
      },
      getUniformBlockIndex: (program, name) => {
        const link = links.get(program);
        return link ? link.blocks.push(name) - 1 : own.getUniformBlockIndex(program, name);
      },
      uniformBlockBinding: (program, index, binding) => {
        const link = links.get(program);
        const found = (): number => (link ? own.getUniformBlockIndex(program, link.blocks[index] ?? '') : index);
        const bind = (): void => own.uniformBlockBinding(program, found(), binding);
        if (link) link.later.push(bind);
        else bind();
      },
      getUniformLocation: (program, name) => {
        const link = links.get(program);
        if (!link) return own.getUniformLocation(program, name);
        link.isWhole = name === LAST;
        const place = new Place(link);
        link.later.push(() => (place.found = own.getUniformLocation(program, name)));
        return place;
      },
      uniform1i: (place, value) => {
        if (place instanceof Place && !place.link.isWhole) place.link.later.push(() => own.uniform1i(place.found, value));
        else own.uniform1i(found(place), value);
      },
      uniform1ui: (place, value) => own.uniform1ui(found(place), value),
      deleteProgram: (program) => {
        if (program) links.delete(program);
        own.deleteProgram(program);
      },
    };
  }
}

function found(place: WebGLUniformLocation | null): WebGLUniformLocation | null {
  return place instanceof Place ? place.found : place;
}
