//! Nodes that a host leaves out: what the plan says stands in for their outputs, by its pixels.

use half::f16;
use moment_shadows::{MapEncoding, TextureFormat};
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_graph::{
    Capabilities, Home, Instead, Lives, Named, Plan, PlannedBindingResource, PlannedResource, Usage,
};
use moment_shadows_lab::frame::Frame;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_file::GraphFile;
use moment_shadows_lab::{graph_frame, techniques};
use wgpu::util::{DeviceExt as _, TextureDataOrder};

use crate::orders::{Recorder, with_memory_apart};
use crate::{AIR, HARD, frame, gpu};

const SIZE: [u32; 2] = [96, 54];

/// A texel's bytes in a format.
fn texel(format: TextureFormat, values: [f64; 4]) -> Vec<u8> {
    use TextureFormat as F;
    let whole = |value: f64, largest: f64| (value.clamp(0.0, 1.0) * largest).round() as u32;
    let channels = values.iter().take(format.channels() as usize);
    match format {
        F::R8Unorm | F::Rgba8Unorm => channels.map(|&value| whole(value, 255.0) as u8).collect(),
        F::R16Unorm | F::Rg16Unorm | F::Rgba16Unorm => channels
            .flat_map(|&value| (whole(value, 65535.0) as u16).to_le_bytes())
            .collect(),
        F::R16Float | F::Rg16Float | F::Rgba16Float => channels
            .flat_map(|&value| f16::from_f64(value).to_le_bytes())
            .collect(),
        F::R32Float | F::Rg32Float | F::Rgba32Float => channels
            .flat_map(|&value| (value as f32).to_le_bytes())
            .collect(),
        F::R32Uint | F::Rg32Uint => channels
            .flat_map(|&value| (value as u32).to_le_bytes())
            .collect(),
        F::Rgb10a2Unorm => {
            let [r, g, b] = [0, 1, 2].map(|channel| whole(values[channel], 1023.0));
            let word = r | g << 10 | b << 20 | whole(values[3], 3.0) << 30;
            word.to_le_bytes().to_vec()
        }
        _ => panic!("{format} is no format of a stand-in"),
    }
}

/// Lets passes that read a resource read another.
fn redirect(plan: &mut Plan, from: usize, to: usize) {
    for binding in plan.passes.iter_mut().flat_map(|pass| &mut pass.bindings) {
        if let PlannedBindingResource::Texture { resource, .. } = &mut binding.resource
            && *resource == from
        {
            *resource = to;
        }
    }
}

struct Scene {
    gpu: Gpu,
    frame: Frame,
}

impl Scene {
    fn new() -> Self {
        let gpu = gpu();
        let frame = frame(&gpu, 0, SIZE);
        Self { gpu, frame }
    }

    fn file(text: &str) -> GraphFile {
        GraphFile::parse("graph", text.to_owned(), None).unwrap()
    }

    fn plan(&self, text: &str) -> Plan {
        let capabilities = Capabilities::of_device(&self.gpu.adapter, &self.gpu.device);
        let imports = graph_frame::imports(&self.frame.desc).unwrap();
        let plan = Self::file(text).graph.compile(&capabilities, &imports);
        with_memory_apart(&plan.unwrap())
    }

    /// A texture that holds a texel of its own in each plane.
    fn filled(&self, of: &PlannedResource, texels: &[[f64; 4]]) -> ImportedResource {
        let desc = of.desc.texture().unwrap();
        let count = (desc.size[0] * desc.size[1]) as usize;
        let texels = texels.iter().map(|&values| texel(desc.format, values));
        let data: Vec<u8> = texels.flat_map(|texel| texel.repeat(count)).collect();
        let texture = self.gpu.device.create_texture_with_data(
            &self.gpu.queue,
            &wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d {
                    width: desc.size[0],
                    height: desc.size[1],
                    depth_or_array_layers: desc.array_layers(),
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: desc.wgpu_format(),
                usage: wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            },
            TextureDataOrder::LayerMajor,
            &data,
        );
        ImportedResource::Texture(texture)
    }

    /// The outputs of a plan, without a node, which something stands in for.
    fn outputs(&self, text: &str, without: Option<(&str, &Instead)>) -> Vec<Vec<u8>> {
        let mut plan = self.plan(text);
        let mut further = Vec::new();
        if let Some((node, instead)) = without {
            let output = plan.off.iter().find(|off| off.node == node).unwrap().output;
            match instead {
                Instead::Bypass(input) => redirect(&mut plan, output, *input),
                Instead::Fill(texels) => {
                    further.push(("filled", self.filled(&plan.resources[output], texels)));
                    let to = plan.resources.len();
                    plan.resources.push(PlannedResource {
                        name: "filled".to_owned(),
                        usage: vec![Usage::TextureBinding],
                        extent: None,
                        lives: Lives::Always,
                        home: Home::Import(plan.imports.len()),
                        ..plan.resources[output].clone()
                    });
                    plan.imports.push(Named::new("filled", to));
                    redirect(&mut plan, output, to);
                }
            }
            plan.update_hazards();
        }
        let file = Self::file(text);
        let bytes = graph_frame::parameter_bytes(&plan, &self.frame.desc, &file, None).unwrap();
        let is_left_out =
            |pass: &usize| without.is_some_and(|(node, _)| plan.passes[*pass].node == node);
        let recorded: Vec<usize> = (0..plan.passes.len())
            .filter(|pass| !is_left_out(pass))
            .collect();
        assert_eq!(recorded.len() < plan.passes.len(), without.is_some());
        Recorder::new(&self.gpu, &self.frame, plan, &bytes).outputs(&recorded, &further)
    }

