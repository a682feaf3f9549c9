//! Layers: only dirty ones are made anew, the others keep their contents to the bit.

use moment_shadows::TextureFormat;
use moment_shadows_graph::record::{ImportedResource, Layers, Recording};
use moment_shadows_graph::{Stage, TextureDesc};

use crate::depth_map;
use crate::errors::is_wrong;
use crate::setup::{Bound, EXAMPLE, aligned_view, bind, block, capabilities, compiled, gpu};

const MAP: [u32; 2] = [40, 24];
const PICTURE: [u32; 2] = [32, 32];

/// A different pattern for each layer and turn.
fn pattern(layer: u32, turn: u32, samples: u32) -> Vec<f32> {
    depth_map::values([MAP[0] * samples, MAP[1]], |x, y| {
        let cell = (x / (5 + layer)) + y / (3 + turn);
        if cell.is_multiple_of(2) {
            0.1 + 0.1 * layer as f32
        } else {
            0.9 - 0.1 * turn as f32
        }
    })
}

/// The blurred moments of three layers, as an output.
const BLURRED: (&str, &str) = (
    "{ \"name\": \"shadow_intensity\", \"from\": \"shade.shadow_intensity\" }",
    "{ \"name\": \"blurred\", \"from\": \"blur.blurred\" }",
);

fn light(samples: u32) -> TextureDesc {
    TextureDesc {
        layers: 3,
        samples,
        ..TextureDesc::new(TextureFormat::Depth32Float, MAP)
    }
}

fn layers_of(gpu: &moment_shadows_lab::gpu::Gpu, bound: &Bound) -> Vec<Vec<u8>> {
    (0..3)
        .map(|layer| bound.read(gpu, "blurred", layer))
        .collect()
}

#[test]
fn layers_of_an_array_that_are_not_dirty_keep_their_contents() {
    let gpu = gpu();
    let text = EXAMPLE.replace(BLURRED.0, BLURRED.1);
    let plan = compiled(&text, &capabilities(&gpu), &[("light_depth", light(1))]);
    let map = depth_map::texture(&gpu, wgpu::TextureFormat::Depth32Float, MAP, 3, 1);
    let draw = |turn| {
        (0..3).for_each(|layer| depth_map::draw(&gpu, &map, layer, &pattern(layer, turn, 1)))
    };
    let bytes = plan.parameters.initial();
    let bound = bind(
        &gpu,
        plan,
        &[("light_depth", ImportedResource::from(&map))],
        &bytes,
    );
    draw(0);
    bound.run(&gpu);
    let before = layers_of(&gpu, &bound);
    assert!(before[0] != before[1] && before[1] != before[2]);
    // All depths change, but only one layer is said to be dirty.
    draw(1);
    bound.run_layers(&gpu, Layers::Only(&[1]));
    let after = layers_of(&gpu, &bound);
    assert_eq!((&before[0], &before[2]), (&after[0], &after[2]));
    assert_ne!(before[1], after[1]);
    bound.run_layers(&gpu, Layers::Only(&[]));
    assert_eq!(layers_of(&gpu, &bound), after);
    // What is made by layer is what is made at once.
    bound.run_layers(&gpu, Layers::Only(&[2, 0]));
    let by_layer = layers_of(&gpu, &bound);
    bound.run(&gpu);
    assert_eq!(layers_of(&gpu, &bound), by_layer);
}

