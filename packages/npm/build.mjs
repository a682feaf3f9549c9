// Makes the npm package of the WGSL modules: usage: node build.mjs FOLDER
// FOLDER is emptied. The bundle has the form that npm's `wesl` takes as a library (its type `WeslBundle`). No module is copied
// into the repository: the texts are those of the folder `wgsl`, the version is that of the workspace.

import { cpSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const repository = join(here, '../..');
const library = join(repository, 'wgsl');

// What a line `key = "value"` of a TOML file says, the first one of that key.
function value(file, key) {
  const text = readFileSync(join(repository, file), 'utf8');
  const found = new RegExp(`^${key} = "(.*)"$`, 'm').exec(text);
  if (!found) throw new Error(`${file}: a line \`${key} = "..."\` is needed`);
  return found[1];
}

// The modules: texts by path, in the order of their paths.
function modules() {
  const paths = readdirSync(library, { recursive: true }).map((path) => path.replaceAll('\\', '/'));
  const texts = {};
  for (const path of paths.filter((path) => path.endsWith('.wgsl')).sort()) {
    texts[path] = readFileSync(join(library, path), 'utf8');
  }
  return texts;
}

const DECLARATION = `export interface WeslBundle {
  /** The package's name in import lines. */
  name: string;
  /** The edition of WESL. */
  edition: string;
  /** Texts of modules by path. */
  modules: Record<string, string>;
  dependencies?: WeslBundle[];
}

export declare const weslBundle: WeslBundle;
export default weslBundle;
`;

function build(folder) {
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(join(folder, 'dist'), { recursive: true });
  const manifest = JSON.parse(readFileSync(join(here, 'package.json'), 'utf8'));
  manifest.version = value('Cargo.toml', 'version');
  writeFileSync(join(folder, 'package.json'), `${JSON.stringify(manifest, null, 2)}\n`);
  const bundle = {
    name: manifest.name.replaceAll('-', '_'),
    edition: value('wgsl/wesl.toml', 'edition'),
    modules: modules(),
  };
  const text = `export const weslBundle = ${JSON.stringify(bundle, null, 2)};\n\nexport default weslBundle;\n`;
  writeFileSync(join(folder, 'dist/weslBundle.js'), text);
  writeFileSync(join(folder, 'dist/weslBundle.d.ts'), DECLARATION);
  for (const file of ['linked.js', 'linked.d.ts']) cpSync(join(here, file), join(folder, 'dist', file));
  cpSync(join(here, 'README.md'), join(folder, 'README.md'));
  for (const licence of ['LICENSE-APACHE', 'LICENSE-MIT']) cpSync(join(repository, licence), join(folder, licence));
  console.log(`${folder}: ${manifest.name} ${manifest.version}, ${Object.keys(bundle.modules).length} modules`);
}

if (process.argv.length !== 3) {
  console.error('usage: node build.mjs FOLDER');
  process.exit(2);
}
build(process.argv[2]);
