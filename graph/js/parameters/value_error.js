// Values that are refused.

/** A value that is refused: `subject` is what the value is, the message says what is wrong with it and what is legal. */
export class ValueError extends Error {
  constructor(subject, message) {
    super(message);
    this.name = 'ValueError';
    this.subject = subject;
  }
}

/** Refuses a value that is not `valid`; `of` is what it belongs to. */
export function check(valid, of, subject, value, legal) {
  if (!valid) throw new ValueError(subject, `${of}: ${subject} is ${value}, but must be ${legal}`);
}

/** A number, or an error: what is left out would otherwise become NaN without a word. */
export function number(subject, value) {
  if (typeof value === 'number') return value;
  throw new ValueError(subject, `${subject} is ${value}, but must be a number`);
}
