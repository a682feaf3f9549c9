//! Small dense matrices in f64: inverses, eigenvalues, triangles.

use core::array::from_fn;

/// The inverse of a regular matrix, by elimination with the largest pivots.
#[must_use]
pub fn inverse<const M: usize>(mut matrix: [[f64; M]; M]) -> [[f64; M]; M] {
    let mut inverse: [[f64; M]; M] =
        from_fn(|row| from_fn(|column| f64::from(u8::from(row == column))));
    for step in 0..M {
        let size = |&row: &usize| matrix[row][step].abs();
        let pivot = (step..M)
            .max_by(|one, other| size(one).total_cmp(&size(other)))
            .unwrap_or(step);
        for rows in [&mut matrix, &mut inverse] {
            rows.swap(step, pivot);
        }
        for row in (0..M).filter(|&row| row != step) {
            let factor = matrix[row][step] / matrix[step][step];
            for rows in [&mut matrix, &mut inverse] {
                let subtracted = rows[step];
                rows[row] = from_fn(|column| rows[row][column] - factor * subtracted[column]);
            }
        }
    }
    from_fn(|row| inverse[row].map(|entry| entry / matrix[row][row]))
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
                a[p] = from_fn(|k| cosine * first[k] - sine * second[k]);
                a[q] = from_fn(|k| sine * first[k] + cosine * second[k]);
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
