// Pairs of shaders, one line apart: Tint takes the good one and refuses the bad one. README.md tells their form.

import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';

// The pairs of one file. The file's name is their kind.
function readPairs(path) {
  const kind = basename(path, '.pairs');
  const pairs = [];
  let pair;
  for (const line of readFileSync(path, 'utf8').split('\n')) {
    if (line.startsWith('=== ')) {
      pair = { kind, name: line.slice(4).trim(), good: [], bad: [], own: { good: 0, bad: 0 } };
      if (pairs.some(({ name }) => name === pair.name)) throw new Error(`${path}: there are two pairs \`${pair.name}\``);
      pairs.push(pair);
      continue;
    }
    if (!pair) throw new Error(`${path}: a line before the first pair: ${line}`);
    const [, side, text] = line.match(/^(good|bad )\|(.*)$/) ?? [];
    for (const each of side ? [side.trim()] : ['good', 'bad']) {
      pair[each].push(text ?? line);
      if (side) pair.own[each] += 1;
    }
  }
  for (const { name, own } of pairs) {
    if (own.good !== 1 || own.bad !== 1) throw new Error(`${path}: \`${name}\` needs one line of the good one and one of the bad one`);
  }
  return pairs;
}

// Writes every pair of the files in `source` as FOLDER/KIND/NNN.good.wgsl and NNN.bad.wgsl. Gives the texts.
export function writePairs(source, folder) {
  rmSync(folder, { recursive: true, force: true });
  const texts = [];
  const known = new Map();
  for (const file of readdirSync(source).filter((name) => name.endsWith('.pairs')).sort()) {
    readPairs(join(source, file)).forEach(({ kind, name, ...sides }, index) => {
      mkdirSync(join(folder, kind), { recursive: true });
      const codes = [];
      for (const side of ['good', 'bad']) {
        const path = join(folder, kind, `${String(index + 1).padStart(3, '0')}.${side}.wgsl`);
        const code = `${sides[side].join('\n').trimEnd()}\n`;
        writeFileSync(path, code);
        texts.push({ id: `${kind}/${name}/${side}`, group: kind, path, code, wanted: side === 'good' });
        codes.push(code.replace(/\s+/g, ' '));
      }
      const key = codes.join('|');
      if (known.has(key)) throw new Error(`the pairs ${known.get(key)} and ${kind}/${name} are the same`);
      known.set(key, `${kind}/${name}`);
    });
  }
  return texts;
}
