// Numbers as single precision has them. Everything is computed in double precision and rounded once, at the end.

/** The nearest number of single precision, to even where two are as near. */
export const single = Math.fround;

/** Whether a number is normal in single precision: neither 0 nor so small that it loses digits, and finite. */
export const isNormal = (value) => Math.abs(single(value)) >= 2 ** -126 && Number.isFinite(single(value));

/** The nearest whole number, away from 0 where two are as near. */
export const whole = (value) => Math.sign(value) * Math.round(Math.abs(value));
