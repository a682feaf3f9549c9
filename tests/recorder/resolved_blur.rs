//! The blur that resolves by itself, against both nodes and against moments in f64.

use moment_shadows::{
    DepthConversion, Kernel, MapEncoding, Profile, Storage, Technique, TextureFormat,
};
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_graph::{Graph, ResourceDesc, TextureDesc};
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::techniques;
use serde_json::{Value, json};

use crate::depth_map;
use crate::setup::{Bound, bind, capabilities, compiled, gpu};

/// No multiple of a workgroup or of the outputs of an invocation.
const SIZE: [u32; 2] = [203, 75];
const SAMPLES: u32 = 4;

/// Weights without any symmetry, of which some are zero.
fn weights(radius: u32) -> Vec<f64> {
    let raw: Vec<f64> = (0..=2 * radius)
        .map(|tap| f64::from((tap * 7 + 3) % 5) * (1.0 + f64::from(tap)))
        .collect();
    let sum: f64 = raw.iter().sum();
    raw.iter().map(|weight| weight / sum).collect()
}

/// What makes a filtered map of a depth map.
#[derive(Clone, Copy, PartialEq)]
enum By {
    BothNodes,
    Blur,
    /// A blur that resolves and rounds inwards.
    BlurInwards,
}

/// The filtered map of a depth map; the node that resolves is named `resolve`.
fn graph(resolve: &Value, radius: u32, by: By) -> String {
    let kernel = json!({ "weights": weights(radius) });
    let (nodes, edges, from) = if by != By::BothNodes {
        let inwards = by == By::BlurInwards;
        let blur = json!({ "kernel": kernel, "resolve": resolve, "rounded_inwards": inwards });
        let nodes = json!([{ "name": "resolve", "type": "blur", "properties": blur }]);
        (nodes, vec![], "resolve.blurred")
    } else {
        let nodes = json!([
            { "name": "resolve", "type": "resolve", "properties": resolve },
            { "name": "blur", "type": "blur", "properties": { "kernel": kernel } },
        ]);
        let edge = json!({ "from": "resolve.map", "to": "blur.map" });
        (nodes, vec![edge], "blur.blurred")
    };
    let depth = json!({ "from": "depth", "to": "resolve.depth" });
    let edges: Vec<Value> = edges.into_iter().chain([depth]).collect();
    json!({
        "version": 2, "imports": [{ "name": "depth" }], "nodes": nodes, "edges": edges,
        "outputs": [{ "name": "map", "from": from }],
    })
    .to_string()
}

/// Depths of two surfaces with noise, multiples of 1 / 4096.
fn depths() -> Vec<f32> {
    let count = SIZE[0] * SIZE[1] * SAMPLES;
    let depth = |index: u32| {
        let noise = (index.wrapping_mul(0x9e37_79b9) >> 24) as f32;
        let surface = if (index / 31).is_multiple_of(3) {
            0.0
        } else {
            3000.0
        };
        (surface + 4.0 * noise) / 4096.0
    };
    (0..count).map(depth).collect()
}

/// The surfaces without the noise.
fn still_depths() -> Vec<f32> {
    let surface = |depth: f32| if depth < 0.5 { 0.125 } else { 0.75 };
    depths().into_iter().map(surface).collect()
}

fn bound(gpu: &Gpu, text: &str) -> Bound {
    bound_of(gpu, text, &depths())
}

fn bound_of(gpu: &Gpu, text: &str, depths: &[f32]) -> Bound {
    let map = depth_map::texture(gpu, wgpu::TextureFormat::Depth32Float, SIZE, 1, SAMPLES);
    depth_map::draw(gpu, &map, 0, depths);
    let desc = TextureDesc {
        samples: SAMPLES,
        ..TextureDesc::new(TextureFormat::Depth32Float, SIZE)
    };
    let plan = compiled(text, &capabilities(gpu), &[("depth", desc)]);
    let mut bytes = plan.parameters.initial();
    let conversion = DepthConversion::orthographic().reversed();
    plan.parameters
        .write(&mut bytes, "resolve", 0, &conversion)
        .unwrap();
    let bound = bind(
        gpu,
        plan,
        &[("depth", ImportedResource::from(&map))],
        &bytes,
    );
    bound.run(gpu);
    bound
}

