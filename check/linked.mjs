// The modules of the npm package as plain WGSL: what `linked` gives of each, compiled by Dawn.
//
// usage: node linked.mjs

import { linked, names } from 'moment-shadows/linked.js';
import { judge, openDevice } from './dawn.mjs';

async function main() {
  const device = await openDevice();
  let refused = 0;
  for (const name of [...names, undefined]) {
    const code = name === undefined ? linked(...names) : linked(name);
    const said = await judge(device, code, []);
    if (said.length > 0) {
      console.error(`${name ?? 'all together'}: ${said.join('\n')}`);
      refused += 1;
    }
  }
  // A module without what it imports is no shader, and a check that does not see that proves nothing.
  const [first] = linked('bounds/hamburger4').split('\n// moment_shadows/').slice(-1);
  if ((await judge(device, first, [])).length === 0) throw new Error('a module without its imports is not refused');
  for (const wrong of ['bounds/hamburger5', '']) {
    try {
      linked(wrong);
      throw new Error(`'${wrong}' is linked`);
    } catch (error) {
      if (!error.message.includes('is none of the modules: air/')) throw error;
    }
  }
  console.log(`linked.js: ${names.length} modules as plain WGSL, ${refused} refused by Dawn`);
  return refused === 0 && names.length > 0;
}

process.exitCode = (await main()) ? 0 : 1;
