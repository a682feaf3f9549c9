// The library's modules as plain WGSL, for pages without a linker: no two of them define the same name, so that a module is linked by
// putting what it imports before it.

import { weslBundle } from './weslBundle.js';

// An import of another module, over one line or several: `import super::super::map::depth::{a, b};`.
const IMPORT = /^import super::super::(\w+)::(\w+)::[^;]*;[^\S\n]*\n?/gm;

// The names of all modules: `bounds/hamburger4` and so on.
export const names = Object.keys(weslBundle.modules).map((path) => path.replace(/\.wgsl$/, ''));

// The text of modules with all that they import, each once: WGSL without imports. Put a shader of your own behind it.
export function linked(...modules) {
  const texts = new Map();
  const add = (name, from) => {
    if (texts.has(name)) return;
    const text = weslBundle.modules[`${name}.wgsl`];
    if (text === undefined) throw new Error(`${from} is '${name}', which is none of the modules: ${names.join(', ')}`);
    texts.set(name, '');
    for (const [, folder, module] of text.matchAll(IMPORT)) add(`${folder}/${module}`, `an import of '${name}'`);
    // Behind what it imports.
    texts.delete(name);
    texts.set(name, text.replace(IMPORT, ''));
  };
  for (const name of modules) add(name, 'what is asked for');
  return [...texts].map(([name, text]) => `// moment_shadows/${name}\n${text}`).join('\n');
}
