// Matrices of four columns with four numbers each, in double precision.
//
// Products of single-precision matrices with large translations lose digits, and shadows then move by texels: give matrices as
// numbers of JavaScript, or relative to the camera.

import { isFinite, largest, scaled, sum } from './vector.js';
import { ValueError } from './value_error.js';

/** The columns of a matrix: four arrays of four numbers, or an array of 16 as WebGPU's matrices lie in memory. */
export function columns(matrix, name) {
  const flat = Array.from(matrix ?? []).flatMap((entry) => (typeof entry === 'number' ? entry : Array.from(entry)));
  if (flat.length !== 16 || flat.some((entry) => typeof entry !== 'number')) {
    throw new ValueError(name, `the ${name}'s clipFromWorld is no matrix; give 16 numbers, column after column`);
  }
  return [0, 4, 8, 12].map((at) => flat.slice(at, at + 4));
}

export const row = (matrix, index) => matrix.map((column) => column[index]);
export const transposed = (matrix) => [0, 1, 2, 3].map((index) => row(matrix, index));
export const diagonal = (values) => values.map((value, at) => [0, 1, 2, 3].map((index) => (index === at ? value : 0)));

/** A matrix times a vector. */
export const transformed = (matrix, vector) =>
  vector.map((factor, index) => scaled(matrix[index], factor)).reduce(sum);

/** The product of two matrices. */
export const product = (a, b) => b.map((column) => transformed(a, column));

/** The refusal of the matrix of a `camera` or a `light`. */
export const singular = (name) =>
  new ValueError(
    name,
    `the ${name}'s clipFromWorld is singular or not finite; it has to be the invertible projection that its picture was drawn with`,
  );

// The largest difference between the identity and the product of a matrix and its inverse: beyond it the inverse is rounding
// error.
const LARGEST_RESIDUAL = 1e-6;

/** The inverse of the matrix of a `camera` or a `light`; an error if there is none, or if entries are not finite. */
export function inverse(matrix, name) {
  // Rows of very different size, as projections have them, are scaled to a largest entry of 1.
  const scale = diagonal([0, 1, 2, 3].map((index) => 1 / largest(row(matrix, index))));
  const even = product(scale, matrix);
  const inverted = byCofactors(even);
  const residual = product(inverted, even).flatMap((column, at) => column.map((entry, index) => entry - (index === at)));
  const unscaled = product(inverted, scale);
  if (isFinite(unscaled.flat()) && residual.every((entry) => Math.abs(entry) <= LARGEST_RESIDUAL)) return unscaled;
  throw singular(name);
}

function byCofactors([a, b, c, d]) {
  // Of two rows, the determinants of two columns: those of c and d, of b and d (twice as often), of b and c.
  const pairs = (i, j) => {
    const minor = (p, q) => p[i] * q[j] - q[i] * p[j];
    return [minor(c, d), minor(c, d), minor(b, d), minor(b, c)];
  };
  const [zw, yw, yz, xw, xz, xy] = [pairs(2, 3), pairs(1, 3), pairs(1, 2), pairs(0, 3), pairs(0, 2), pairs(0, 1)];
  const [x, y, z, w] = [0, 1, 2, 3].map((index) => [b[index], a[index], a[index], a[index]]);
  const cofactors = (sign, [u, p], [v, q], [t, r]) =>
    [0, 1, 2, 3].map((at) => (u[at] * p[at] - v[at] * q[at] + t[at] * r[at]) * (at % 2 === 0 ? sign : -sign));
  const adjugate = [
    cofactors(1, [y, zw], [z, yw], [w, yz]),
    cofactors(-1, [x, zw], [z, xw], [w, xz]),
    cofactors(1, [x, yw], [y, xw], [w, xy]),
    cofactors(-1, [x, yz], [y, xz], [z, xy]),
  ];
  const determinant = a[0] * adjugate[0][0] + a[1] * adjugate[1][0] + a[2] * adjugate[2][0] + a[3] * adjugate[3][0];
  return adjugate.map((column) => scaled(column, 1 / determinant));
}
