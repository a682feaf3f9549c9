//! Writes what `check/parameters.mjs` compares: random inputs of everything that makes a node's parameters, and the bytes, or the name of
//! what is refused.
//!
//! `cargo run --release -p moment-shadows-graph --no-default-features --example write_parameters -- FILE`. The same inputs each time.

#[path = "write_parameters/march.rs"]
mod march;
#[path = "write_parameters/views.rs"]
mod views;

use std::error::Error;

use bytemuck::bytes_of;
use moment_shadows::{
    Border, CameraView, ContactShadowParameters, ContactShadows, DepthRange, Kernel, LeakReduction,
    LightDepth, LightSize, LightView, MapRegion, ReceiverBias, ScatteringParameters,
    SingleScattering, TextureFormat, ValueError, ViewParameters,
};
use moment_shadows_graph::{Capabilities, Graph, NodeRegistry, Plan, nodes::Blur};
use serde_json::{Value, json};

/// How many inputs of each kind there are.
const COUNTS: [(Make, usize); 9] = [
    (conversion, 150),
    (view, 400),
    (contact, 250),
    (scattering, 250),
    (march::march, 400),
    (blur, 100),
    (regions, 100),
    (views::cascades, 300),
    (views::point_light, 200),
];

type Make = fn(&mut Random, &Plan) -> Value;

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1);
    let file = file.ok_or("usage: write_parameters FILE")?;
    let plan = plan()?;
    let mut random = Random(0x5eed);
    let mut cases = Vec::new();
    for (make, count) in COUNTS {
        cases.extend((0..count).map(|_| make(&mut random, &plan)));
    }
    println!("{} inputs", cases.len());
    let initial = hexadecimal(&plan.parameters.initial());
    let all =
        json!({ "plan": { "parameters": plan.parameters }, "initial": initial, "cases": cases });
    Ok(std::fs::write(file, all.to_string())?)
}

/// A plan whose nodes have every kind of parameters.
fn plan() -> Result<Plan, Box<dyn Error>> {
    let graph = json!({
        "version": 2,
        "imports": [
            { "name": "light_depth", "texture": { "format": "depth32float", "size": [256, 128], "layers": 2, "regions": 4 } },
            { "name": "camera_depth", "texture": { "format": "depth32float", "size": [320, 180] } },
        ],
        "nodes": [
            { "name": "resolve", "type": "resolve", "properties": { "storage": "float16" } },
            { "name": "blur", "type": "blur", "properties": { "kernel": { "radius": 3 }, "per_frame": true } },
            { "name": "shade", "type": "shade_hard", "properties": { "views": 3 } },
            { "name": "contact", "type": "contact_shadows" },
            { "name": "rectify", "type": "rectify_moments", "properties": { "storage": "float16", "extent": [128, 64] } },
            { "name": "integrate", "type": "integrate_scattering" },
            { "name": "composite", "type": "composite_scattering" },
            { "name": "march", "type": "march_scattering", "properties": { "resolution": "half" } },
            { "name": "upsample", "type": "upsample_scattering" },
        ],
        "edges": [
            { "from": "light_depth", "to": "resolve.depth" },
            { "from": "resolve.map", "to": "blur.map" },
            { "from": "blur.blurred", "to": "shade.map" },
            { "from": "camera_depth", "to": "shade.camera_depth" },
            { "from": "camera_depth", "to": "contact.camera_depth" },
            { "from": "shade.shadow_intensity", "to": "contact.intensity" },
            { "from": "blur.blurred", "to": "rectify.map" },
            { "from": "rectify.rectified", "to": "integrate.rectified" },
            { "from": "integrate.integrated", "to": "composite.integrated" },
            { "from": "camera_depth", "to": "composite.camera_depth" },
            { "from": "blur.blurred", "to": "march.map" },
            { "from": "camera_depth", "to": "march.camera_depth" },
            { "from": "march.scattering", "to": "upsample.scattering" },
            { "from": "camera_depth", "to": "upsample.camera_depth" },
        ],
        "outputs": [
            { "name": "shadow", "from": "contact.shadow_intensity" },
            { "name": "scattering", "from": "composite.scattering" },
            { "name": "marched", "from": "upsample.upsampled" },
        ],
    });
    let graph = Graph::parse(&graph.to_string(), &NodeRegistry::new())?;
    let capabilities = Capabilities::of_profile(moment_shadows::Profile::WebgpuCore);
    Ok(graph.compile(&capabilities, &[])?)
}

