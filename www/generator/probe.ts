/** Whether a worker's script can be had: asked, and so fetched, when a worker says nothing. */

/** Reads the script of a worker as its browser should have done; rejects when it cannot be had. */
export async function probeScript(address: URL | string, heard: () => void): Promise<void> {
  const { ok, status, body } = await fetch(address);
  if (!ok) throw new Error(`the server answered ${status}`);
  const reader = body?.getReader();
  while (reader && !(await reader.read()).done) heard();
}
