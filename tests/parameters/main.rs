//! Uniform structs and constants that exist in WGSL and in Rust: reflected and compared.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod constants;

use std::mem::offset_of;

use moment_shadows::{
    AreaLight, CompositeScatteringParameters, ContactShadowParameters, DepthConversion,
    FourMomentsBias, HeightFogView, IntegrateScatteringParameters, Kernel, LeakReduction,
    MapRegion, MarchScatteringParameters, Profile, PunctualLight, ReceiverBias, RectifiedFrame,
    RectifyMomentsParameters, SingleScattering, Storage, Technique, TextureFormat,
    UpsampleScatteringParameters, ViewParameters,
};
use moment_shadows_graph::nodes::{
    Blur, CompositeScattering, ContactShadows, IntegrateScattering, MarchScattering,
    RectifyMoments, Resolve, ShadeHard, UpsampleScattering,
};
use moment_shadows_graph::{
    BindingResource, Capabilities, Connected, Node, NodeDesc, ResourceDesc, TextureDesc,
};
use naga::{Module, TypeInner};

use wgsl_module::{module, parse};

#[path = "../support/wgsl_module.rs"]
mod wgsl_module;

/// A field as both sides have to lay it out: name, offset, size.
type Field = (&'static str, usize, usize);

/// Offsets and sizes of a struct's fields, for a list of names.
macro_rules! fields {
    ($name:ty { $($field:ident: $kind:ty),* $(,)? }) => {
        [$((stringify!($field), offset_of!($name, $field), size_of::<$kind>())),*]
    };
}

#[track_caller]
fn assert_same_layout(module: &Module, name: &str, size: usize, fields: &[Field]) {
    let (_, found) = module
        .types
        .iter()
        .find(|(_, candidate)| candidate.name.as_deref() == Some(name))
        .unwrap_or_else(|| panic!("there is no struct {name}"));
    let TypeInner::Struct { members, span } = &found.inner else {
        panic!("{name} is no struct");
    };
    let in_wgsl: Vec<(&str, usize, usize)> = members
        .iter()
        .map(|member| {
            let size = module.types[member.ty].inner.size(module.to_ctx());
            (
                member.name.as_deref().unwrap(),
                member.offset as usize,
                size as usize,
            )
        })
        .collect();
    assert_eq!(in_wgsl, fields, "{name}");
    assert_eq!(
        *span as usize, size,
        "{name}: the size of an element of an array"
    );
}

#[test]
fn structs_of_the_modules_are_laid_out_alike() {
    assert_same_layout(
        &module("depth", "DepthConversion"),
        "DepthConversion",
        size_of::<DepthConversion>(),
        &fields!(DepthConversion {
            numerator: [f32; 2],
            denominator: [f32; 2],
            scale: f32,
            offset: f32,
            padding: [f32; 2]
        }),
    );
    assert_same_layout(
        &module("receiver_bias", "ReceiverBias"),
        "ReceiverBias",
        size_of::<ReceiverBias>(),
        &fields!(ReceiverBias {
            constant: f32,
            slope_scale: f32,
            maximum: f32,
            step: u32
        }),
    );
    assert_same_layout(
        &module("leak_reduction", "LeakReduction"),
        "LeakReduction",
        size_of::<LeakReduction>(),
        &fields!(LeakReduction {
            full_shadow: f32,
            bleed_reduction: f32,
            visibility_exponent: f32,
            padding: f32
        }),
    );
    assert_same_layout(
        &module("map_region", "MapRegion"),
        "MapRegion",
        size_of::<MapRegion>(),
        &fields!(MapRegion {
            origin: [u32; 2],
            extent: [u32; 2]
        }),
    );
    assert_same_layout(
        &module("four_moments", "FourMomentsBias"),
        "FourMomentsBias",
        size_of::<FourMomentsBias>(),
        &fields!(FourMomentsBias {
            alpha: f32,
            second: f32,
            fourth: f32
        }),
    );
    assert_same_layout(
        &module("area_light", "AreaLight"),
        "AreaLight",
        size_of::<AreaLight>(),
        &fields!(AreaLight {
            size: [f32; 2],
            near: f32,
            far: f32,
            perspective: u32,
            smallest_radius: f32,
            largest_radius: f32,
            rectangular: u32
        }),
    );
    assert_same_layout(
        &module("contact_shadow", "ContactShadowParameters"),
        "ContactShadowParameters",
        size_of::<ContactShadowParameters>(),
        &fields!(ContactShadowParameters {
            light_clip: [f32; 4],
            light_position: [f32; 4],
            position_from_camera: [[f32; 4]; 3],
            scene_w_from_camera: [f32; 4],
            depth_scale: f32,
            length: f32,
            thickness: f32,
            far_depth: f32
        }),
    );
}

#[test]
fn structs_of_single_scattering_are_laid_out_alike() {
    assert_same_layout(
        &module("rectified_frame", "RectifiedFrame"),
        "RectifiedFrame",
        size_of::<RectifiedFrame>(),
        &fields!(RectifiedFrame {
            along_x: [f32; 3],
            largest_radius: f32,
            along_y: [f32; 3],
            first_azimuth: f32,
            along_middle: [f32; 3],
            azimuth_extent: f32,
            scene_w: [f32; 4],
            farthest_w: f32,
            smallest_inclination: f32,
            largest_inclination: f32,
            padding: f32
        }),
    );
    assert_same_layout(
        &module("single_scattering", "SingleScattering"),
        "SingleScattering",
        size_of::<SingleScattering>(),
        &fields!(SingleScattering {
            extinction: [f32; 3],
            anisotropy: f32,
            scattering: [f32; 3],
            mean_extinction: f32,
            irradiance: [f32; 3],
            padding: f32
        }),
    );
    // The last pass: those before need not be given everything.
    let of = |node: &dyn Node| parse(&described(node).passes.last().unwrap().wgsl);
    let rectify = RectifyMoments {
        technique: Technique::Hamburger4,
        storage: Storage::Float16,
        extent: [64, 64],
    };
    // What the WGSL structs leave to the end of their last 16 bytes is padding here.
    assert_same_layout(
        &of(&rectify),
        "RectifyMomentsParameters",
        size_of::<RectifyMomentsParameters>(),
        &fields!(RectifyMomentsParameters {
            frame: RectifiedFrame,
            map_at_camera: [f32; 2],
            map_along_first: [f32; 2],
            map_along_second: [f32; 2],
            depth_at_camera: f32,
            depth_per_length: f32,
            region: MapRegion,
            layer: u32
        }),
    );
    assert_same_layout(
        &of(&IntegrateScattering {}),
        "IntegrateScatteringParameters",
        size_of::<IntegrateScatteringParameters>(),
        &fields!(IntegrateScatteringParameters {
            frame: RectifiedFrame,
            extinction: f32
        }),
    );
    assert_same_layout(
        &of(&CompositeScattering::default()),
        "CompositeScatteringParameters",
        size_of::<CompositeScatteringParameters>(),
        &fields!(CompositeScatteringParameters {
            frame: RectifiedFrame,
            medium: SingleScattering
        }),
    );
}

#[test]
fn structs_of_marched_scattering_are_laid_out_alike() {
    assert_same_layout(
        &module("height_fog", "HeightFog"),
        "HeightFog",
        size_of::<HeightFogView>(),
        &fields!(HeightFogView {
            gradient: [f32; 3],
            log_density: f32
        }),
    );
    assert_same_layout(
        &module("punctual_light", "PunctualLight"),
        "PunctualLight",
        size_of::<PunctualLight>(),
        &fields!(PunctualLight {
            place: [f32; 3],
            radius: f32,
            cone_axis: [f32; 3],
            cone_offset: f32
        }),
    );
    let of = |node: &dyn Node| parse(&described(node).passes[0].wgsl);
    assert_same_layout(
        &of(&MarchScattering::default()),
        "MarchScatteringParameters",
        size_of::<MarchScatteringParameters>(),
        &fields!(MarchScatteringParameters {
            position_from_camera: [[f32; 4]; 3],
            scene_w_from_camera: [f32; 4],
            medium: SingleScattering,
            fog: HeightFogView,
            light: PunctualLight,
            map_from_position: [[f32; 4]; 4],
            leak_reduction: LeakReduction,
            conversion: DepthConversion,
            region: MapRegion,
            eye: [f32; 3],
            farthest_w: f32,
            own: [f32; 4],
            offset: f32,
            guard: f32,
            layer: u32,
            padding: u32
        }),
    );
    assert_same_layout(
        &of(&UpsampleScattering {}),
        "UpsampleScatteringParameters",
        size_of::<UpsampleScatteringParameters>(),
        &fields!(UpsampleScatteringParameters {
            scene_w_from_camera: [f32; 4],
            farthest_w: f32
        }),
    );
}

/// A library node, described for float16 maps of 256 texels.
fn described(node: &dyn Node) -> NodeDesc {
    let texture = |format| ResourceDesc::Texture(TextureDesc::new(format, [256, 256]));
    let inputs = [
        ("depth".to_owned(), texture(TextureFormat::Depth32Float)),
        ("map".to_owned(), texture(TextureFormat::Rgba16Float)),
        ("rectified".to_owned(), texture(TextureFormat::Rgba16Float)),
        ("integrated".to_owned(), texture(TextureFormat::Rgba16Float)),
        ("scattering".to_owned(), texture(TextureFormat::Rgba16Float)),
        (
            "camera_depth".to_owned(),
            texture(TextureFormat::Depth32Float),
        ),
    ]
    .into();
    let capabilities = Capabilities::of_profile(Profile::WebgpuCore);
    node.describe(&Connected::new(&inputs, &capabilities))
        .unwrap()
}

fn per_frame_blur() -> NodeDesc {
    described(&Blur {
        kernel: Kernel::gaussian(4, 2.4).map(Into::into),
        per_frame: true,
        resolve: None,
        rounded_inwards: false,
        mip_levels: Some(1),
    })
}

#[test]
fn structs_of_the_nodes_are_laid_out_alike() {
    let shade = described(&ShadeHard::default());
    let parsed = parse(&shade.passes[0].wgsl);
    assert_same_layout(
        &parsed,
        "ViewParameters",
        size_of::<ViewParameters>(),
        &fields!(ViewParameters {
            light_from_camera: [[f32; 4]; 4],
            scene_w_from_camera: [f32; 4],
            position_from_camera: [[f32; 4]; 3],
            receiver_bias: ReceiverBias,
            leak_reduction: LeakReduction,
            region: MapRegion,
            far_depth: f32,
            layer: u32,
            channel: u32,
            guard: f32,
            conversion: DepthConversion,
            light: AreaLight,
        }),
    );
    let blur = per_frame_blur();
    let size = size_of_val(&Blur::parameters(&Kernel::gaussian(4, 2.4).unwrap()));
    let fields = [
        ("radius", 0, 4),
        ("blocks", 4, 4),
        ("width", 8, 4),
        ("padding", 12, 4),
        ("weights", 16, size - 16),
    ];
    for pass in &blur.passes {
        assert_same_layout(&parse(&pass.wgsl), "BlurParameters", size, &fields);
    }
}

#[test]
fn nodes_declare_the_structs_that_their_shaders_bind() {
    let nodes = [
        described(&Resolve {
            technique: Some(Technique::Hamburger4),
            blends: 0,
            bits: None,
            storage: vec![Storage::Float16],
            mip_levels: Some(1),
        }),
        per_frame_blur(),
        described(&ShadeHard::default()),
        described(&ContactShadows::default()),
    ];
    for node in nodes {
        let block = node.parameters.as_ref().unwrap();
        for pass in &node.passes {
            let declared = pass
                .bindings
                .iter()
                .find(|binding| binding.resource == BindingResource::Parameters);
            let name = Some(declared.unwrap().variable.as_str());
            let parsed = parse(&pass.wgsl);
            let (_, bound) = parsed
                .global_variables
                .iter()
                .find(|(_, variable)| variable.name.as_deref() == name)
                .unwrap();
            let whole = &parsed.types[bound.ty];
            let kind = match whole.inner {
                TypeInner::Array { base, .. } => &parsed.types[base],
                _ => whole,
            };
            assert_eq!(
                kind.name.as_deref(),
                Some(block.name.as_str()),
                "{}",
                node.name
            );
            assert_eq!(
                kind.inner.size(parsed.to_ctx()),
                block.size,
                "{}",
                node.name
            );
        }
    }
}