/// Numbers that look random (SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    fn one_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Of some order of magnitude.
    fn magnitude(&mut self, lowest: f64, highest: f64) -> f64 {
        10_f64.powf(self.between(lowest, highest))
    }

    /// Now and then a number that is none, or out of every range.
    fn spoilt(&mut self, value: f64) -> f64 {
        if !self.one_in(25) {
            return value;
        }
        [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e300, 1e-300, -0.0][self.below(7)]
    }

    fn of(&mut self, count: usize, most: usize) -> u32 {
        (count + self.below(most)) as u32
    }
}

/// JSON has no numbers that are none.
fn number(value: f64) -> Value {
    if value.is_finite() {
        json!(value)
    } else {
        json!(value.to_string())
    }
}

fn numbers(values: &[f64]) -> Value {
    values.iter().map(|value| number(*value)).collect()
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// An input, and what comes of it: bytes, or the name of the refused value.
fn case(kind: &str, input: Value, result: Result<Value, ValueError>) -> Value {
    match result {
        Ok(bytes) => json!({ "kind": kind, "input": input, "bytes": bytes }),
        Err(error) => json!({ "kind": kind, "input": input, "refused": error.name }),
    }
}

fn range(random: &mut Random) -> (DepthRange, Value) {
    let near = random.magnitude(-2.0, 2.0);
    let far = near + random.magnitude(-1.0, 3.0);
    let (near, far) = (random.spoilt(near), random.spoilt(far));
    (
        DepthRange { near, far },
        json!({ "near": number(near), "far": number(far) }),
    )
}

fn depth(random: &mut Random, kind: usize) -> (LightDepth, Value) {
    let reversed = random.one_in(2);
    match kind {
        0 => (
            LightDepth::Orthographic { reversed },
            json!({ "orthographic": { "reversed": reversed } }),
        ),
        1 => {
            let near = random.magnitude(-2.0, 1.0);
            let far = if random.one_in(3) {
                f64::INFINITY
            } else {
                near * random.magnitude(0.1, 4.0)
            };
            let (near, far) = (random.spoilt(near), random.spoilt(far));
            let (range, written) = range(random);
            let written = json!({ "near": number(near), "far": number(far), "reversed": reversed, "range": written });
            (
                LightDepth::Perspective {
                    near,
                    far,
                    reversed,
                    range,
                },
                json!({ "perspective": written }),
            )
        }
        _ => {
            let (range, written) = range(random);
            (
                LightDepth::Linear { range },
                json!({ "linear": { "range": written } }),
            )
        }
    }
}

fn conversion(random: &mut Random, _: &Plan) -> Value {
    let kind = random.below(3);
    let (depth, written) = depth(random, kind);
    let made = depth.conversion();
    case(
        "conversion",
        written,
        made.map(|made| json!(hexadecimal(bytes_of(&made)))),
    )
}

type Matrix = [[f64; 4]; 4];

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    b.map(|column| [0, 1, 2, 3].map(|row| (0..4).map(|at| a[at][row] * column[at]).sum()))
}

/// A turn about some axis, and a move.
fn placed(random: &mut Random) -> Matrix {
    let quaternion = [0; 4].map(|_| random.between(-1.0, 1.0));
    let length = quaternion
        .iter()
        .map(|part| part * part)
        .sum::<f64>()
        .sqrt();
    let [x, y, z, w] = quaternion.map(|part| part / length);
    let reach = random.magnitude(-1.0, 5.0);
    let at = [0; 3].map(|_| random.between(-reach, reach));
    [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y + w * z),
            2.0 * (x * z - w * y),
            0.0,
        ],
        [
            2.0 * (x * y - w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z + w * x),
            0.0,
        ],
        [
            2.0 * (x * z + w * y),
            2.0 * (y * z - w * x),
            1.0 - 2.0 * (x * x + y * y),
            0.0,
        ],
        [at[0], at[1], at[2], 1.0],
    ]
}

