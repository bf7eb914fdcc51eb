import { useRef, useState } from 'react';
import 'rock-field';
import type { RockFieldElement } from 'rock-field';
import type {} from 'rock-field/jsx';

export function App() {
  const field = useRef<RockFieldElement>(null);
  const [rocks, setRocks] = useState(0);
  const [framed, setFramed] = useState(false);
  return (
    <main>
      <rock-field
        ref={field}
        seed={7}
        preset="journal-fig1"
        image-width="1100"
        radius={[80, 30, 10]}
        taper-rock="6 6 2"
        view="3d"
        camera-orbit="30deg 55deg auto"
        disabled={false}
        ongenerate={({ detail }) => setRocks(detail.stats.rocks)}
        oncamera-change={({ detail }) => setFramed(detail.framed)}
        style={{ width: 400, height: 300 }}
      />
      <output>{rocks} rocks</output>
      <button type="button" onClick={() => field.current?.frameAll()}>
        {framed ? 'framed' : 'Whole field'}
      </button>
    </main>
  );
}
