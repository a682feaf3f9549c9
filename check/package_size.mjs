// What the npm package weighs, and how long its recorder is.
//
// usage: node package_size.mjs FOLDER

import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const LARGEST_PACKAGE = 120_000;
const LONGEST_RECORDER = 150;

function main(folder) {
  const [{ filename, size, unpackedSize, files }] = JSON.parse(execFileSync('npm', ['pack', '--dry-run', '--json'], { cwd: folder }));
  const lines = readFileSync(join(folder, 'recorder.js'), 'utf8').trimEnd().split('\n').length;
  console.log(`${filename}: ${files.length} files, ${size} bytes packed, ${unpackedSize} unpacked; recorder.js: ${lines} lines`);
  const { dependencies = {} } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  const faults = [
    [size > LARGEST_PACKAGE, `the package has more than ${LARGEST_PACKAGE} bytes`],
    [lines > LONGEST_RECORDER, `recorder.js has more than ${LONGEST_RECORDER} lines`],
    // npm leaves links out.
    [files.filter(({ path }) => path.startsWith('LICENSE')).length !== 2, 'the package lacks a licence'],
    [Object.keys(dependencies).length > 0, 'the package has dependencies'],
  ];
  const found = faults.filter(([is]) => is);
  for (const [, fault] of found) console.error(fault);
  return found.length === 0;
}

if (process.argv.length !== 3) {
  console.error('usage: node package_size.mjs FOLDER');
  process.exit(2);
}
process.exitCode = main(process.argv[2]) ? 0 : 1;