/// The projection of a perspective, with forward, reversed or infinite reversed depth, and a lens that may be shifted.
fn perspective(random: &mut Random) -> Matrix {
    let (width, height) = (random.magnitude(-0.5, 0.5), random.magnitude(-0.5, 0.5));
    let (near, far) = (random.magnitude(-2.0, 0.0), random.magnitude(1.0, 4.0));
    let (slope, offset) = match random.below(3) {
        0 => (far / (near - far), near * far / (near - far)),
        1 => (near / (far - near), near * far / (far - near)),
        _ => (0.0, near),
    };
    let shift = if random.one_in(4) {
        random.between(-0.5, 0.5)
    } else {
        0.0
    };
    let projection = [
        [width, 0.0, 0.0, 0.0],
        [0.0, height, 0.0, 0.0],
        [shift, -shift, slope, -1.0],
        [0.0, 0.0, offset, 0.0],
    ];
    product(&projection, &placed(random))
}

fn parallel(random: &mut Random) -> Matrix {
    let size = random.magnitude(-3.0, 0.0);
    let (width, height) = (
        size * random.between(0.5, 2.0),
        size * random.between(0.5, 2.0),
    );
    let depth = random.magnitude(-3.0, 0.0);
    // Some projections have a last row of another number than 1.
    let last = if random.one_in(5) {
        random.magnitude(-1.0, 1.0)
    } else {
        1.0
    };
    let projection = [
        [width, 0.0, 0.0, 0.0],
        [0.0, height, 0.0, 0.0],
        [0.0, 0.0, -depth, 0.0],
        [0.0, 0.0, 0.3 * last, last],
    ];
    product(&projection, &placed(random))
}

fn matrix(random: &mut Random, is_parallel: bool) -> (Matrix, Value) {
    let mut matrix = if is_parallel {
        parallel(random)
    } else {
        perspective(random)
    };
    if random.one_in(25) {
        let (column, row) = (random.below(4), random.below(4));
        match random.below(3) {
            0 => matrix[column] = [0.0; 4],
            1 => matrix[column][row] = f64::NAN,
            _ => (0..4).for_each(|at| matrix[at][row] = matrix[at][(row + 1) % 4]),
        }
    }
    let written = matrix.iter().map(|column| numbers(column)).collect();
    (matrix, written)
}

fn camera(random: &mut Random, is_parallel: bool) -> (CameraView, Value) {
    let (clip_from_world, written) = matrix(random, is_parallel);
    let far_depth = if random.one_in(2) { 0.0 } else { 1.0 };
    (
        CameraView {
            clip_from_world,
            far_depth,
        },
        json!({ "clipFromWorld": written, "farDepth": far_depth }),
    )
}

fn size(random: &mut Random, kind: usize) -> (LightSize, Value) {
    let length = random.magnitude(-2.0, 1.0);
    let length = random.spoilt(length);
    match kind {
        0 => (LightSize::Point, Value::Null),
        1 => {
            let angle = 0.2 * length;
            (
                LightSize::AngularDiameter(angle),
                json!({ "angularDiameter": number(angle) }),
            )
        }
        2 => (LightSize::Disk(length), json!({ "disk": number(length) })),
        _ => {
            let height = random.spoilt(1.0);
            (
                LightSize::Rectangle([length, height]),
                json!({ "rectangle": numbers(&[length, height]) }),
            )
        }
    }
}

/// A border as both languages have it.
fn border(random: &mut Random) -> (Border, Value) {
    let width = random.between(0.0, 20.0);
    let width = random.spoilt(width);
    match random.below(6) {
        0 => (Border::Blend(width), json!({ "blend": number(width) })),
        1 => (Border::Fade(width), json!({ "fade": number(width) })),
        2 => (Border::Cone(width), json!({ "cone": number(width) })),
        _ => (Border::Sharp, json!("sharp")),
    }
}