/// All planes of the map, channel by channel.
fn channels(gpu: &Gpu, bound: &Bound, encoding: &MapEncoding) -> Vec<f64> {
    let bytes = (0..encoding.planes()).flat_map(|plane| bound.read(gpu, "map", plane));
    let bytes: Vec<u8> = bytes.collect();
    let pairs = || bytes.chunks_exact(2).map(|pair| [pair[0], pair[1]]);
    match encoding.storage() {
        Storage::Unorm8 => bytes.iter().map(|&byte| f64::from(byte) / 255.0).collect(),
        Storage::Unorm16 => pairs()
            .map(|pair| f64::from(u16::from_le_bytes(pair)) / 65535.0)
            .collect(),
        Storage::Float16 => pairs()
            .map(|pair| half::f16::from_le_bytes(pair).to_f64())
            .collect(),
        _ => bytemuck::pod_collect_to_vec::<u8, f32>(&bytes)
            .into_iter()
            .map(f64::from)
            .collect(),
    }
}

/// Whatever technique and storage: what both nodes give differs by the roundings of three stages and of two.
#[test]
fn it_gives_what_both_nodes_give() {
    let gpu = gpu();
    let encodings = techniques::filterable().into_iter();
    let computed = encodings
        .filter(|it| !it.storage().is_drawn() && it.check(Profile::Native).is_ok())
        // Packed channels say nothing by themselves; what they give is held by pictures.
        .filter(|it| !it.storage().is_packed());
    for (encoding, radius) in computed.zip([4, 12, 1, 5].into_iter().cycle()) {
        let resolve = json!({ "technique": encoding.technique(), "storage": encoding.storage() });
        let made = [By::Blur, By::BothNodes].map(|by| {
            let bound = bound(&gpu, &graph(&resolve, radius, by));
            channels(&gpu, &bound, &encoding)
        });
        let largest = made[1].iter().fold(0.0, |all: f64, it| all.max(it.abs()));
        let rounding = match encoding.storage() {
            Storage::Unorm8 => 0.5 / 255.0,
            Storage::Unorm16 => 0.5 / 65535.0,
            Storage::Float16 => 2.0_f64.powi(-12) * largest,
            // Sums of f32 in another order.
            _ => 2.0_f64.powi(-22) * largest,
        };
        let difference = made[0]
            .iter()
            .zip(&made[1])
            .map(|(one, other)| (one - other).abs());
        let difference = difference.fold(0.0, f64::max);
        assert!(
            difference <= 5.0 * rounding * (1.0 + 1e-6),
            "{encoding}, radius {radius}: {difference} is more than 5 roundings of {rounding}"
        );
        assert!(largest > 0.0, "{encoding}: nothing was made");
    }
}

/// Two roundings to unorm16 would be off by a step. Where the second goes inwards rows are packed in between, which moves depths by up to
/// 2 / 65535, and a channel of a depth by up to 8 times that.
#[test]
fn moments_are_those_of_a_filter_in_f64() {
    let gpu = gpu();
    let packed = 8.0 * 2.0 / 65535.0 + 1.6e-5;
    for (by, storage, tolerance) in [
        (By::Blur, Storage::Float32, 2e-6),
        (By::Blur, Storage::Unorm16, 1.6e-5),
        (By::BlurInwards, Storage::Unorm16, packed),
    ] {
        for radius in [1_u32, 4, 12] {
            let resolve = json!({ "storage": storage });
            let bound = bound(&gpu, &graph(&resolve, radius, by));
            let encoding = MapEncoding::new(Technique::default(), storage).unwrap();
            let found = channels(&gpu, &bound, &encoding);
            let expected = filtered(radius, storage);
            for (index, (found, expected)) in found.iter().zip(&expected).enumerate() {
                assert!(
                    (found - expected).abs() < tolerance,
                    "{storage}, radius {radius}, channel {index}: {found} instead of {expected}"
                );
            }
        }
    }
}

