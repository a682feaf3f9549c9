// The whole WGSL texts in a file of a package.

import { readFileSync } from 'node:fs';
import { extname } from 'node:path';

const ENTRY_POINT = /@\s*(compute|vertex|fragment)\b/;

export const uncommented = (text) => text.replace(/\/\/.*|\/\*[^]*?\*\//g, ' ');
export const hasEntryPoint = (text) => ENTRY_POINT.test(uncommented(text));

// The string literals of a source text that stand on their own: not one part of a sum, nor the start of a method chain.
const LITERALS = {
  // Template literals. A backtick that ends one is followed by other things than the start of an expression.
  js: /(?<=(?:[=(:,?[]|=>|return|wgsl|glsl|\*\/)\s*)`((?:[^`\\]|\\[^])*)`(?!\s*[+.]\s*\w*\()/g,
  rs: /(?<=[=(:,[{>&]\s*)r(#+)"([^]*?)"\1/g,
};
const LANGUAGES = { '.js': 'js', '.mjs': 'js', '.cjs': 'js', '.ts': 'js', '.rs': 'rs' };

// The WGSL texts of a file: all of a WGSL file, and of a program the literals with an entry point.
export function textsOf(path) {
  const extension = extname(path);
  const language = LANGUAGES[extension];
  if (extension !== '.wgsl' && !language) return [];
  const source = readFileSync(path, 'utf8');
  if (extension === '.wgsl') return [source.replace(/^\uFEFF/, '')];
  if (!ENTRY_POINT.test(source)) return [];
  return [...source.matchAll(LITERALS[language])]
    .map((match) => match.at(-1))
    .map((text) => (language === 'rs' ? text : text.replace(/\\([nt`\\])/g, (_, one) => ({ n: '\n', t: '\t' })[one] ?? one)))
    .filter((text) => hasEntryPoint(text) && /\bfn\s+\w+\s*\(/.test(text));
}

// Whether a text is written for some preprocessor. None of these characters is of WGSL, nor are two colons, imports and
// conditions; two braces in a row are a template's.
export function isDialect(text) {
  return /[#$\\`"'?]|::|\{\{|\{%|^\s*import\b|@(if|elif|else)\b/m.test(uncommented(text));
}
