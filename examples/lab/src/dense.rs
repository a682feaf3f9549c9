//! Small dense matrices in f64: linear systems, determinants, eigenvalues.

/// A square matrix as a product of a lower and an upper triangle, its rows permuted for the largest pivots.
#[derive(Clone, Debug)]
pub struct Factors {
    size: usize,
    /// Row by row: the upper triangle with the diagonal, and below it the multipliers.
    entries: Vec<f64>,
    /// Which row of the matrix each row of the triangles is.
    order: Vec<usize>,
    odd: bool,
}

impl Factors {
    /// Factors a matrix of `size` rows, given row by row; nothing if it is singular to rounding.
    #[must_use]
    pub fn new(size: usize, mut entries: Vec<f64>) -> Option<Self> {
        let mut order: Vec<usize> = (0..size).collect();
        let mut odd = false;
        for step in 0..size {
            let pivot = (step..size).max_by(|&one, &other| {
                let [one, other] = [one, other].map(|row| entries[row * size + step].abs());
                one.total_cmp(&other)
            })?;
            let value = entries[pivot * size + step];
            if value == 0.0 || !value.is_finite() {
                return None;
            }
            if pivot != step {
                for column in 0..size {
                    entries.swap(pivot * size + column, step * size + column);
                }
                order.swap(pivot, step);
                odd = !odd;
            }
            for row in step + 1..size {
                let factor = entries[row * size + step] / entries[step * size + step];
                entries[row * size + step] = factor;
                for column in step + 1..size {
                    entries[row * size + column] -= factor * entries[step * size + column];
                }
            }
        }
        Some(Self {
            size,
            entries,
            order,
            odd,
        })
    }

    /// x with A x = `right`.
    #[must_use]
    pub fn solve(&self, right: &[f64]) -> Vec<f64> {
        let at = |row: usize, column: usize| self.entries[row * self.size + column];
        let mut x: Vec<f64> = self.order.iter().map(|&row| right[row]).collect();
        for row in 0..self.size {
            for column in 0..row {
                x[row] -= at(row, column) * x[column];
            }
        }
        for row in (0..self.size).rev() {
            for column in row + 1..self.size {
                x[row] -= at(row, column) * x[column];
            }
            x[row] /= at(row, row);
        }
        x
    }

    /// y with A^T y = `right`.
    #[must_use]
    pub fn solve_transposed(&self, right: &[f64]) -> Vec<f64> {
        let at = |row: usize, column: usize| self.entries[row * self.size + column];
        let mut y = right.to_vec();
        for row in 0..self.size {
            for column in 0..row {
                y[row] -= at(column, row) * y[column];
            }
            y[row] /= at(row, row);
        }
        for row in (0..self.size).rev() {
            for column in row + 1..self.size {
                y[row] -= at(column, row) * y[column];
            }
        }
        let mut permuted = vec![0.0; self.size];
        for (&row, value) in self.order.iter().zip(y) {
            permuted[row] = value;
        }
        permuted
    }

    /// The determinant.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        let product: f64 = (0..self.size)
            .map(|row| self.entries[row * (self.size + 1)])
            .product();
        if self.odd { -product } else { product }
    }
}

/// The smallest eigenvalue of a symmetric matrix of `N` rows, by Jacobi's rotations: as accurate as the entries, which a
/// closed form is not where eigenvalues nearly coincide.
#[must_use]
pub fn smallest_eigenvalue<const N: usize>(mut a: [[f64; N]; N]) -> f64 {
    // Convergence is quadratic; a few sweeps do.
    for _ in 0..20 {
        let mut rotated = false;
        for p in 0..N {
            for q in p + 1..N {
                let off = a[p][q];
                if off.abs() <= 1e-18 * (a[p][p].abs() + a[q][q].abs()) {
                    continue;
                }
                rotated = true;
                let ratio = (a[q][q] - a[p][p]) / (2.0 * off);
                let tangent = ratio.signum() / (ratio.abs() + ratio.hypot(1.0));
                let cosine = 1.0 / tangent.hypot(1.0);
                let sine = tangent * cosine;
                for row in &mut a {
                    let (x, y) = (row[p], row[q]);
                    row[p] = cosine * x - sine * y;
                    row[q] = sine * x + cosine * y;
                }
                let (first, second) = (a[p], a[q]);
                a[p] = core::array::from_fn(|k| cosine * first[k] - sine * second[k]);
                a[q] = core::array::from_fn(|k| sine * first[k] + cosine * second[k]);
            }
        }
        if !rotated {
            break;
        }
    }
    (0..N).map(|row| a[row][row]).fold(f64::INFINITY, f64::min)
}

/// L with L L^T = `matrix`; nothing if it is not positive definite.
#[must_use]
pub fn cholesky<const N: usize>(matrix: [[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let mut l = [[0.0; N]; N];
    for row in 0..N {
        for column in 0..=row {
            let known: f64 = (0..column).map(|k| l[row][k] * l[column][k]).sum();
            let rest = matrix[row][column] - known;
            if row == column {
                if rest.is_nan() || rest <= 0.0 {
                    return None;
                }
                l[row][row] = rest.sqrt();
            } else {
                l[row][column] = rest / l[column][column];
            }
        }
    }
    Some(l)
}