/// The channels of all texels, in f64: raw moments, or the optimised basis.
fn filtered(radius: u32, storage: Storage) -> Vec<f64> {
    let [width, height] = SIZE.map(|side| side as usize);
    let resolved: Vec<[f64; 4]> = depths()
        .chunks_exact(SAMPLES as usize)
        .map(|samples| {
            let power = |power: i32| {
                let z = samples
                    .iter()
                    .map(|&it| (1.0 - 2.0 * f64::from(it)).powi(power));
                z.sum::<f64>() / f64::from(SAMPLES)
            };
            [power(1), power(2), power(3), power(4)]
        })
        .collect();
    // Those that a kernel keeps, which rounds them to multiples of its own.
    let given: Vec<f32> = weights(radius).into_iter().map(|it| it as f32).collect();
    let kernel = Kernel::from_weights(&given).unwrap();
    let weights: Vec<f64> = kernel.weights().iter().copied().map(f64::from).collect();
    let along = |texels: &[[f64; 4]], step: [usize; 2]| -> Vec<[f64; 4]> {
        let place = |at: usize, tap: usize, step: usize, side: usize| {
            let moved = (at + step * tap) as i64 - (step * radius as usize) as i64;
            moved.clamp(0, side as i64 - 1) as usize
        };
        let texel = |index: usize| {
            let mut sum = [0.0; 4];
            for (tap, weight) in weights.iter().enumerate() {
                let x = place(index % width, tap, step[0], width);
                let y = place(index / width, tap, step[1], height);
                let source = texels[y * width + x];
                sum.iter_mut()
                    .zip(source)
                    .for_each(|(sum, it)| *sum += weight * it);
            }
            sum
        };
        (0..texels.len()).map(texel).collect()
    };
    let filtered = along(&along(&resolved, [1, 0]), [0, 1]);
    let stored = |b: [f64; 4]| {
        let root = 3.0_f64.sqrt();
        match storage {
            Storage::Float32 => b,
            _ => [
                1.5 * b[0] - 2.0 * b[2] + 0.5,
                4.0 * (b[1] - b[3]),
                root * (0.5 * b[0] - 2.0 / 9.0 * b[2]) + 0.5,
                0.5 * (b[1] + b[3]),
            ],
        }
    };
    filtered.into_iter().flat_map(stored).collect()
}

/// Variance and determinant of the Hankel matrix of a texel of unorm16, with `alpha` of a bias towards (0, 0.628, 0, 0.628).
fn is_possible(channels: &[f64], alpha: f64) -> bool {
    let [x, y, z, w] = [
        channels[0] - 0.5,
        channels[1],
        channels[2] - 0.5,
        channels[3],
    ];
    let root = 3.0_f64.sqrt();
    let b = [
        root * z - x / 3.0,
        w + y / 8.0,
        0.75 * (root * z - x),
        w - y / 8.0,
    ];
    let target = [0.0, 0.628, 0.0, 0.628];
    let [b1, b2, b3, b4]: [f64; 4] =
        core::array::from_fn(|index| b[index] + alpha * (target[index] - b[index]));
    let (variance, covariance) = (b2 - b1 * b1, b3 - b1 * b2);
    variance > 0.0 && variance * (b4 - b2 * b2) > covariance * covariance
}

/// What is filtered without rounding in between, and rounded inwards at the end, is possible with half the bias; texels of both nodes are
/// not.
#[test]
fn texels_are_possible_moments() {
    let gpu = gpu();
    let storage = Storage::Unorm16;
    let encoding = MapEncoding::new(Default::default(), storage).unwrap();
    let alpha = 0.5 * f64::from(storage.moment_bias_rounded_inwards().alpha);
    for radius in [1_u32, 4, 12] {
        let resolve = json!({ "storage": storage });
        let impossible = [By::BlurInwards, By::BothNodes].map(|by| {
            let bound = bound_of(&gpu, &graph(&resolve, radius, by), &still_depths());
            let map = channels(&gpu, &bound, &encoding);
            let texels = map.chunks_exact(4);
            texels.filter(|texel| !is_possible(texel, alpha)).count()
        });
        println!("radius {radius}: impossible {impossible:?}");
        assert_eq!(impossible[0], 0, "radius {radius}");
        assert!(impossible[1] > 100, "radius {radius}");
    }
}

