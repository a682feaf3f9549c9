// How two verdicts of a text compare.

// Rules by which we say that a shader is WGSL, and that not everybody who takes WGSL takes it.
const UNSUPPORTED = ['unsupported', 'feature'];

// Tint misses a name: the text lacks what a program joins to it.
export const isFragment = (objections) => /unresolved (value|type|call target|identifier)/.test(objections[0] ?? '');

// `ours` and `theirs` are what each objects to; nothing is "accepts".
export function compare(ours, theirs) {
  if ((ours.length > 0) === (theirs.length > 0)) return 'agreed';
  if (ours.length === 0) return 'laxer';
  return ours.every(({ rule }) => UNSUPPORTED.includes(rule)) ? 'unsupported' : 'stricter';
}

// What the one that refuses says first, in a line.
export function firstObjection(ours, theirs) {
  const [finding] = ours;
  const place = finding?.places[0];
  const said = finding ? `${place ? `${place.line}:${place.column}: ` : ''}${finding.rule}: ${finding.message}` : theirs[0];
  return said.replace(/\s+/g, ' ').trim().slice(0, 200);
}
