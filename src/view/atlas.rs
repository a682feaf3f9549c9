//! Where regions lie in the layers of a map.

use super::LightView;
use crate::{MapRegion, ValueError};

/// The size of a map whose layers views of lights share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Atlas {
    /// Texels in x and y.
    pub size: [u32; 2],
    /// How many layers there are.
    pub layers: u32,
}

/// A rectangle without a view.
#[derive(Clone, Copy)]
struct Free {
    layer: u32,
    region: MapRegion,
}

impl Atlas {
    /// Gives each view a layer and a place there; its region's extent, guard band included, stays. The largest are placed
    /// first, equal ones in their order, so that views of the same extents always have the same places.
    ///
    /// Views that each have as many texels as the map get a layer each.
    ///
    /// # Errors
    /// [`ValueError`], where a `region` has no extent of its own, or the `map` has no room. Nothing is then placed.
    pub fn place(&self, views: &mut [LightView]) -> Result<(), ValueError> {
        for (index, view) in views.iter().enumerate() {
            let extent = view.region.extent;
            if extent.contains(&0) || extent.contains(&u32::MAX) {
                let message = format!(
                    "view {index} has no extent that could be placed; give its region as many texels as it is to have"
                );
                return Err(ValueError::new("region", message));
            }
        }
        let mut order: Vec<usize> = (0..views.len()).collect();
        let longest = |index: &usize| views[*index].region.extent.into_iter().max();
        order.sort_by_key(|index| core::cmp::Reverse(longest(index)));
        let whole = MapRegion::new([0; 2], self.size);
        let layers = (0..self.layers).map(|layer| Free {
            layer,
            region: whole,
        });
        let mut free: Vec<Free> = layers.take(views.len()).collect();
        let mut places = Vec::new();
        for index in order {
            let place = take(&mut free, views[index].region.extent);
            let place = place.ok_or_else(|| self.no_room(index, views))?;
            places.push((index, place));
        }
        for (index, Free { layer, region }) in places {
            (views[index].layer, views[index].region) = (layer, region);
        }
        Ok(())
    }

    /// Checks views that a host has placed: each region lies in the map, has texels within its guard band, and none with
    /// another one.
    ///
    /// # Errors
    /// [`ValueError`] about the `region` or the `guard` of a view.
    pub fn check(&self, views: &[LightView]) -> Result<(), ValueError> {
        for (index, view) in views.iter().enumerate() {
            let refuse = |message| Err(ValueError::new("region", message));
            let fits = |axis: usize| {
                let MapRegion { origin, extent } = view.region;
                let end = u64::from(origin[axis]) + u64::from(extent[axis]);
                extent[axis] > 0 && end <= u64::from(self.size[axis])
            };
            let whole = view.region == MapRegion::WHOLE;
            if view.layer >= self.layers || !(whole || (fits(0) && fits(1))) {
                let [width, height] = self.size;
                return refuse(format!(
                    "view {index} lies in layer {} at {:?} with {:?} texels, which is not within a map of {width}x{height} \
                     texels and {} layers",
                    view.layer, view.region.origin, view.region.extent, self.layers
                ));
            }
            view.check_border(if whole { self.size } else { view.region.extent })?;
            let overlaps = |other: &LightView| {
                other.layer == view.layer && other.region.overlaps(&view.region)
            };
            if let Some(first) = views[..index].iter().position(overlaps) {
                return refuse(format!(
                    "views {first} and {index} overlap in layer {}; each texel belongs to one region",
                    view.layer
                ));
            }
        }
        Ok(())
    }

    fn no_room(&self, index: usize, views: &[LightView]) -> ValueError {
        let ([width, height], [of_x, of_y]) = (self.size, views[index].region.extent);
        let message = format!(
            "a map of {width}x{height} texels and {} layers has no room for view {index} of {} with {of_x}x{of_y} texels; give it \
             more layers or texels, or views fewer",
            self.layers,
            views.len()
        );
        ValueError::new("map", message)
    }
}

/// Takes a rectangle from the free one that leaves the least along one side, and of equal ones the first.
fn take(free: &mut Vec<Free>, extent: [u32; 2]) -> Option<Free> {
    let left = |free: &Free| {
        let [x, y] = free.region.extent;
        Some([x.checked_sub(extent[0])?, y.checked_sub(extent[1])?])
    };
    let candidates = free.iter().enumerate();
    let candidates = candidates.filter_map(|(index, free)| Some((index, left(free)?)));
    let (index, [across, down]) = candidates.min_by_key(|(_, [x, y])| *x.min(y))?;
    let Free { layer, region } = free.remove(index);
    let [x, y] = region.origin;
    // The larger rest stays whole.
    let (height, width) = if across > down {
        (region.extent[1], extent[0])
    } else {
        (extent[1], region.extent[0])
    };
    let rests = [
        MapRegion::new([x + extent[0], y], [across, height]),
        MapRegion::new([x, y + extent[1]], [width, down]),
    ];
    let rests = rests
        .into_iter()
        .filter(|rest| !rest.extent.contains(&0))
        .map(|region| Free { layer, region });
    // In the place of what they were taken from, so that layers are filled one after the other.
    free.splice(index..index, rests);
    let region = MapRegion::new([x, y], extent);
    Some(Free { layer, region })
}
