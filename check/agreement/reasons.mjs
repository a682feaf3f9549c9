// The disagreements that are known, with their reasons: reasons.json.

import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const REFUSED_BY = ['moment-shadows', 'Tint'];

// Gives a map from the id of a text to who refuses it, and why.
export function readReasons() {
  const path = join(dirname(fileURLToPath(import.meta.url)), 'reasons.json');
  const known = new Map();
  for (const { refused_by: refusedBy, reason, texts } of JSON.parse(readFileSync(path, 'utf8'))) {
    if (!REFUSED_BY.includes(refusedBy) || !reason || texts.length === 0) throw new Error(`${path}: a reason lacks something: ${reason}`);
    for (const id of texts) {
      if (known.has(id)) throw new Error(`${path}: ${id} has two reasons`);
      known.set(id, { refusedBy, reason });
    }
  }
  return known;
}
