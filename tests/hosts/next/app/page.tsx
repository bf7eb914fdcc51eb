import { Rocks } from './rocks';

export default function Page() {
  return (
    <main>
      <h1>Rocks</h1>
      <Rocks />
    </main>
  );
}
