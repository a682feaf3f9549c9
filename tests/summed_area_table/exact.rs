//! Tables of whole layers.

use moment_shadows::{MapEncoding, MapRegion, Storage, SummedAreaTable, Technique};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::Layers;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::summed_area::{SummedMap, reference};

use crate::setup::{both, encoding, gpu, map, noise};

const KERNEL: [u32; 2] = [9; 2];

/// Makes the table with both tiles and compares every texel.
#[track_caller]
fn assert_exact(gpu: &Gpu, desc: &TextureDesc, bytes: &[u8], kernel: [u32; 2]) {
    let source = desc.encoding.as_ref().unwrap();
    let channels = source.technique().row().channels as usize;
    let whole = MapRegion::new([0; 2], desc.size);
    let layer_bytes = bytes.len() / desc.layers as usize;
    for capabilities in both(gpu) {
        let summed = SummedMap::new(gpu, &capabilities, desc, bytes, kernel).unwrap();
        summed.run(gpu, Layers::All).unwrap();
        let encoding = summed.desc().unwrap().encoding.clone().unwrap();
        let table = encoding.table().unwrap();
        for layer in 0..desc.layers {
            let start = layer as usize * layer_bytes;
            let integers = reference::integers(source, table, &bytes[start..start + layer_bytes]);
            let found = summed.read(gpu, layer).unwrap();
            let width = desc.size[0] as usize;
            let off = if tolerance(source) > 0.0 {
                let found = reference::differences(&found, channels, width);
                let allowed = 1.0 + tolerance(source) * f64::from(table.unit());
                assert!(found.iter().all(|&integer| integer <= table.unit()));
                let far = |(one, other): (&u32, &u32)| f64::from(one.abs_diff(*other)) > allowed;
                found.iter().zip(&integers).position(far)
            } else {
                let expected = reference::table(&integers, channels, width, &[whole]);
                found
                    .iter()
                    .zip(&expected)
                    .position(|(one, other)| one != other)
            };
            assert_eq!(
                off, None,
                "{source}, {:?}, layer {layer}, software {}",
                desc.size, capabilities.software_adapter
            );
            assert_eq!(found.len(), integers.len());
        }
    }
}

/// The basis of four moments in f32: whether its products are fused is up to the device, so that a channel may differ by
/// the rounding of two products of at most 2. Everything else is exact.
fn tolerance(source: &MapEncoding) -> f64 {
    match (source.technique(), source.storage()) {
        (Technique::Hamburger4 | Technique::Hausdorff4, Storage::Float32) => {
            4.0 * 2.0_f64.powi(-24)
        }
        _ => 0.0,
    }
}

/// One texel, one tile, one more, no multiples of tiles or workgroups, long lines.
#[test]
fn every_size_is_summed_to_the_bit() {
    let gpu = gpu();
    let source = encoding(Technique::Hamburger4, Storage::Unorm16);
    for size in [
        [1, 1],
        [8, 16],
        [9, 17],
        [17, 33],
        [203, 157],
        [1, 1000],
        [1000, 1],
    ] {
        let desc = map(&source, size, 1);
        assert_exact(&gpu, &desc, &noise(&desc, 1), KERNEL);
    }
}

/// The largest of them, with sums that exceed 2^32 some hundred times.
#[test]
fn large_maps_wrap_around_and_stay_exact() {
    let gpu = gpu();
    let source = encoding(Technique::Hamburger4, Storage::Unorm16);
    let desc = map(&source, [4096, 2048], 1);
    let bytes = noise(&desc, 2);
    let total: u64 = bytes
        .chunks_exact(8)
        .map(|texel| u64::from(u16::from_le_bytes([texel[0], texel[1]])))
        .sum();
    assert!(total > 60 << 32, "{total}");
    assert_exact(&gpu, &desc, &bytes, KERNEL);
}

#[test]
fn every_storage_and_both_techniques_are_summed_to_the_bit() {
    let gpu = gpu();
    for technique in [Technique::Hamburger4, Technique::Vsm] {
        for storage in Storage::OF_FOUR_MOMENTS {
            let desc = map(&encoding(technique.clone(), storage), [203, 157], 1);
            assert_exact(&gpu, &desc, &noise(&desc, 3), KERNEL);
        }
    }
    let desc = map(&encoding(Technique::Vsm, Storage::Float16), [30, 40], 1);
    // From units of 32 bits to ones of 16.
    for kernel in [[1; 2], [100, 3], [65537, 1]] {
        assert_exact(&gpu, &desc, &noise(&desc, 3), kernel);
    }
}

#[test]
fn every_layer_has_its_own_table() {
    let gpu = gpu();
    for storage in [Storage::Unorm16, Storage::Float32] {
        let desc = map(&encoding(Technique::Hamburger4, storage), [70, 45], 5);
        assert_exact(&gpu, &desc, &noise(&desc, 4), KERNEL);
    }
}

/// Channels of exactly 1 are those of every map without a caster; their sum over the largest kernel has to fit.
#[test]
fn a_map_of_ones_fills_the_range() {
    let gpu = gpu();
    let size = [131, 67];
    let texels = (size[0] * size[1]) as usize;
    let kernel = [65537, 1];
    for storage in Storage::OF_FOUR_MOMENTS {
        let desc = map(&encoding(Technique::Vsm, storage), size, 1);
        // Channels (b1 + 1) / 2 and 1 - b2 of 1: a mean of 1 and a mean square of 0.
        let texel: Vec<u8> = match storage {
            Storage::Float16 => [half::f16::from_f32(0.5); 2]
                .iter()
                .flat_map(|channel| channel.to_le_bytes())
                .collect(),
            Storage::Float32 => [1.0_f32, 0.0]
                .iter()
                .flat_map(|moment| moment.to_le_bytes())
                .collect(),
            _ => vec![255; 4],
        };
        assert_exact(&gpu, &desc, &texel.repeat(texels), kernel);
    }
    // n channels of 1 never exceed 32 bits, whatever n is.
    for area in 1..=65537_u32 {
        let table = SummedAreaTable::new(Storage::Float32, [area, 1]).unwrap();
        let unit = table.unit();
        assert_eq!(reference::fixed_point(1.0, unit), unit);
        assert_eq!(unit as f32 as u32, unit, "f32 holds it exactly");
        // A unit is one part in 2^23 less than it could be, at most.
        assert!(u64::from(u32::MAX / area - unit) << 23 <= u64::from(unit));
        assert!(unit.checked_mul(area).is_some());
    }
}

/// NaN, infinities and numbers out of range count as in the rest of the library.
#[test]
fn hostile_texels_are_kept_in_range() {
    let gpu = gpu();
    let size = [40, 24];
    let hostile = [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        f32::MIN,
        1e-40,
        -0.0,
        2.5,
        0.25,
    ];
    for technique in [Technique::Hamburger4, Technique::Vsm] {
        for storage in [Storage::Float16, Storage::Float32] {
            let desc = map(&encoding(technique.clone(), storage), size, 1);
            let count = (size[0] * size[1] * technique.row().channels) as usize;
            let values = (0..count).map(|index| {
                if index % 5 == 0 {
                    hostile[index / 5 % hostile.len()]
                } else {
                    0.375
                }
            });
            let bytes: Vec<u8> = match storage {
                Storage::Float16 => values
                    .flat_map(|value| half::f16::from_f32(value).to_le_bytes())
                    .collect(),
                _ => values.flat_map(f32::to_le_bytes).collect(),
            };
            assert_exact(&gpu, &desc, &bytes, KERNEL);
        }
    }
}
