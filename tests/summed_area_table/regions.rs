//! Tables of atlases: every region is a map of its own, and what is not listed stays.

use moment_shadows::{MapRegion, Storage, Technique};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::Layers;
use moment_shadows_lab::summed_area::{SummedMap, reference};

use crate::setup::{both, encoding, gpu, map, noise};

const SIZE: [u32; 2] = [150, 97];

/// An atlas whose regions touch anywhere but at multiples of a tile: single texels, lines, one beside and above another.
fn atlas() -> Vec<MapRegion> {
    vec![
        MapRegion::new([0, 0], [37, 41]),
        MapRegion::new([37, 0], [1, 41]),
        MapRegion::new([38, 0], [70, 19]),
        MapRegion::new([38, 19], [5, 5]),
        MapRegion::new([43, 19], [65, 5]),
        MapRegion::new([38, 24], [70, 17]),
        MapRegion::new([108, 0], [42, 50]),
        MapRegion::new([0, 41], [108, 1]),
        MapRegion::new([0, 42], [53, 55]),
        MapRegion::new([53, 42], [55, 55]),
        MapRegion::new([108, 50], [42, 46]),
        MapRegion::new([108, 96], [1, 1]),
    ]
}

#[test]
fn regions_that_touch_do_not_see_each_other() {
    let gpu = gpu();
    for (technique, storage) in [
        (Technique::Hamburger4, Storage::Unorm16),
        (Technique::Vsm, Storage::Float16),
    ] {
        let source = encoding(technique, storage);
        let channels = source.technique().row().channels as usize;
        let regions = atlas();
        let desc = TextureDesc {
            regions: regions.len() as u32,
            ..map(&source, SIZE, 2)
        };
        let bytes = noise(&desc, 5);
        for capabilities in both(&gpu) {
            let summed = SummedMap::new(&gpu, &capabilities, &desc, &bytes, [9; 2]).unwrap();
            let table = *summed
                .desc()
                .unwrap()
                .encoding
                .as_ref()
                .unwrap()
                .table()
                .unwrap();
            let second = &bytes[bytes.len() / 2..];
            let integers = reference::integers(&source, &table, second);
            let expect = |regions: &[MapRegion]| {
                reference::table(&integers, channels, SIZE[0] as usize, regions)
            };
            // The first region alone: all others keep what they had, nothing.
            summed.set_regions(&gpu, 1, &regions[..1]).unwrap();
            summed.run(&gpu, Layers::Only(&[1])).unwrap();
            let label = format!("{source}, software {}", capabilities.software_adapter);
            assert!(
                summed.read(&gpu, 1).unwrap() == expect(&regions[..1]),
                "first, {label}"
            );
            // The others, in another order than they lie in: the first one keeps its table.
            let mut others = regions[1..].to_vec();
            others.reverse();
            summed.set_regions(&gpu, 1, &others).unwrap();
            summed.run(&gpu, Layers::Only(&[1])).unwrap();
            assert!(
                summed.read(&gpu, 1).unwrap() == expect(&regions),
                "all, {label}"
            );
            // The layer that was not dirty has none.
            assert!(
                summed.read(&gpu, 0).unwrap().iter().all(|&sum| sum == 0),
                "{label}"
            );
        }
    }
}

/// Where a map has one region, that may still be a part of it.
#[test]
fn a_single_region_leaves_the_rest_alone() {
    let gpu = gpu();
    let source = encoding(Technique::Hamburger4, Storage::Unorm16);
    let desc = map(&source, SIZE, 1);
    let bytes = noise(&desc, 6);
    let integers = bytes
        .chunks_exact(2)
        .map(|pair| u32::from(u16::from_le_bytes([pair[0], pair[1]])))
        .collect::<Vec<_>>();
    for capabilities in both(&gpu) {
        // Of a tile's 16 columns that lie last 4, 1, 1, 13, 8 and 12.
        for region in [
            MapRegion::new([13, 7], [100, 80]),
            MapRegion::new([3, 95], [17, 2]),
            MapRegion::new([149, 0], [1, 97]),
            MapRegion::new([5, 11], [45, 33]),
            MapRegion::new([20, 1], [40, 20]),
            MapRegion::new([60, 50], [44, 18]),
        ] {
            let summed = SummedMap::new(&gpu, &capabilities, &desc, &bytes, [9; 2]).unwrap();
            summed.set_regions(&gpu, 0, &[region]).unwrap();
            summed.run(&gpu, Layers::All).unwrap();
            let expected = reference::table(&integers, 4, SIZE[0] as usize, &[region]);
            assert!(summed.read(&gpu, 0).unwrap() == expected, "{region:?}");
        }
    }
}