fn light(random: &mut Random) -> (LightView, Value) {
    let kind = random.below(3);
    let (depth, stored) = depth(random, kind);
    let is_parallel = (kind == 0) != random.one_in(30);
    let (clip_from_world, matrix) = matrix(random, is_parallel);
    let region = if random.one_in(2) {
        MapRegion::WHOLE
    } else {
        MapRegion::new(
            [random.of(0, 512), random.of(0, 512)],
            [random.of(1, 512), random.of(1, 512)],
        )
    };
    let guard = if random.one_in(2) {
        0
    } else {
        random.of(0, 40)
    };
    let (border, border_written) = border(random);
    let (layer, channel) = (random.of(0, 4), random.of(0, 17));
    let sizes = if kind == 0 {
        [0, 1, 1, 1]
    } else {
        [0, 2, 3, 3]
    };
    let chosen = if random.one_in(40) {
        random.below(4)
    } else {
        sizes[random.below(4)]
    };
    let (size, sized) = size(random, chosen);
    let written = json!({
        "clipFromWorld": matrix, "depth": stored, "layer": layer, "channel": channel, "guard": guard, "border": border_written,
        "region": { "origin": region.origin, "extent": region.extent }, "size": sized,
    });
    (
        LightView {
            clip_from_world,
            depth,
            layer,
            region,
            guard,
            border,
            channel,
            size,
        },
        written,
    )
}

const FORMATS: [TextureFormat; 4] = [
    TextureFormat::Depth16Unorm,
    TextureFormat::Depth24PlusStencil8,
    TextureFormat::Depth32Float,
    TextureFormat::R32Float,
];

fn view(random: &mut Random, _: &Plan) -> Value {
    let is_parallel = random.one_in(5);
    let (camera, camera_written) = camera(random, is_parallel);
    let (light, light_written) = light(random);
    let extent = [random.of(64, 2000), random.of(64, 2000)];
    let deviation = random.between(0.0, 6.0) as f32;
    let format = FORMATS[random.below(4)];
    let reduction = LeakReduction {
        full_shadow: random.spoilt(0.98) as f32,
        bleed_reduction: random.between(0.0, 0.9) as f32,
        visibility_exponent: random.spoilt(1.5) as f32,
        padding: 0.0,
    };
    let (smallest, largest) = (random.between(0.0, 2.0), random.between(2.0, 60.0));
    let radii = [random.spoilt(smallest), random.spoilt(largest)];
    let made = || {
        reduction.check()?;
        let conversion = light.depth.conversion()?;
        let bias = ReceiverBias::for_kernel(deviation, light.depth_per_texel(extent) as f32);
        let bias = bias.for_stored_depth(format, &conversion);
        let mut made = ViewParameters::new(&camera, &light, bias, reduction)?;
        made.light = light.area_light(extent, radii[0]..=radii[1])?;
        Ok(json!(hexadecimal(bytes_of::<ViewParameters>(&made))))
    };
    let LeakReduction {
        full_shadow,
        bleed_reduction,
        visibility_exponent,
        ..
    } = reduction;
    let leaks = [full_shadow, bleed_reduction, visibility_exponent].map(f64::from);
    let input = json!({
        "camera": camera_written, "light": light_written, "extent": extent, "deviation": deviation, "format": format,
        "reduction": numbers(&leaks), "radii": numbers(&radii),
    });
    case("view", input, made())
}

fn contact(random: &mut Random, _: &Plan) -> Value {
    let is_parallel = random.one_in(5);
    let (camera, camera_written) = camera(random, is_parallel);
    let (light, light_written) = light(random);
    let (length, thickness) = (random.magnitude(-3.0, 2.0), random.magnitude(-3.0, 2.0));
    let [length, thickness] = [random.spoilt(length), random.spoilt(thickness)];
    let made = ContactShadowParameters::new(&camera, &light, ContactShadows { length, thickness });
    let input = json!({
        "camera": camera_written, "light": light_written, "length": number(length), "thickness": number(thickness),
    });
    case(
        "contact",
        input,
        made.map(|made| json!(hexadecimal(bytes_of(&made)))),
    )
}

