// Serves the pages: compiles the plans, fetches what npm has, links the shader for three.js, and says where the pages are.
//
// usage: node serve.mjs [--port PORT] [COMMAND...]
// COMMAND is `moment-shadows`; without it, it is built from this checkout.

import { execFileSync } from 'node:child_process';
import { createReadStream, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize, relative } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = fileURLToPath(new URL('.', import.meta.url));
const root = fileURLToPath(new URL('../../..', import.meta.url));
const page = relative(root, here);

// What pages load; nothing else of the checkout is served.
const SERVED = [page, 'graph/js'].map((folder) => normalize(`${folder}/`));
const TYPES = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.css': 'text/css; charset=utf-8',
  '.json': 'application/json',
  '.wgsl': 'text/plain; charset=utf-8',
};

// When a file was written; one that is not there was never.
const age = (file) => statSync(join(here, file), { throwIfNoEntry: false })?.mtimeMs ?? 0;

function make(command) {
  const run = (program, ...settings) => execFileSync(program, settings, { cwd: here, stdio: ['ignore', 'inherit', 'inherit'] });
  run('bash', 'plans.sh', ...command);
  if (age('node_modules/.package-lock.json') < age('package-lock.json'))
    run('npm', 'ci', '--ignore-scripts', '--no-audit', '--no-fund', '--loglevel=error');
  run('node', join(root, 'packages/npm/build.mjs'), 'plans/moment-shadows');
  run('node', 'link.mjs', 'filtered_shadow.wgsl', 'plans/moment-shadows', 'plans/filtered_shadow.wgsl');
}

// The path that a request is for, or nothing where it is for none.
function pathOf(request) {
  try {
    return normalize(decodeURIComponent(new URL(request.url, 'http://localhost').pathname)).slice(1);
  } catch {
    return '';
  }
}

function answer(request, response) {
  const say = (status, text) => response.writeHead(status, { 'content-type': 'text/plain' }).end(text);
  let path = pathOf(request);
  if (path.endsWith('/')) path += 'index.html';
  const file = join(root, path);
  if (!SERVED.some((folder) => path.startsWith(folder))) return say(404, 'not a part of the pages');
  if (!statSync(file, { throwIfNoEntry: false })?.isFile()) return say(404, 'there is no such file');
  const type = TYPES[extname(file)] ?? 'application/octet-stream';
  // What has been edited is seen by a reload.
  response.writeHead(200, { 'content-type': type, 'cache-control': 'no-cache' });
  createReadStream(file).pipe(response);
}

function main(settings) {
  const given = settings[0] === '--port';
  const port = Number(given ? settings[1] : 8000);
  try {
    make(settings.slice(given ? 2 : 0));
  } catch (error) {
    // What failed has said why.
    console.error(`the pages could not be made: ${error.message}`);
    process.exitCode = 1;
    return;
  }
  const server = createServer(answer);
  server.on('error', (error) => {
    console.error(error.code === 'EADDRINUSE' ? `port ${port} is taken; another one: serve.mjs --port ${port + 1}` : error.message);
    process.exitCode = 1;
  });
  server.listen(port, 'localhost', () => {
    const address = `http://localhost:${server.address().port}/${page}`;
    console.log(`Shadow techniques: ${address}/\nIn three.js:       ${address}/three.html`);
  });
}

main(process.argv.slice(2));
