//! Numbers that stand in WGSL and are read in Rust.

use crate::wgsl_module::{constant, module};
use moment_shadows::{
    CameraView, EsmFiltering, Finite, Kernel, LayerSplits, PcfTaps, ReceiverBias, SixMomentsBias,
    Storage, SummedAreaTable, Technique, UpsampleScatteringParameters,
};
use moment_shadows_graph::nodes::Blur;

#[test]
fn storages_have_the_numbers_and_biases_of_the_module() {
    for storage in Storage::OF_FOUR_MOMENTS {
        let name = storage.name().to_uppercase();
        let index = format!("STORAGE_{name}");
        let found = constant(&module("storage", &index), &index);
        assert_eq!(found, [f64::from(storage.wgsl_index())], "{index}");
        let bias = format!("FOUR_MOMENTS_BIAS_{name}");
        let found = constant(&module("four_moments", &bias), &bias);
        let expected = storage.moment_bias();
        assert_eq!(
            found,
            [expected.alpha, expected.second, expected.fourth].map(f64::from),
            "{bias}"
        );
        if storage != Storage::Float32 {
            let bias = format!("FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_{name}");
            let found = constant(&module("four_moments", &bias), &bias);
            let expected = storage.moment_bias_rounded_inwards();
            assert_eq!(
                found,
                [expected.alpha, expected.second, expected.fourth].map(f64::from),
                "{bias}"
            );
        }
        let bias = format!("HAUSDORFF4_BIAS_{name}");
        let found = constant(&module("hausdorff4", &bias), &bias);
        let expected = storage.hausdorff_moment_bias();
        assert_eq!(
            found,
            [expected.alpha, expected.second, expected.fourth].map(f64::from),
            "{bias}"
        );
    }
}

#[test]
fn storages_of_other_techniques_have_the_numbers_and_biases_of_the_modules() {
    for storage in [Storage::Unorm8, Storage::Unorm10] {
        let index = format!("STORAGE_{}", storage.name().to_uppercase());
        let found = constant(&module("storage", &index), &index);
        assert_eq!(found, [f64::from(storage.wgsl_index())], "{index}");
    }
    for &storage in Technique::Hamburger6.row().storages {
        let name = format!("SIX_MOMENTS_BIAS_{}", storage.name().to_uppercase());
        let found = constant(&module("six_moments", &name), &name);
        let SixMomentsBias { even, alpha } = storage.six_moments_bias().unwrap();
        assert_eq!(
            found,
            [even[0], even[1], even[2], alpha].map(f64::from),
            "{name}"
        );
    }
    assert_eq!(Storage::Unorm8.six_moments_bias(), None);
}

#[test]
fn tables_are_biased_alike_on_both_sides() {
    let number = |name: &str| {
        let name = format!("SUMMED_AREA_ENCODING_{name}");
        constant(&module("summed_area_encoding", &name), &name)[0] as f32
    };
    let index = "STORAGE_FIXED32";
    let found = constant(&module("storage", index), index);
    assert_eq!(found, [f64::from(Storage::Fixed32.wgsl_index())]);
    assert_eq!(number("LARGEST_AREA"), SummedAreaTable::LARGEST_AREA as f32);
    let biases = ["BIAS_PER_ERROR", "BIAS_OF_F32", "SMALLEST_BIAS"].map(number);
    let variances = ["VARIANCE_PER_ERROR", "VARIANCE_OF_F32", "SMALLEST_VARIANCE"].map(number);
    let cost = |[per_error, of_f32, smallest]: [f32; 3], error: f32| {
        per_error.mul_add(error, of_f32).max(smallest)
    };
    for source in Storage::OF_FOUR_MOMENTS {
        for side in [1, 9, 27, 65, 256] {
            let table = SummedAreaTable::new(source, [side; 2]).unwrap();
            let bias = table.moment_bias();
            assert_eq!(bias.alpha, cost(biases, table.error()), "{table}");
            assert_eq!([bias.second, bias.fourth], [0.628; 2]);
            assert_eq!(
                table.smallest_variance(),
                cost(variances, table.error()),
                "{table}"
            );
        }
    }
    let unorm16 = SummedAreaTable::new(Storage::Unorm16, [9; 2]).unwrap();
    assert_eq!(number("UNIT_UNORM16"), unorm16.unit() as f32);
}

