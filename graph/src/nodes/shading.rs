//! What the nodes that shade a picture have in common: their shader, their target and their slots.

use moment_shadows::{TextureFormat, ViewParameters};

use crate::{
    Access, Binding, CountRule, Direction, ExtentRule, FormatRule, GraphError, GraphErrorKind,
    Lifetime, NodeDesc, ParameterBlock, Pass, Slot, SlotResource, Stage, Work,
};

/// The shader: it finds what a pixel's surface is to each view of a light, and leaves the rest to the virtual module
/// `technique`.
pub(super) const SHADER: &str = include_str!("shade.wgsl");

/// The map that is shaded with.
pub(super) struct ShadedMap {
    pub slot: &'static str,
    pub formats: Vec<TextureFormat>,
}

/// The format of the shadow intensity, if it has a channel for each light.
pub(super) fn target_format(
    format: Option<TextureFormat>,
    lights: u32,
    views: u32,
) -> Result<TextureFormat, GraphError> {
    let property = |message: String| Err(GraphError::new(GraphErrorKind::Property, message));
    if !(1..=4).contains(&lights) {
        return property(format!(
            "'lights' is {}; a node shades 1 to 4 lights, one per channel of its output, and more nodes shade more",
            lights
        ));
    }
    if views < lights {
        return property(format!(
            "'views' is {}, but there are {} lights; each has at least one view",
            views, lights
        ));
    }
    let one = [
        TextureFormat::R8Unorm,
        TextureFormat::R16Float,
        TextureFormat::R32Float,
    ];
    let four = [
        TextureFormat::Rgba8Unorm,
        TextureFormat::Rgba16Float,
        TextureFormat::Rgba32Float,
    ];
    let format = format.unwrap_or(if lights == 1 {
        TextureFormat::R8Unorm
    } else {
        TextureFormat::Rgba8Unorm
    });
    if four.contains(&format) || (lights == 1 && one.contains(&format)) {
        return Ok(format);
    }
    let names = |formats: &[TextureFormat]| {
        let names: Vec<&str> = formats.iter().map(|format| format.name()).collect();
        names.join(", ")
    };
    property(if lights == 1 {
        format!(
            "shadow intensity is one number per light; 'format' is {} or {}, not {format}",
            names(&one),
            names(&four)
        )
    } else {
        format!(
            "{} lights need a channel each; 'format' is {}, not {format}",
            lights,
            names(&four)
        )
    })
}

/// The node: a fullscreen pass from the map and `camera_depth` to `shadow_intensity`.
pub(super) fn describe(
    name: &str,
    map: ShadedMap,
    format: TextureFormat,
    views: u32,
    wgsl: String,
    bindings: Vec<Binding>,
    further_inputs: Vec<Slot>,
) -> NodeDesc {
    let texture = |name: &str, direction, access, format, extent, layers, mips| Slot {
        name: name.to_owned(),
        direction,
        lifetime: Lifetime::Frame,
        optional: false,
        resource: SlotResource::Texture {
            access,
            format,
            extent,
            layers,
            mips,
            samples: CountRule::Exact(1),
        },
    };
    let slots = [
        texture(
            map.slot,
            Direction::In,
            Access::READ,
            FormatRule::OneOf(map.formats),
            ExtentRule::Any,
            CountRule::Any,
            CountRule::Any,
        ),
        texture(
            "camera_depth",
            Direction::In,
            Access::READ,
            FormatRule::OneOf(vec![
                TextureFormat::Depth32Float,
                TextureFormat::Depth16Unorm,
            ]),
            ExtentRule::Any,
            CountRule::Exact(1),
            CountRule::Exact(1),
        ),
        texture(
            "shadow_intensity",
            Direction::Out,
            Access::RENDER_TARGET,
            FormatRule::Exact(format),
            ExtentRule::SameAs("camera_depth".to_owned()),
            CountRule::Exact(1),
            CountRule::Exact(1),
        ),
    ]
    .into_iter()
    .chain(further_inputs)
    .collect();
    NodeDesc {
        name: name.to_owned(),
        stage: Stage::AfterMainPass,
        slots,
        passes: vec![Pass {
            label: "shade".to_owned(),
            wgsl,
            entry_point: "shade".to_owned(),
            bindings,
            constants: [].into(),
            plane: 0,
            work: Work::Fullscreen {
                target: "shadow_intensity".to_owned(),
                each_layer: false,
            },
        }],
        parameters: Some(ParameterBlock {
            name: "ViewParameters".to_owned(),
            size: size_of::<ViewParameters>() as u32,
            elements: views,
            each_layer_of: None,
            initial: Vec::new(),
        }),
    }
}
