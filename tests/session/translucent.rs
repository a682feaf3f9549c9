//! A session whose plan leaves a hole for translucent casters, beside a depth map of four samples.

use moment_shadows::{Opacity, Profile, Source, Storage, link};
use moment_shadows_graph::record::{HostPass, blend_state};
use moment_shadows_graph::{GraphErrorKind, Stage};
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::translucent::{begin, blending};

use crate::{frame, imports, places, recorded, session};

const GRAPH: &str = include_str!("../../examples/translucent.json");

/// A pane at a moment depth all over the map and of opacity one half, where nothing opaque lies before it.
const PANE: &str = "
import moment_shadows::map::depth::{DepthConversion};
import moment_shadows::map::opaque_depth::{opaque_depth_farthest};
import moment_shadows::map::translucent_casters::{translucent_casters_six_moments};
import node::map::{DEPTH, ENDS, SCALE, STORAGE};

struct Planes {
    @location(0) odd: vec4f,
    @location(1) even: vec4f,
}

@group(0) @binding(0) var light_depth: texture_depth_multisampled_2d;

@vertex fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0, 0.0, 1.0);
}

@fragment fn pane(@builtin(position) position: vec4f) -> Planes {
    let conversion = DepthConversion(ENDS.xy, ENDS.zw, SCALE.x, SCALE.y, vec2f(0.0));
    if DEPTH >= opaque_depth_farthest(light_depth, vec2i(position.xy), conversion) {
        discard;
    }
    let texels = translucent_casters_six_moments(DEPTH, 0.5, STORAGE);
    return Planes(texels[0], texels[1]);
}
";

/// Draws a pane of opacity one half to the targets of a host's pass.
fn draw_pane(
    gpu: &Gpu,
    shader: &str,
    blend: wgpu::BlendState,
    light_depth: &wgpu::Texture,
    pass: &HostPass<'_>,
    encoder: &mut wgpu::CommandEncoder,
) {
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("pane"),
            source: wgpu::ShaderSource::Wgsl(shader.into()),
        });
    let format = pass.targets[0].texture().format();
    let target = (format, blend, pass.targets.len());
    let pipeline = blending(gpu, &module, ["cover", "pane"], &[], target);
    let depth = light_depth.create_view(&Default::default());
    let group = gpu.bind(
        &pipeline.get_bind_group_layout(0),
        [wgpu::BindingResource::TextureView(&depth)],
    );
    let mut drawn = begin(pass, encoder);
    drawn.set_pipeline(&pipeline);
    drawn.set_bind_group(0, &group, &[]);
    drawn.draw(0..3, 0..1);
}

#[test]
fn a_pane_before_everything_halves_the_light_and_one_behind_it_does_nothing() {
    // 16-bit formats are drawn to where the adapter says so. One caster has the smallest bias.
    let gpu = Gpu::open(Profile::NativeAdapter).unwrap();
    let graph = GRAPH.replace("\"blends\": 16", "\"blends\": 1");
    let frame = frame(&gpu, 0, [96, 54]);
    let (camera, light) = places(&frame);
    let mut session = session(&gpu, &graph, &imports(&frame));
    session.view(&gpu.queue, 0, &camera, &[light]).unwrap();

    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let refused = session.record(Stage::AfterShadowMaps, &mut encoder);
    let refused = refused.unwrap_err();
    assert_eq!(refused.kind, GraphErrorKind::Recording);
    assert!(
        refused.message.contains("'casters/translucent casters'"),
        "{refused}"
    );

    let map = session.encoding("shadow_map").unwrap().clone();
    assert_eq!((map.blends(), map.storage()), (1, Storage::Unorm16));
    assert!(session.encoding("shadow_intensity").is_none());
    let blend = blend_state(&map.blend_states(Opacity::Alpha).unwrap()[0]);
    let shaded = |depth: &str| {
        let conversion = light.depth.conversion().unwrap();
        let [[a, b], [c, d]] = [conversion.numerator, conversion.denominator];
        let constants = format!(
            "const STORAGE = {}u;\nconst DEPTH = f32({depth});\nconst ENDS = vec4f({a:?}, {b:?}, {c:?}, {d:?});\n\
             const SCALE = vec2f({:?}, {:?});\n",
            map.storage().wgsl_index(),
            conversion.scale,
            conversion.offset
        );
        let constants = Source {
            name: "map",
            text: &constants,
        };
        let source = Source {
            name: "pane.wgsl",
            text: PANE,
        };
        let shader = link(source, &[constants]).unwrap().into_wgsl();
        let mut calls = Vec::new();
        let mut draw = |pass: HostPass<'_>, encoder: &mut wgpu::CommandEncoder| {
            calls.push((pass.layer, pass.targets.len(), pass.blend));
            let light_depth = &frame.light_map.texture;
            draw_pane(&gpu, &shader, blend, light_depth, &pass, encoder);
        };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for stage in Stage::ALL {
            session.record_with(stage, &mut encoder, &mut draw).unwrap();
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.check().unwrap();
        assert_eq!(calls, [(0, 2, true)]);
        let texture = session.output(0, "shadow_intensity").unwrap();
        gpu.read_texture(texture, 0, "shadow").unwrap()
    };
    // Nothing is nearer than the near end, nor farther than the far end.
    let (near, far) = (shaded("-1.0"), shaded("1.0"));
    let lit = |shaded: &[u8]| shaded.iter().filter(|&&it| it < 3).count();
    let shadowed = far.iter().filter(|&&it| it > 250).count();
    assert!(lit(&far) > 500 && shadowed > 100);
    // The bound of a mixture with the near end: half of full shadow and half of what was there, but for the bias. What is not in the
    // map stays lit.
    let mut covered = 0;
    for (near, far) in near.iter().zip(&far) {
        let [near, far] = [near, far].map(|&byte| f64::from(byte) / 255.0);
        let difference = near - (0.5 + 0.5 * far);
        if far == 0.0 && near > 0.0 {
            covered += 1;
            assert!((-0.1..0.01).contains(&difference), "{near} of {far}");
        }
    }
    println!("{covered} of {} lit pixels in the pane's shadow", lit(&far));
    assert!(covered > 500);
    // What no host draws is the map without casters.
    let plain = graph
        .replace(
            "{ \"name\": \"casters\", \"type\": \"translucent_casters\" },",
            "",
        )
        .replace("{ \"from\": \"casters.map\", \"to\": \"blur.map\" },", "")
        .replace("\"to\": \"casters.map\"", "\"to\": \"blur.map\"");
    let mut without = crate::session(&gpu, &plain, &imports(&frame));
    without.view(&gpu.queue, 0, &camera, &[light]).unwrap();
    assert_eq!(recorded(&gpu, &without, 0, "shadow_intensity"), far);
}