#[test]
fn techniques_have_the_limits_of_their_modules() {
    let esm = |filtering| Technique::Esm {
        exponent: None,
        filtering,
    };
    let (linear, logarithmic) = (esm(EsmFiltering::Linear), esm(EsmFiltering::Logarithmic));
    let evsm = Technique::Evsm2 { exponent: None };
    for (name, technique, storage) in [
        ("EXPONENTIAL_LARGEST_EXPONENT", &linear, Storage::Float32),
        (
            "EXPONENTIAL_LARGEST_EXPONENT",
            &logarithmic,
            Storage::Float32,
        ),
        (
            "EXPONENTIAL_LARGEST_EXPONENT",
            &logarithmic,
            Storage::Unorm16,
        ),
        (
            "EXPONENTIAL_LARGEST_EXPONENT_FLOAT16",
            &linear,
            Storage::Float16,
        ),
        (
            "EXPONENTIAL_LARGEST_EXPONENT_UNORM16",
            &linear,
            Storage::Unorm16,
        ),
        (
            "EXPONENTIAL_LARGEST_EXPONENT_FLOAT16_LOGARITHMIC",
            &logarithmic,
            Storage::Float16,
        ),
        (
            "EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT16",
            &evsm,
            Storage::Float16,
        ),
        (
            "EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT32",
            &evsm,
            Storage::Float32,
        ),
    ] {
        let of = if name.contains("VARIANCE") {
            "exponential_variance"
        } else {
            "exponential"
        };
        let found = constant(&module(of, name), name);
        let largest = technique.row().largest_exponent(storage).unwrap();
        assert_eq!(found, [f64::from(largest)], "{name}");
    }
    // One more than the most is refused.
    for (of, name, technique) in [
        (
            "layered_variance",
            "LAYERED_VARIANCE_LARGEST_COUNT",
            (|layers| Technique::Lvsm {
                layers,
                overlap: Finite::ZERO,
                splits: LayerSplits::Uniform,
            }) as fn(u32) -> Technique,
        ),
        ("convolution", "CONVOLUTION_LARGEST_TERMS", |terms| {
            Technique::Convolution {
                terms,
                lower_bound: true,
            }
        }),
        (
            "percentage_closer",
            "PERCENTAGE_CLOSER_LARGEST_RADIUS",
            |radius| Technique::Pcf(PcfTaps::Box { radius }),
        ),
        (
            "percentage_closer_soft",
            "PERCENTAGE_CLOSER_SOFT_MOST_TAPS",
            |taps| Technique::Pcss {
                search_taps: taps,
                filter_taps: 1,
            },
        ),
    ] {
        let most = constant(&module(of, name), name)[0] as u32;
        technique(most).check().unwrap();
        assert!(technique(most + 1).check().is_err(), "{name}");
    }
}

#[test]
fn the_receiver_bias_moves_by_as_many_standard_deviations_on_both_sides() {
    let name = "RECEIVER_BIAS_STANDARD_DEVIATIONS";
    let found = constant(&module("receiver_bias", name), name);
    assert_eq!(found, [f64::from(ReceiverBias::STANDARD_DEVIATIONS)]);
}

#[test]
fn scattering_ends_where_the_longest_view_ray_does() {
    let name = "VIEW_RAY_LONGEST";
    let longest = constant(&module("view_ray", name), name)[0];
    // Reversed depth without an end.
    let camera = CameraView {
        clip_from_world: [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, -1.0],
            [0.0, 0.0, 0.1, 0.0],
        ],
        far_depth: 0.0,
    };
    UpsampleScatteringParameters::new(&camera, longest).unwrap();
    assert!(UpsampleScatteringParameters::new(&camera, longest.next_up()).is_err());
}

#[test]
fn percentage_closer_filtering_takes_the_largest_kernel() {
    let name = "PERCENTAGE_CLOSER_LARGEST_RADIUS";
    let found = constant(&module("percentage_closer", name), name);
    assert_eq!(found, [f64::from(Kernel::LARGEST_RADIUS)]);
}

#[test]
fn the_largest_kernel_fits_its_uniform_struct() {
    for radius in [1, 12, 13, Kernel::LARGEST_RADIUS] {
        let kernel = Kernel::gaussian(radius, radius as f32 * 0.6).unwrap();
        let parameters = Blur::parameters(&kernel);
        assert_eq!(parameters[0], radius);
        let flat: Vec<f32> = parameters[4..]
            .iter()
            .copied()
            .map(f32::from_bits)
            .collect();
        let first = flat.iter().position(|&weight| weight != 0.0).unwrap();
        let count = 2 * radius as usize + 1;
        assert_eq!(
            flat[first..first + count],
            *kernel.weights(),
            "radius {radius}"
        );
        assert!(
            flat[first + count..].iter().all(|&weight| weight == 0.0),
            "radius {radius}"
        );
    }
    // The drawn blur, which loops over the weights, clamps to the same radius.
    let drawn = include_str!("../../graph/src/nodes/blur/blur_texel_uniform.wgsl");
    assert!(drawn.contains(&format!(
        "min(parameters[kernel].radius, {}u)",
        Kernel::LARGEST_RADIUS
    )));
}