/// What reads the map knows that its bias is smaller; a blur of it does not leave it so.
#[test]
fn the_plan_says_how_texels_were_rounded() {
    let gpu = gpu();
    let inwards = |text: &str| {
        let desc = TextureDesc {
            samples: SAMPLES,
            ..TextureDesc::new(TextureFormat::Depth32Float, SIZE)
        };
        let plan = compiled(text, &capabilities(&gpu), &[("depth", desc)]);
        let map = plan.output_texture("map").unwrap();
        map.encoding.as_ref().unwrap().is_rounded_inwards()
    };
    let unorm16 = json!({ "storage": "unorm16" });
    let float16 = json!({ "storage": "float16" });
    assert!(inwards(&graph(&unorm16, 4, By::BlurInwards)));
    assert!(inwards(&graph(&float16, 4, By::BlurInwards)));
    assert!(!inwards(&graph(&unorm16, 4, By::Blur)));
    assert!(!inwards(&graph(&unorm16, 4, By::BothNodes)));
    let text = graph(&unorm16, 4, By::BlurInwards);
    let mut file: Value = serde_json::from_str(&text).unwrap();
    let blur =
        json!({ "name": "again", "type": "blur", "properties": { "kernel": { "radius": 1 } } });
    file["nodes"].as_array_mut().unwrap().push(blur);
    let edge = json!({ "from": "resolve.blurred", "to": "again.map" });
    file["edges"].as_array_mut().unwrap().push(edge);
    file["outputs"][0]["from"] = json!("again.blurred");
    assert!(!inwards(&file.to_string()));
}

#[test]
fn rounding_inwards_where_it_cannot_be_is_refused() {
    let gpu = gpu();
    let refused = |text: &str| {
        let graph: Graph = text.parse().unwrap();
        let desc = TextureDesc {
            samples: SAMPLES,
            ..TextureDesc::new(TextureFormat::Depth32Float, SIZE)
        };
        let error = graph.compile(
            &capabilities(&gpu),
            &[("depth", ResourceDesc::Texture(desc))],
        );
        error.unwrap_err().to_string()
    };
    let hausdorff = json!({ "technique": "hausdorff4", "storage": "unorm16" });
    for resolve in [hausdorff, json!({ "storage": "float32" })] {
        let says = refused(&graph(&resolve, 4, By::BlurInwards));
        assert!(says.contains("maps for 'hamburger4'"), "{says}");
    }
    let text = graph(&json!({ "storage": "unorm16" }), 4, By::BlurInwards);
    let mut file: Value = serde_json::from_str(&text).unwrap();
    file["nodes"][0]["properties"]["mip_levels"] = json!(2);
    let says = refused(&file.to_string());
    assert!(says.contains("leaves no room for 'mip_levels'"), "{says}");
    let text = graph(&json!({ "storage": "unorm16" }), 4, By::BothNodes);
    let mut file: Value = serde_json::from_str(&text).unwrap();
    file["nodes"][1]["properties"]["rounded_inwards"] = json!(true);
    let says = refused(&file.to_string());
    assert!(says.contains("is for a blur with 'resolve'"), "{says}");
}

/// 16 bytes of samples, and 8 written, read and written again.
#[test]
fn it_moves_40_bytes_per_texel() {
    let gpu = gpu();
    let resolve = json!({ "storage": "unorm16" });
    for by in [By::Blur, By::BlurInwards] {
        let plan = bound(&gpu, &graph(&resolve, 4, by)).plan;
        let bytes: Vec<u64> = plan
            .passes
            .iter()
            // Some more are conversions and regions.
            .map(|pass| (pass.bytes_read + pass.bytes_written) / u64::from(SIZE[0] * SIZE[1]))
            .collect();
        assert_eq!(bytes, [24, 16]);
    }
}
