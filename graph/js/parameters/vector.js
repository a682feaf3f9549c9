// Vectors as arrays, in double precision. Sums are taken from the first component to the last.

export const dot = (a, b) => a.reduce((sum, value, index) => (index === 0 ? value * b[0] : sum + value * b[index]), 0);
export const cross = ([ax, ay, az], [bx, by, bz]) => [ay * bz - by * az, az * bx - bz * ax, ax * by - bx * ay];
export const length = (vector) => Math.sqrt(dot(vector, vector));
export const scaled = (vector, factor) => vector.map((value) => value * factor);
export const sum = (a, b) => a.map((value, index) => value + b[index]);
export const difference = (a, b) => a.map((value, index) => value - b[index]);
export const isFinite = (vector) => vector.every(Number.isFinite);
export const largest = (vector) => vector.reduce((most, value) => (Math.abs(value) > most ? Math.abs(value) : most), 0);