fn scattering(random: &mut Random, _: &Plan) -> Value {
    let is_parallel = random.one_in(20);
    let (camera, camera_written) = camera(random, is_parallel);
    let (mut light, mut light_written) = light(random);
    if !random.one_in(20) {
        let (matrix, written) = matrix(random, true);
        let (depth, stored) = depth(random, 0);
        (light.clip_from_world, light.depth) = (matrix, depth);
        (light_written["clipFromWorld"], light_written["depth"]) = (written, stored);
    }
    let far = random.magnitude(0.0, 4.0);
    let far = random.spoilt(far);
    let colour = |random: &mut Random| {
        [0; 3].map(|_| {
            let value = random.between(0.0, 0.1);
            random.spoilt(value) as f32
        })
    };
    let (extinction, albedo, irradiance) = (colour(random), colour(random), colour(random));
    let anisotropy = random.between(-1.02, 1.02) as f32;
    let made = || {
        let medium = SingleScattering::new(extinction, albedo, anisotropy, irradiance)?;
        let made = ScatteringParameters::new(&camera, far, &light, medium)?;
        Ok(json!({
            "rectify": hexadecimal(bytes_of(&made.rectify)),
            "integrate": hexadecimal(bytes_of(&made.integrate)),
            "composite": hexadecimal(bytes_of(&made.composite)),
        }))
    };
    let written = |colour: [f32; 3]| numbers(&colour.map(f64::from));
    let input = json!({
        "camera": camera_written, "light": light_written, "far": number(far), "anisotropy": anisotropy,
        "extinction": written(extinction), "scattering": written(albedo), "irradiance": written(irradiance),
    });
    case("scattering", input, made())
}

fn blur(random: &mut Random, _: &Plan) -> Value {
    let (kernel, input) = if random.one_in(3) {
        let width = random.between(0.0, 33.0);
        let width = random.spoilt(width);
        let largest = random.of(1, 66);
        let input = json!({ "width": number(width), "largest": largest });
        (Kernel::of_width(width, largest), input)
    } else if random.one_in(2) {
        let radius = if random.one_in(20) {
            random.of(0, 1)
        } else {
            random.of(1, 66)
        };
        let sigma = f64::from(radius) * random.between(0.2, 0.9);
        let sigma = random.spoilt(sigma) as f32;
        let input = json!({ "radius": radius, "sigma": number(f64::from(sigma)) });
        (Kernel::gaussian(radius, sigma), input)
    } else {
        let count = if random.one_in(10) {
            random.below(140)
        } else {
            3 + 2 * random.below(64)
        };
        let mut weights: Vec<f32> = (0..count)
            .map(|_| random.between(0.0, 1.0) as f32)
            .collect();
        if random.one_in(10) {
            weights.fill(0.0);
        }
        if let Some(weight) = weights.first_mut() {
            *weight = random.spoilt(f64::from(*weight)) as f32;
        }
        let written: Vec<f64> = weights.iter().map(|weight| f64::from(*weight)).collect();
        (
            Kernel::from_weights(&weights),
            json!({ "weights": numbers(&written) }),
        )
    };
    let made = kernel.map(|kernel| {
        let bytes = hexadecimal(bytes_of(&Blur::parameters(&kernel)));
        json!({ "struct": bytes, "deviation": kernel.standard_deviation() })
    });
    case("blur", input, made)
}

/// Regions written into a block, of which many do not fit.
fn regions(random: &mut Random, plan: &Plan) -> Value {
    let most = if random.one_in(10) { 7 } else { 4 };
    let count = random.below(most);
    let widest = if random.one_in(3) { 140 } else { 60 };
    let regions: Vec<MapRegion> = (0..count)
        .map(|index| {
            let origin = [64 * index as u32 % 256, 64 * random.of(0, 2)];
            match random.below(20) {
                0 => MapRegion::WHOLE,
                1 => MapRegion::NONE,
                // To the edges of the map, and one texel beyond.
                2..5 => MapRegion::new([64, 0], [192 + random.of(0, 2), 128]),
                5..7 => MapRegion::new([0, 0], [64, 128]),
                _ => MapRegion::new(origin, [random.of(5, widest), random.of(7, widest)]),
            }
        })
        .collect();
    let layers = if random.one_in(10) { 3 } else { 2 };
    let layer = random.of(0, layers);
    let map = if random.one_in(20) {
        "nothing"
    } else {
        "light_depth"
    };
    let mut block = plan.parameters.initial();
    let written: Vec<Value> = regions
        .iter()
        .map(|region| json!({ "origin": region.origin, "extent": region.extent }))
        .collect();
    let input = json!({ "map": map, "layer": layer, "regions": written });
    match plan
        .parameters
        .write_regions(&mut block, map, layer, &regions)
    {
        Ok(()) => case("regions", input, Ok(json!(hexadecimal(&block)))),
        Err(_) => case("regions", input, Err(ValueError::new("regions", ""))),
    }
}
