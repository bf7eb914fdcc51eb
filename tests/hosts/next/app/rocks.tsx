'use client';

import { useEffect, useRef, useState } from 'react';
import 'rock-field';
import type { RockFieldElement, RockFieldEventMap } from 'rock-field';
import type {} from 'rock-field/jsx';

export function Rocks() {
  const field = useRef<RockFieldElement>(null);
  const [rocks, setRocks] = useState(0);
  const [framed, setFramed] = useState(false);
  // While it hydrates what a server sent, React 19 listens to no event of a custom element: https://github.com/react/react/issues/35446
  useEffect(() => {
    const element = field.current;
    if (!element) return;
    const count = () => setRocks(element.field?.stats.rocks ?? 0);
    const look = ({ detail }: RockFieldEventMap['camera-change']) => setFramed(detail.framed);
    count();
    element.addEventListener('generate', count);
    element.addEventListener('camera-change', look);
    return () => {
      element.removeEventListener('generate', count);
      element.removeEventListener('camera-change', look);
    };
  }, []);
  return (
    <>
      <rock-field
        ref={field}
        seed={7}
        preset="journal-fig1"
        image-width="1100"
        radius="80 30 10"
        taper-rock="6 6 2"
        view="3d"
        camera-orbit="30deg 55deg auto"
        style={{ display: 'block', width: 400, height: 300 }}
      >
        <img slot="poster" src="/poster.svg" alt="Rocks, drawn before they are grown" width={400} height={300} />
      </rock-field>
      <output>{rocks} rocks</output>
      <button type="button" onClick={() => field.current?.frameAll()}>
        {framed ? 'framed' : 'Whole field'}
      </button>
    </>
  );
}
