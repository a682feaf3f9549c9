//! Places of regions.

use moment_shadows::{Atlas, LightView, MapRegion};
use rand::RngExt as _;

use crate::random;

fn view(extent: [u32; 2], guard: u32) -> LightView {
    LightView {
        region: MapRegion::new([0; 2], extent),
        guard,
        ..LightView::orthographic([[0.0; 4]; 4])
    }
}

/// Each texel of all layers belongs to one region at most: counted, not compared.
fn assert_apart(atlas: Atlas, views: &[LightView]) -> u32 {
    let [width, height] = atlas.size.map(|texels| texels as usize);
    let mut taken = vec![false; width * height * atlas.layers as usize];
    for view in views {
        let MapRegion { origin, extent } = view.region;
        for y in origin[1]..origin[1] + extent[1] {
            for x in origin[0]..origin[0] + extent[0] {
                assert!((x as usize) < width && (y as usize) < height);
                let texel =
                    &mut taken[(view.layer as usize * height + y as usize) * width + x as usize];
                assert!(!*texel, "{view:?}");
                *texel = true;
            }
        }
    }
    taken.iter().map(|&taken| u32::from(taken)).sum()
}

#[test]
fn regions_of_any_sizes_are_apart_and_keep_their_extents() {
    let mut random = random();
    let mut refused = 0;
    for _ in 0..300 {
        let atlas = Atlas {
            size: [random.random_range(40..120), random.random_range(40..120)],
            layers: random.random_range(1..4),
        };
        let count = random.random_range(1..30);
        let mut views: Vec<LightView> = (0..count)
            .map(|_| view([random.random_range(1..50), random.random_range(1..50)], 0))
            .collect();
        let before = views.clone();
        match atlas.place(&mut views) {
            Ok(()) => {
                assert_apart(atlas, &views);
                atlas.check(&views).unwrap();
                for (view, before) in views.iter().zip(&before) {
                    assert_eq!(view.region.extent, before.region.extent);
                }
            }
            Err(error) => {
                assert_eq!(error.name, "map");
                assert_eq!(views, before);
                refused += 1;
            }
        }
    }
    assert!((10..250).contains(&refused), "{refused}");
}

#[test]
fn regions_that_fit_fill_a_map() {
    let atlas = Atlas {
        size: [64; 2],
        layers: 1,
    };
    // Small ones first: those are not to take the room of the large one.
    let mut views = vec![view([16; 2], 3); 4];
    views.push(view([48, 64], 3));
    atlas.place(&mut views).unwrap();
    assert_eq!(assert_apart(atlas, &views), 64 * 64);
    // The larger of what is left beside a region stays whole.
    let atlas = Atlas {
        size: [100, 60],
        layers: 1,
    };
    let mut views = [[60, 40], [40, 60], [60, 20]].map(|extent| view(extent, 0));
    atlas.place(&mut views).unwrap();
    assert_eq!(assert_apart(atlas, &views), 6000);
}

#[test]
fn views_as_large_as_the_map_have_a_layer_each() {
    let atlas = Atlas {
        size: [64; 2],
        layers: 4,
    };
    let mut views = vec![view([64; 2], 3); 4];
    atlas.place(&mut views).unwrap();
    for (index, view) in views.iter().enumerate() {
        assert_eq!((view.layer, view.region.origin), (index as u32, [0; 2]));
    }
}

#[test]
fn places_that_cannot_be_are_refused() {
    let atlas = Atlas {
        size: [100, 60],
        layers: 2,
    };
    let at = |layer, origin, extent| LightView {
        layer,
        region: MapRegion::new(origin, extent),
        ..view(extent, 0)
    };
    let whole = LightView::orthographic([[0.0; 4]; 4]);
    let first = at(0, [0, 0], [50, 50]);
    let cases: [(&[LightView], Result<(), &str>); 9] = [
        (&[first, at(0, [50, 0], [50, 60])], Ok(())),
        (&[first, at(1, [10, 0], [50, 60]), first], Err("region")),
        (&[first, at(0, [49, 49], [2, 2])], Err("region")),
        (&[first, whole], Err("region")),
        (&[at(2, [0, 0], [5, 5])], Err("region")),
        (&[at(0, [51, 0], [50, 5])], Err("region")),
        (&[at(0, [u32::MAX - 1, 0], [50, 5])], Err("region")),
        (&[view([20, 60], 10)], Err("guard")),
        (&[LightView { guard: 30, ..whole }], Err("guard")),
    ];
    for (index, (views, expected)) in cases.into_iter().enumerate() {
        let found = atlas.check(views).map_err(|error| error.name);
        assert_eq!(found, expected, "{index}");
    }
    for (mut views, expected) in [
        (vec![whole], "region"),
        (vec![view([0, 4], 0)], "region"),
        (vec![view([101, 4], 0)], "map"),
        (vec![view([60, 40], 0); 3], "map"),
    ] {
        let found = atlas.place(&mut views).unwrap_err();
        assert_eq!(found.name, expected, "{found}");
    }
}
