// Counts of verdicts by group, as a table.

const COLUMNS = ['texts', 'agreed', 'stricter', 'laxer', 'unsupported'];
const HEADS = ['texts', 'agreed', 'ours stricter', 'ours laxer', 'said to be unsupported'];

const none = () => Object.fromEntries(COLUMNS.map((column) => [column, 0]));

export class Counts {
  groups = new Map();
  total = none();

  add(group, verdict) {
    if (!this.groups.has(group)) this.groups.set(group, none());
    for (const counts of [this.groups.get(group), this.total]) {
      counts.texts += 1;
      counts[verdict] += 1;
    }
  }

  print(head) {
    const rows = [...this.groups, ['together', this.total]];
    const width = Math.max(head.length, ...rows.map(([group]) => group.length));
    const line = (first, cells) => [first.padEnd(width), ...cells.map((cell, at) => String(cell).padStart(HEADS[at].length))].join('  ');
    console.log(`\n${line(head, HEADS)}`);
    for (const [group, counts] of rows) console.log(line(group, COLUMNS.map((column) => counts[column])));
  }
}
