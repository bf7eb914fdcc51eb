/**
 * One hash for all items of a batch, in their order: the root of the tree of RFC 6962, section 2.1, with SHA-256.
 *
 * It needs memory for one hash for each level of the tree, however many items there are.
 */

import { createHash } from 'node:crypto';

/** They keep a leaf from passing for a node. */
const [LEAF, NODE] = [Uint8Array.of(0), Uint8Array.of(1)];

interface Subtree {
  leaves: number;
  hash: Uint8Array;
}

export class MerkleTree {
  /** Whole subtrees from left to right, each with fewer leaves than the one before. */
  readonly #subtrees: Subtree[] = [];

  /** @param parts what the leaf says, in parts whose lengths are always the same. */
  add(...parts: readonly Uint8Array[]): void {
    let right: Subtree = { leaves: 1, hash: sha256(LEAF, ...parts) };
    for (let left = this.#subtrees.at(-1); left?.leaves === right.leaves; left = this.#subtrees.at(-1)) {
      this.#subtrees.pop();
      right = joined(left, right);
    }
    this.#subtrees.push(right);
  }

  /** In hexadecimal. Leaves may be added afterwards. */
  root(): string {
    const all = this.#subtrees.reduceRight<Subtree | null>((right, left) => (right ? joined(left, right) : left), null);
    return Buffer.from(all?.hash ?? sha256()).toString('hex');
  }
}

function joined(left: Subtree, right: Subtree): Subtree {
  return { leaves: left.leaves + right.leaves, hash: sha256(NODE, left.hash, right.hash) };
}

function sha256(...parts: readonly Uint8Array[]): Uint8Array {
  const hash = createHash('sha256');
  for (const part of parts) hash.update(part);
  return hash.digest();
}
