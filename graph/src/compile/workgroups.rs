//! How many workgroups a dispatch has.

use crate::error::ensure;
use crate::{Capabilities, GraphError, GraphErrorKind};

/// A grid of workgroups over a texture.
fn grid(
    [width, height]: [u32; 2],
    [across, down]: [u32; 2],
    capabilities: &Capabilities,
) -> Result<[u32; 2], GraphError> {
    ensure(
        across > 0 && down > 0,
        GraphErrorKind::Declaration,
        || "a workgroup covers no texel",
    )?;
    let [x, y] = [width.div_ceil(across), height.div_ceil(down)];
    let largest = capabilities.max_workgroups;
    ensure(x.max(y) <= largest, GraphErrorKind::Size, || {
        let most = |texels| u64::from(largest) * u64::from(texels);
        format!(
            "covering {width}x{height} texels takes {x}x{y} workgroups; the device allows {largest}, so at most {}x{} texels",
            most(across),
            most(down)
        )
    })?;
    Ok([x, y])
}

/// Enough workgroups for any regions of a layer that do not overlap.
///
/// A single one is at most as large as the layer and gets a grid. Several with sides w and h take at most the sum of
/// (w + t - 1) (h + u - 1) / (t u) workgroups of t x u texels, whose areas w h sum up to that of the layer. Of the sums of
/// the sides, the sum of (u - 1) w + (t - 1) h is largest for strips as long as the layer, where it stays below
/// (regions + 1) times the larger of (u - 1) width and (t - 1) height.
pub(super) fn for_regions(
    size: [u32; 2],
    regions: u32,
    texels_per_workgroup: [u32; 2],
    capabilities: &Capabilities,
) -> Result<[u32; 2], GraphError> {
    let groups = grid(size, texels_per_workgroup, capabilities)?;
    if regions <= 1 {
        return Ok(groups);
    }
    let [width, height] = size.map(u64::from);
    let [across, down] = texels_per_workgroup.map(u64::from);
    let regions = u64::from(regions);
    let strips = ((down - 1) * width).max((across - 1) * height);
    let texels = width * height + (regions + 1) * strips + regions * (across - 1) * (down - 1);
    let each_whole = regions * u64::from(groups[0]) * u64::from(groups[1]);
    let count = (texels / (across * down)).min(each_whole).max(1);
    let largest = u64::from(capabilities.max_workgroups);
    let rows = count.div_ceil(largest);
    ensure(rows <= largest, GraphErrorKind::Size, || {
        format!(
            "{regions} regions of {width}x{height} texels take {count} workgroups; the device allows {largest} times \
             {largest}, so describe the map with fewer regions",
        )
    })?;
    // Rows of equal length, so that few workgroups are left over; both fit u32.
    Ok([count.div_ceil(rows) as u32, rows as u32])
}

#[cfg(test)]
mod tests {
    use moment_shadows::{MapRegion, Profile};

    use super::*;

    /// Workgroups that the shaders number through for these regions.
    fn needed(regions: &[MapRegion], tile: [u32; 2]) -> u64 {
        let groups = |side: u32, tile: u32| u64::from(side.div_ceil(tile));
        regions
            .iter()
            .map(|region| groups(region.extent[0], tile[0]) * groups(region.extent[1], tile[1]))
            .sum()
    }

    /// A layer cut into `count` regions: rows, columns, or a guillotine that `seed` steers.
    fn cut(size: [u32; 2], count: usize, seed: u32) -> Vec<MapRegion> {
        let mut regions = vec![MapRegion::new([0, 0], size)];
        let mut state = seed;
        let mut next = |below: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) % below.max(1)
        };
        while regions.len() < count {
            let axis = [0, 1, next(2)][(seed % 3) as usize] as usize;
            let large = |&index: &usize| regions[index].extent[axis] > 1;
            let large: Vec<usize> = (0..regions.len()).filter(large).collect();
            let Some(&index) = large.get(next(large.len() as u32) as usize) else {
                break;
            };
            let region = regions[index];
            let at = 1 + next(region.extent[axis] - 1);
            regions[index].extent[axis] = at;
            let mut rest = region;
            rest.origin[axis] += at;
            rest.extent[axis] -= at;
            regions.push(rest);
        }
        regions
    }

    #[test]
    fn there_are_enough_workgroups_for_any_regions() {
        let capabilities = Capabilities::of_profile(Profile::Native);
        for tile in [[8, 8], [64, 8], [64, 1], [8, 64], [128, 8], [8, 128]] {
            for size in [[256, 256], [1000, 37], [64, 512]] {
                for count in [2, 3, 7, 16, 36] {
                    for seed in 0..60 {
                        let regions = cut(size, count, seed);
                        let [x, y] = for_regions(size, count as u32, tile, &capabilities)
                            .unwrap_or_default();
                        let given = u64::from(x) * u64::from(y);
                        let needed = needed(&regions, tile);
                        assert!(
                            needed <= given,
                            "{needed} of {given} for {count} regions of {size:?} by {tile:?}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn all_that_are_given_may_be_needed() {
        // Every side is one texel longer than tiles that it takes whole.
        let rows = (0..9).map(|row| MapRegion::new([0, 9 * row], [81, 9]));
        let rows: Vec<MapRegion> = rows.collect();
        assert_eq!(needed(&rows, [8, 8]), 198);
        let capabilities = Capabilities::of_profile(Profile::Native);
        let groups = for_regions([81, 81], 9, [8, 8], &capabilities);
        assert_eq!(groups.ok(), Some([198, 1]));
    }

    #[test]
    fn one_region_takes_a_grid() {
        let capabilities = Capabilities::of_profile(Profile::Native);
        let groups = for_regions([1000, 37], 1, [64, 8], &capabilities);
        assert_eq!(groups.ok(), Some([16, 5]));
    }
}
