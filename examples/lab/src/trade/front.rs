//! Fronts: what nothing else beats in both of two figures.

/// The numbers of the points that no other point beats: none is at most as large in both figures and smaller in one. In the order of
/// the first figure; of equal points the first.
#[must_use]
pub fn front(points: &[[f64; 2]]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.retain(|&at| points[at].iter().all(|figure| figure.is_finite()));
    order.sort_by(|&one, &other| {
        let [one, other] = [points[one], points[other]];
        one[0]
            .total_cmp(&other[0])
            .then(one[1].total_cmp(&other[1]))
    });
    let mut least = f64::INFINITY;
    order.retain(|&at| {
        let is_less = points[at][1] < least;
        least = least.min(points[at][1]);
        is_less
    });
    order
}

#[cfg(test)]
mod tests {
    use super::front;

    #[test]
    fn what_is_beaten_is_left_out() {
        let points = [
            [2.0, 2.0],
            [1.0, 3.0],
            [2.0, 3.0],
            [3.0, 1.0],
            [3.0, 1.0],
            [4.0, 1.0],
            [0.5, f64::NAN],
        ];
        assert_eq!(front(&points), [1, 0, 3]);
        assert_eq!(front(&[]), [0_usize; 0]);
    }
}
