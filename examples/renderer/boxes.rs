//! The scene.

/// A colonnade with a roof of slats on a wide floor.
pub(super) fn boxes() -> Vec<[[f32; 3]; 3]> {
    let floor = [[0.0, -0.1, 0.0], [14.0, 0.1, 14.0], [0.62, 0.6, 0.56]];
    let wall = [[0.0, 1.6, -3.3], [4.6, 1.6, 0.1], [0.7, 0.66, 0.6]];
    let pillars = (0..10).map(|index| {
        let x = -4.0 + 2.0 * (index / 2) as f32;
        let z = if index % 2 == 0 { -2.4 } else { 1.6 };
        [[x, 1.5, z], [0.16, 1.5, 0.16], [0.72, 0.64, 0.52]]
    });
    let slats = (0..13).map(|index| {
        let x = -4.5 + 0.75 * index as f32;
        [[x, 3.1, -0.4], [0.24, 0.08, 2.9], [0.45, 0.36, 0.28]]
    });
    let crates = [[-1.2, 0.3, 0.4], [0.9, 0.2, -0.8], [2.6, 0.35, 0.7]]
        .map(|centre: [f32; 3]| [centre, [centre[1]; 3], [0.5, 0.58, 0.66]]);
    [floor, wall]
        .into_iter()
        .chain(pillars)
        .chain(slats)
        .chain(crates)
        .collect()
}
