// The command that serves the pages, as a reader runs it.

import { spawn } from 'node:child_process';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

const program = fileURLToPath(new URL('../../examples/hosts/web/serve.mjs', import.meta.url));

/** Starts it, on any port that is free. Gives the addresses that it prints: `techniques` and `three`. */
export async function serve(command) {
  const child = spawn('node', [program, '--port', '0', command], { stdio: ['ignore', 'pipe', 'inherit'] });
  const addresses = [];
  for await (const line of createInterface({ input: child.stdout })) {
    addresses.push(...(line.match(/http:\S+/) ?? []));
    if (addresses.length === 2) return { techniques: addresses[0], three: addresses[1], stop: () => child.kill() };
  }
  throw new Error(`${program} ended without two addresses`);
}
