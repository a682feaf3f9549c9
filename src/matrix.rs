//! 4x4 matrices by columns in f64, as far as the host side needs them.

/// By columns.
pub(crate) type Matrix = [[f64; 4]; 4];

/// A pivot below this share of its row's largest entry is the rounding error of a singular matrix.
const SMALLEST_PIVOT: f64 = 1e-13;

/// A matrix of f32, for products that keep its precision.
pub(crate) fn wide(matrix: &[[f32; 4]; 4]) -> Matrix {
    matrix.map(|column| column.map(f64::from))
}

/// The inverse; `None` where there is none, or where entries are not finite.
pub(crate) fn invert(matrix: &Matrix) -> Option<Matrix> {
    // Rows of (matrix | identity), each scaled to a largest entry of 1.
    let mut rows = [[0.0; 8]; 4];
    for (index, row) in rows.iter_mut().enumerate() {
        let entries = [0, 1, 2, 3].map(|column| matrix[column][index]);
        let largest = entries.map(f64::abs).into_iter().fold(0.0, f64::max);
        if !(largest > 0.0 && entries.iter().all(|entry| entry.is_finite())) {
            return None;
        }
        for column in 0..4 {
            row[column] = entries[column] / largest;
        }
        row[4 + index] = 1.0 / largest;
    }
    for step in 0..4 {
        let best =
            (step..4).max_by(|&a, &b| rows[a][step].abs().total_cmp(&rows[b][step].abs()))?;
        rows.swap(step, best);
        let pivot = rows[step][step];
        if pivot.abs() < SMALLEST_PIVOT {
            return None;
        }
        rows[step] = rows[step].map(|entry| entry / pivot);
        let of_step = rows[step];
        for (index, row) in rows.iter_mut().enumerate() {
            let factor = row[step];
            if index != step {
                for (entry, subtracted) in row.iter_mut().zip(of_step) {
                    *entry -= factor * subtracted;
                }
            }
        }
    }
    let mut inverse = [[0.0; 4]; 4];
    for (column, values) in inverse.iter_mut().enumerate() {
        *values = [0, 1, 2, 3].map(|row: usize| rows[row][4 + column]);
    }
    let finite = inverse.iter().flatten().all(|entry| entry.is_finite());
    finite.then_some(inverse)
}

/// A vector of three numbers.
pub(crate) type Vector = [f64; 3];

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub(crate) fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// `x a + y b + z c`.
pub(crate) fn combine([x, y, z]: Vector, [a, b, c]: [Vector; 3]) -> Vector {
    [0, 1, 2].map(|axis: usize| x * a[axis] + y * b[axis] + z * c[axis])
}

/// The vector of length 1; `None` where there is none.
pub(crate) fn normalized(a: Vector) -> Option<Vector> {
    let largest = a.map(f64::abs).into_iter().fold(0.0, f64::max);
    if !(largest > 0.0 && a.iter().all(|entry| entry.is_finite())) {
        return None;
    }
    let scaled = a.map(|entry| entry / largest);
    let length = length(scaled);
    Some(scaled.map(|entry| entry / length))
}
