// What `moment-shadows validate` says.

import { spawn } from 'node:child_process';
import { resolve } from 'node:path';

const VERSION = 1;

function outputOf(command, args) {
  return new Promise((done, failed) => {
    const child = spawn(command, args, { stdio: ['ignore', 'pipe', 'inherit'] });
    const parts = [];
    child.stdout.on('data', (part) => parts.push(part));
    child.on('error', failed);
    child.on('close', (status, signal) => done({ text: Buffer.concat(parts).toString('utf8'), ended: signal ?? `status ${status}` }));
  });
}

// Runs `command`, words of a command line, over all shaders in `folders`. Gives the finding of each file that makes it
// invalid, none for a valid one.
export async function ourVerdicts([program, ...words], folders) {
  const { text, ended } = await outputOf(program, [...words, 'validate', '--format', 'json', '--profile', 'webgpu-core', ...folders]);
  let report;
  try {
    report = JSON.parse(text);
  } catch (error) {
    throw new Error(`${program} ended with ${ended} and gave no JSON: ${error.message}`);
  }
  if (report.version !== VERSION) throw new Error(`the report is of version ${report.version}, not ${VERSION}`);
  return new Map(report.files.map(({ file, valid, findings }) => {
    const errors = findings.filter(({ severity }) => severity === 'error');
    if (valid !== (errors.length === 0)) throw new Error(`${file} is said to be ${valid ? 'valid' : 'invalid'} with ${errors.length} errors`);
    return [resolve(file), errors];
  }));
}
