//! How pictures change from frame to frame where the truth hardly does.

use serde::Serialize;

/// How much the radiance of pixels in a static region changes between successive frames, in parts of the mean radiance
/// without shadows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Change {
    /// The largest change.
    pub largest: f64,
    /// One in a thousand changes is larger.
    pub thousandth: f64,
    /// The mean.
    pub mean: f64,
    /// The largest difference from the change of the truth.
    pub largest_less_truth: f64,
    /// Where the largest change is; none in an empty region.
    pub at: Option<Place>,
}

/// A pixel of two successive frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Place {
    /// The earlier frame.
    pub frame: usize,
    /// The pixel, row by row from the top left.
    pub pixel: usize,
}

/// For each pair of successive frames, which pixels are static: those of which no truth changes by more than `still` between any
/// two successive frames, from `window` before the first of the pair to `window` after the second.
///
/// Truths are radiance by marched rays, with shadows and without, of all frames, pixel by pixel. With shadows it changes where a
/// shaft moves through a view ray; without any where a ray ends elsewhere, since an edge of the scene passes the pixel, though what
/// lies before and behind it may be as bright. What is left are changes that should not be seen at all.
#[must_use]
pub fn static_region(truths: [&[Vec<f32>]; 2], still: f32, window: usize) -> Vec<Vec<bool>> {
    let calm = |truth: &[Vec<f32>]| -> Vec<Vec<bool>> {
        let pairs = truth.windows(2).map(|pair| {
            let changes = pair[0].iter().zip(&pair[1]);
            changes
                .map(|(before, after)| (after - before).abs() <= still)
                .collect()
        });
        pairs.collect()
    };
    let [shadowed, unshadowed] = truths.map(calm);
    let calm: Vec<Vec<bool>> = (shadowed.iter().zip(&unshadowed))
        .map(|(one, other)| {
            one.iter()
                .zip(other)
                .map(|(one, other)| *one && *other)
                .collect()
        })
        .collect();
    (0..calm.len())
        .map(|index| {
            let around = &calm[index.saturating_sub(window)..calm.len().min(index + window + 1)];
            let pixels = calm[index].len();
            (0..pixels)
                .map(|pixel| around.iter().all(|calm| calm.get(pixel) == Some(&true)))
                .collect()
        })
        .collect()
}

impl Change {
    /// The change over some frames, in the region of each pair. Frames with a pixel that is not a number are infinitely far off.
    #[must_use]
    pub fn of(frames: &[Vec<f32>], truth: &[Vec<f32>], region: &[Vec<bool>]) -> Self {
        let mut changes = Vec::new();
        let mut largest_less_truth: f64 = 0.0;
        let mut at: Option<(f64, Place)> = None;
        let pairs = frames.windows(2).zip(truth.windows(2)).zip(region);
        for (frame, ((pair, true_pair), region)) in pairs.enumerate() {
            for (pixel, _) in region
                .iter()
                .enumerate()
                .filter(|(_, is_static)| **is_static)
            {
                let of = |pair: &[Vec<f32>]| f64::from(pair[1][pixel]) - f64::from(pair[0][pixel]);
                let number = |value: f64| if value.is_nan() { f64::INFINITY } else { value };
                let (change, true_change) = (of(pair), of(true_pair));
                let size = number(change.abs());
                changes.push(size);
                if at.is_none_or(|(largest, _)| size > largest) {
                    at = Some((size, Place { frame, pixel }));
                }
                largest_less_truth = largest_less_truth.max(number((change - true_change).abs()));
            }
        }
        changes.sort_unstable_by(f64::total_cmp);
        let count = changes.len();
        let Some(&largest) = changes.last() else {
            return Self::default();
        };
        Self {
            largest,
            thousandth: changes[count - 1 - count / 1000],
            mean: changes.iter().sum::<f64>() / count as f64,
            largest_less_truth,
            at: at.map(|(_, place)| place),
        }
    }
}
