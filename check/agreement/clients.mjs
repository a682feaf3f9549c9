// How each registry's ordinary client hands a package over, with nothing it depends on.

import { execFile } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync } from 'node:fs';
import { homedir } from 'node:os';
import { join } from 'node:path';
import { promisify } from 'node:util';

const start = promisify(execFile);

async function run(command, args, cwd) {
  try {
    return (await start(command, args, { cwd, maxBuffer: 64 << 20, timeout: 100_000 })).stdout;
  } catch (error) {
    const reason = error.killed ? 'took over 100 seconds' : (error.stderr || error.message).trim().split('\n').slice(-5).join('\n');
    throw new Error(`${command} ${args.join(' ')}: ${reason}`);
  }
}

// The one file of a folder that has just received a download.
function only(folder) {
  const files = readdirSync(folder);
  if (files.length !== 1) throw new Error(`one file was to be downloaded to ${folder}, not ${files.length}`);
  return join(folder, files[0]);
}

// Each gives the unpacked folder. `folder` is an empty one for the package alone.
export const CLIENTS = {
  async npm({ name, version }, folder) {
    const packed = join(folder, 'packed');
    mkdirSync(packed);
    await run('npm', ['pack', '--loglevel', 'error', '--ignore-scripts', `${name}@${version}`], packed);
    await run('tar', ['-xzf', only(packed), '-C', folder]);
    return folder;
  },
  async crates({ name, version }, folder) {
    // To tell about a package cargo downloads and unpacks it, and only it. Elsewhere than in a workspace of ours.
    await run('cargo', ['info', '--quiet', `${name}@${version}`], folder);
    const sources = join(process.env.CARGO_HOME || join(homedir(), '.cargo'), 'registry', 'src');
    const unpacked = readdirSync(sources).map((registry) => join(sources, registry, `${name}-${version}`)).filter(existsSync);
    if (unpacked.length === 0) throw new Error(`cargo left no ${name}-${version} in ${sources}`);
    return unpacked[0];
  },
};