#[test]
fn multisampled_layers_are_a_list_of_textures() {
    let gpu = gpu();
    let text = EXAMPLE.replace(BLURRED.0, BLURRED.1);
    let plan = compiled(&text, &capabilities(&gpu), &[("light_depth", light(4))]);
    let maps: Vec<wgpu::Texture> = (0..3)
        .map(|_| depth_map::texture(&gpu, wgpu::TextureFormat::Depth32Float, MAP, 1, 4))
        .collect();
    let draw = |turn| {
        for (layer, map) in (0..).zip(&maps) {
            depth_map::draw(&gpu, map, 0, &pattern(layer, turn, 4));
        }
    };
    let bytes = plan.parameters.initial();
    let imports = [("light_depth", ImportedResource::Layers(maps.clone()))];
    let bound = bind(&gpu, plan.clone(), &imports, &bytes);
    draw(0);
    bound.run(&gpu);
    let before = layers_of(&gpu, &bound);
    draw(1);
    bound.run_layers(&gpu, Layers::Only(&[2]));
    let after = layers_of(&gpu, &bound);
    assert_eq!(before[..2], after[..2]);
    assert_ne!(before[2], after[2]);
    let two = [("light_depth", ImportedResource::Layers(maps[..2].to_vec()))];
    let error = crate::setup::try_bind(&gpu, plan, &two, &bytes)
        .err()
        .unwrap();
    is_wrong(&error, "is a list of 2 textures,");
}

#[test]
fn single_sampled_layers_may_be_a_list_too() {
    let gpu = gpu();
    let text = EXAMPLE.replace(BLURRED.0, BLURRED.1);
    let plan = compiled(&text, &capabilities(&gpu), &[("light_depth", light(1))]);
    let bytes = plan.parameters.initial();
    let array = depth_map::texture(&gpu, wgpu::TextureFormat::Depth32Float, MAP, 3, 1);
    let list: Vec<wgpu::Texture> = (0..3)
        .map(|layer| {
            let map = depth_map::texture(&gpu, wgpu::TextureFormat::Depth32Float, MAP, 1, 1);
            depth_map::draw(&gpu, &map, 0, &pattern(layer, 0, 1));
            depth_map::draw(&gpu, &array, layer, &pattern(layer, 0, 1));
            map
        })
        .collect();
    let pictures = [
        ImportedResource::from(&array),
        ImportedResource::Layers(list.clone()),
    ]
    .map(|import| {
        let bound = bind(&gpu, plan.clone(), &[("light_depth", import)], &bytes);
        bound.run(&gpu);
        layers_of(&gpu, &bound)
    });
    assert_eq!(pictures[0], pictures[1]);
}

#[test]
fn shading_reads_clean_layers_although_their_memory_is_shared() {
    let gpu = gpu();
    let camera_desc = TextureDesc::new(TextureFormat::Depth32Float, PICTURE);
    let plan = compiled(
        EXAMPLE,
        &capabilities(&gpu),
        &[("light_depth", light(1)), ("camera_depth", camera_desc)],
    );
    assert_eq!(plan.memory[0].label, "resolve.map | blur.blurred");
    let map = depth_map::texture(&gpu, wgpu::TextureFormat::Depth32Float, MAP, 3, 1);
    let camera = depth_map::of(&gpu, PICTURE, |_, _| 0.7);
    let imports = [
        ("light_depth", ImportedResource::from(&map)),
        ("camera_depth", ImportedResource::from(&camera)),
    ];
    let views: Vec<u8> = (0..3)
        .flat_map(|layer| block(&plan, &aligned_view(layer)))
        .collect();
    let size = u64::from(plan.parameters.size);
    let bound = bind(&gpu, plan, &imports, &views);
    let picture_of = |layers: Layers<'_>, view: u64| {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for stage in Stage::ALL {
            let recording = Recording {
                layers,
                parameter_offset: view * size,
                ..Recording::default()
            };
            bound
                .bindings
                .record(stage, &mut encoder, recording)
                .unwrap();
        }
        gpu.queue.submit([encoder.finish()]);
        bound.read(&gpu, "shadow_intensity", 0)
    };
    (0..3).for_each(|layer| depth_map::draw(&gpu, &map, layer, &pattern(layer, 0, 1)));
    let before = [0, 1, 2].map(|view| picture_of(Layers::All, view));
    assert!(before[0] != before[1] && before[1] != before[2]);
    (0..3).for_each(|layer| depth_map::draw(&gpu, &map, layer, &pattern(layer, 1, 1)));
    let after = [0, 1, 2].map(|view| picture_of(Layers::Only(&[1]), view));
    assert_eq!((&before[0], &before[2]), (&after[0], &after[2]));
    assert_ne!(before[1], after[1]);
}
