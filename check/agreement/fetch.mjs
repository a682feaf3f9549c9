// Fetches the packages that packages.json pins and takes the whole WGSL shaders out of them.
//
// usage: node fetch.mjs FOLDER
// Writes FOLDER/real/*.wgsl, and FOLDER/index.json, which tells the origin of each; unpacked packages stay beside them. A
// shader is whole if nothing in it needs a preprocessor (see `isDialect`). A file without entry points is taken as well.
// Some lack what a program would join to them at run time: of these a compiler says that a name is unresolved.

import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join, relative, resolve, sep } from 'node:path';
import { fileURLToPath } from 'node:url';
import { CLIENTS } from './clients.mjs';
import { hasEntryPoint, isDialect, textsOf, uncommented } from './texts.mjs';

const JOBS = 4;
const here = dirname(fileURLToPath(import.meta.url));

function filesOf(folder) {
  return readdirSync(folder, { withFileTypes: true })
    .sort((one, other) => (one.name < other.name ? -1 : 1))
    .flatMap((entry) => {
      const path = join(folder, entry.name);
      if (entry.isDirectory()) return filesOf(path);
      return entry.isFile() ? [path] : [];
    });
}

// Gives the unpacked folder of each package.
async function unpack(packages, folder) {
  const roots = new Map();
  const waiting = [...packages];
  const work = async () => {
    for (let next = waiting.shift(); next; next = waiting.shift()) {
      const { registry, name, version } = next;
      const own = join(folder, `${registry}-${name.replaceAll('/', '-')}-${version}`);
      mkdirSync(own);
      try {
        roots.set(next, await CLIENTS[registry](next, own));
      } catch (error) {
        throw new Error(`cannot fetch ${name} ${version} (${registry}): ${error.message}`);
      }
    }
  };
  await Promise.all(Array.from({ length: JOBS }, work));
  return roots;
}

const tell = (counts) => Object.entries(counts).map(([what, count]) => `${count} ${what}`).join(', ');

// Writes the shaders of all packages to `folder`, each once. Gives their index.
function collect(roots, packages, folder) {
  const index = [];
  const known = new Set();
  const names = new Set();
  for (const each of packages) {
    const { name, version } = each;
    const root = roots.get(each);
    const counts = { whole: 0, 'without entry point': 0, dialect: 0, again: 0 };
    for (const path of filesOf(root)) {
      const from = relative(root, path).split(sep).join('/').replace(/^package\//, '');
      for (const text of textsOf(path)) {
        const key = uncommented(text).replace(/\s+/g, '');
        const whole = hasEntryPoint(text) ? 'whole' : 'without entry point';
        const kind = isDialect(text) ? 'dialect' : known.has(key) ? 'again' : whole;
        counts[kind] += 1;
        if (kind !== whole) continue;
        known.add(key);
        const stem = `${name.replace('@', '')}__${from.replace(/\.wgsl$/, '')}`.replace(/[^\w.-]+/g, '-');
        let file = `${stem}.wgsl`;
        for (let number = 2; names.has(file.toLowerCase()); number += 1) file = `${stem}-${number}.wgsl`;
        names.add(file.toLowerCase());
        writeFileSync(join(folder, file), text);
        index.push({ file, package: name, version, path: from });
      }
    }
    if (counts.whole === 0) throw new Error(`${name} ${version} has no whole shader of its own`);
    console.log(`${name} ${version}: ${tell(counts)}`);
  }
  return index;
}

// Fetches all anew unless FOLDER holds what these packages and these rules give. Gives the texts.
export async function fetchShaders(folder) {
  const pinned = readFileSync(join(here, 'packages.json'), 'utf8');
  const rules = ['fetch.mjs', 'clients.mjs', 'texts.mjs'].map((file) => readFileSync(join(here, file), 'utf8'));
  const made = JSON.stringify([pinned, ...rules]);
  const indexFile = join(folder, 'index.json');
  const real = join(folder, 'real');
  const kept = existsSync(indexFile) ? JSON.parse(readFileSync(indexFile, 'utf8')) : {};
  let { shaders } = kept;
  if (kept.made !== made) {
    const packages = JSON.parse(pinned);
    const unpacked = join(folder, 'packages');
    rmSync(folder, { recursive: true, force: true });
    for (const each of [real, unpacked]) mkdirSync(each, { recursive: true });
    shaders = collect(await unpack(packages, unpacked), packages, real);
    writeFileSync(indexFile, `${JSON.stringify({ made, shaders }, null, 1)}\n`);
    console.log(`${packages.length} packages, ${shaders.length} shaders`);
  }
  return shaders.map(({ file, package: name, version }) => {
    const path = join(real, file);
    return { id: file, group: `${name} ${version}`, path, code: readFileSync(path, 'utf8') };
  });
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  if (process.argv.length !== 3) {
    console.error('usage: node fetch.mjs FOLDER');
    process.exit(2);
  }
  fetchShaders(resolve(process.argv[2])).catch((error) => {
    console.error(error.message);
    process.exit(1);
  });
}
