// Resolves names as the import map of the page in examples/hosts/web does.
//
// usage: node --import ./check/import_map.mjs SCRIPT

import { readFileSync } from 'node:fs';
import { register } from 'node:module';

const page = new URL('../examples/hosts/web/index.html', import.meta.url);
const [, map] = /<script type="importmap">(.*?)<\/script>/s.exec(readFileSync(page, 'utf8'));
const places = Object.entries(JSON.parse(map).imports).map(([name, place]) => [name, new URL(place, page).href]);
const hooks = `
const places = new Map(${JSON.stringify(places)});
export const resolve = (name, context, next) => next(places.get(name) ?? name, context);`;
register(`data:text/javascript,${encodeURIComponent(hooks)}`);