    /// What the plan says of a node.
    fn instead(&self, text: &str, node: &str) -> Instead {
        let plan = self.plan(text);
        let off = plan.off.iter().find(|off| off.node == node);
        off.unwrap().instead.clone()
    }
}

/// The hard shadows of a technique.
fn of(encoding: &MapEncoding) -> String {
    let technique = serde_json::to_string(encoding.technique()).unwrap();
    let mut file: serde_json::Value = serde_json::from_str(HARD).unwrap();
    file["nodes"][0]["properties"] =
        serde_json::from_str(&format!(r#"{{ "technique": {technique} }}"#)).unwrap();
    let file = GraphFile::parse("graph", file.to_string(), Some(encoding.storage()));
    file.unwrap().text
}

#[test]
fn a_map_that_casts_no_shadow_stands_in_for_one_that_is_not_made() {
    let scene = Scene::new();
    let profile = Capabilities::of_device(&scene.gpu.adapter, &scene.gpu.device).profile;
    let mut checked = 0;
    for encoding in techniques::filterable() {
        if encoding.check(profile).is_err() {
            continue;
        }
        let text = of(&encoding);
        let maker = match encoding.storage().is_written_once() {
            true => "blur",
            false => "resolve",
        };
        let instead = scene.instead(&text, maker);
        let shadow = |without| scene.outputs(&text, without).remove(0);
        let whole = shadow(None);
        assert!(whole.iter().any(|&byte| byte > 200), "{encoding}");
        let lit = shadow(Some((maker, &instead)));
        let darkest = lit.iter().max().unwrap();
        assert!(*darkest <= 1, "{encoding}: {darkest} of 255");
        checked += 1;
    }
    assert!(checked > 20, "{checked}");
}

/// Zeros are no such map.
#[test]
fn zeros_cast_a_shadow() {
    let scene = Scene::new();
    let zeros = Instead::Fill(vec![[0.0; 4]]);
    let dark = scene.outputs(HARD, Some(("resolve", &zeros))).remove(0);
    let mean = dark.iter().map(|&byte| f64::from(byte)).sum::<f64>() / 255.0 / dark.len() as f64;
    assert!(mean > 0.2, "{mean}");
}

#[test]
fn a_filter_is_passed_by() {
    let scene = Scene::new();
    let instead = scene.instead(HARD, "blur");
    let by_passed = scene.outputs(HARD, Some(("blur", &instead)));
    let mut file: serde_json::Value = serde_json::from_str(HARD).unwrap();
    let nodes = file["nodes"].as_array_mut().unwrap();
    nodes.retain(|node| node["name"] != "blur");
    let edges = file["edges"].as_array_mut().unwrap();
    edges.retain(|edge| edge["to"] != "blur.map");
    for edge in edges {
        if edge["from"] == "blur.blurred" {
            edge["from"] = "resolve.map".into();
        }
    }
    // The receiver bias is that of the kernel in both.
    let file = file.to_string();
    let bytes = graph_frame::parameter_bytes(
        &scene.plan(&file),
        &scene.frame.desc,
        &Scene::file(HARD),
        None,
    );
    let plan = scene.plan(&file);
    let order: Vec<usize> = (0..plan.passes.len()).collect();
    let without = Recorder::new(&scene.gpu, &scene.frame, plan, &bytes.unwrap());
    assert!(without.outputs(&order, &[]) == by_passed);
    assert!(scene.outputs(HARD, None) != by_passed);
}

/// Pictures that nothing in the plan reads: a host fills them, or skips what takes them.
#[test]
fn pictures_of_nodes_that_are_left_out_are_lit_and_clear() {
    let scene = Scene::new();
    let lit = Instead::Fill(vec![[0.0; 4]]);
    assert_eq!(scene.instead(HARD, "shade"), lit);
    let clear = Instead::Fill(vec![[0.0, 0.0, 0.0, 1.0]]);
    assert_eq!(scene.instead(AIR, "composite"), clear);
    // Prefix sums have no stand-in of their own.
    assert!(
        scene
            .plan(AIR)
            .off
            .iter()
            .all(|off| off.node != "integrate")
    );
}
