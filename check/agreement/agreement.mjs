// Whether `moment-shadows validate` takes what browsers take, and nothing else: its verdicts beside those of Tint, the WGSL
// compiler of Chromium, on pairs of shaders one line apart and on shaders of published packages.
//
// usage: node agreement.mjs FOLDER COMMAND...
// FOLDER is where the shaders are written and fetched to. COMMAND is the words that start moment-shadows. README.md tells more.

import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { judge, openDevice } from '../dawn.mjs';
import { compare, firstObjection, isFragment } from './compare.mjs';
import { readEntryPoints } from './entry_points.mjs';
import { fetchShaders } from './fetch.mjs';
import { ourVerdicts } from './ours.mjs';
import { writePairs } from './pairs.mjs';
import { readReasons } from './reasons.mjs';
import { Counts } from './table.mjs';

const LEAST_AGREEMENT = 0.99;

async function tintObjections(device, code) {
  const { entryPoints, constants } = readEntryPoints(code);
  return judge(device, code, entryPoints, constants, ['error']);
}

function printPercentage(what, agreed, texts) {
  const enough = texts > 0 && agreed >= LEAST_AGREEMENT * texts;
  console.log(`${what}: ${agreed} of ${texts} agree, ${((100 * agreed) / texts).toFixed(2)} %${enough ? '' : `: less than ${100 * LEAST_AGREEMENT} %`}`);
  return enough;
}

async function main(folder, command) {
  const pairs = writePairs(join(dirname(fileURLToPath(import.meta.url)), 'pairs'), join(folder, 'pairs'));
  const real = await fetchShaders(join(folder, 'corpus'));
  const ours = await ourVerdicts(command, [join(folder, 'pairs'), join(folder, 'corpus', 'real')]);
  const known = readReasons();
  const device = await openDevice();

  const counts = { pairs: new Counts(), real: new Counts() };
  const disagreements = [];
  let fragments = 0;
  let faults = 0;
  const fault = (text) => {
    console.error(text);
    faults += 1;
  };
  for (const text of [...pairs, ...real]) {
    const { id, path, group, code, wanted } = text;
    const our = ours.get(path);
    if (!our) throw new Error(`moment-shadows says nothing about ${path}`);
    const their = await tintObjections(device, code);
    const verdict = compare(our, their);
    if (wanted !== undefined && wanted !== (their.length === 0)) fault(`WRONG PAIR ${id}: Tint ${their[0] ?? 'accepts it'}`);
    if (wanted === undefined && verdict === 'agreed' && isFragment(their)) {
      fragments += 1;
      continue;
    }
    counts[wanted === undefined ? 'real' : 'pairs'].add(group, verdict);
    if (verdict !== 'agreed') disagreements.push({ id, verdict, said: firstObjection(our, their) });
  }

  counts.pairs.print('kind of fault');
  counts.real.print('package');
  console.log(`Left out: ${fragments} texts that both refuse and that lack what a program would join to them.\n`);

  for (const { id, verdict, said } of disagreements) {
    const refusedBy = verdict === 'laxer' ? 'Tint' : 'moment-shadows';
    const reason = known.get(id);
    known.delete(id);
    const because = reason?.refusedBy === refusedBy ? `because: ${reason.reason}` : 'NEW: no reason in reasons.json';
    if (because.startsWith('NEW')) faults += 1;
    console.log(`${id}: refused by ${refusedBy} alone\n    ${said}\n    ${because}`);
  }
  for (const id of known.keys()) fault(`STALE: ${id} is in reasons.json and is no disagreement`);

  console.log();
  const { texts, agreed, unsupported } = counts.pairs.total;
  const enough = [
    printPercentage('Pairs but for what is said to be unsupported', agreed, texts - unsupported),
    printPercentage('Real shaders', counts.real.total.agreed, counts.real.total.texts),
  ];
  console.log(`${pairs.length / 2} pairs, ${counts.real.total.texts} real shaders, ${disagreements.length} disagreements, ${faults} without a good reason`);
  return faults === 0 && enough.every(Boolean);
}

if (process.argv.length < 4) {
  console.error('usage: node agreement.mjs FOLDER COMMAND...');
  process.exit(2);
}
main(resolve(process.argv[2]), process.argv.slice(3)).then(
  // An open device keeps the process alive.
  (passed) => process.exit(passed ? 0 : 1),
  (error) => {
    console.error(error.message);
    process.exit(1);
  },
);
