// Reads the entry points out of a text that its compiler has taken, as roughly as making pipelines of them needs.

import { closing, split } from './brackets.mjs';
import { uncommented } from './texts.mjs';
import { bufferOf, formatOf, vertexTextFor } from './varyings.mjs';

const table = (text, pattern, value) => Object.fromEntries([...text.matchAll(pattern)].map((match) => [match[1], value(match)]));

// The value of a sum of numbers and named constants.
function number(text, constants) {
  const sum = text.replace(/\b[A-Za-z_]\w*/g, (word) => constants[word] ?? word).replace(/\s+/g, '');
  return (sum.match(/[+-]?\d+/g) ?? []).reduce((total, part) => total + Number(part), 0);
}

// What of `declared`, parameters or members, has a location.
function located(declared, { structs, aliases, constants }) {
  return declared.flatMap((part) => {
    const [, attributes, type] = part.match(/^((?:@\w+(?:\([^)]*\))?\s*)*)\w+\s*:\s*([^]+)$/) ?? [];
    if (!type) return [];
    const known = aliases[type.trim()] ?? type.trim();
    if (structs[known]) return located(structs[known], { structs, aliases, constants });
    const location = attributes.match(/@location\(([^)]*)\)/);
    const interpolate = attributes.match(/@interpolate\([^)]*\)/)?.[0] ?? '';
    return location ? [{ location: number(location[1], constants), type: known, interpolate }] : [];
  });
}

function targetsOf(outputs) {
  const targets = [];
  for (const { location, type } of outputs) targets[location] = formatOf(type);
  return Array.from(targets, (format) => format ?? null);
}

// Entry points as pipelines.mjs takes them, and values for the overrides that have none.
export function readEntryPoints(code) {
  const text = uncommented(code);
  const names = {
    structs: table(text, /\bstruct\s+(\w+)\s*\{([^}]*)\}/g, ([, , members]) => split(members)),
    aliases: table(text, /\balias\s+(\w+)\s*=\s*([^;]+);/g, ([, , type]) => type.trim()),
    constants: table(text, /\bconst\s+(\w+)[^=;]*=\s*(\d+)u?;/g, ([, , value]) => value),
  };
  const entryPoints = [];
  for (const match of text.matchAll(/\bfn\s+(\w+)\s*\(/g)) {
    const before = text.slice(0, match.index);
    const attributes = before.slice(Math.max(before.lastIndexOf('}'), before.lastIndexOf(';')) + 1);
    const stage = attributes.match(/@\s*(vertex|fragment|compute)\b/)?.[1];
    if (!stage) continue;
    const name = match[1];
    const open = match.index + match[0].length - 1;
    const close = closing(text, open);
    const inputs = located(split(text.slice(open + 1, close)), names);
    if (stage === 'compute') entryPoints.push({ name, stage });
    if (stage === 'vertex') entryPoints.push({ name, stage, buffers: bufferOf(inputs) });
    if (stage === 'fragment') {
      const result = text.slice(close + 1).match(/^\s*->\s*([^{]+)\{/)?.[1].trim() ?? '';
      // A name makes a member of it.
      const member = result.replace(/^((?:@\w+(?:\([^)]*\))?\s*)*)/, '$1 result: ');
      const depth = [result, ...(names.structs[result] ?? [])].some((part) => part.includes('frag_depth'));
      entryPoints.push({ name, stage, targets: targetsOf(located([member], names)), depth, vertexText: vertexTextFor(inputs) });
    }
  }
  const overrides = table(text, /\boverride\s+(\w+)\s*(?::[^=;]+)?;/g, () => 1);
  for (const [, id, name] of text.matchAll(/@id\((\d+)\)\s*override\s+(\w+)\b/g)) {
    if (name in overrides) {
      overrides[id] = overrides[name];
      delete overrides[name];
    }
  }
  return { entryPoints, constants: overrides };
}
