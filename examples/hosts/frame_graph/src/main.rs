//! `moment-shadows-frame-graph FOLDER`: draws each graph in the frame graph, and writes into a folder of its name what was given and
//! what came out, for another process to draw the same.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use moment_shadows_frame_graph::device::Pipelines;
use moment_shadows_frame_graph::error::HostError;
use moment_shadows_frame_graph::frame::{Frame, Options};
use moment_shadows_frame_graph::gpu::Gpu;
use moment_shadows_frame_graph::graphs::{self, Sizes};
use moment_shadows_frame_graph::world::World;

const SIZES: Sizes = Sizes {
    map: [512, 512],
    picture: [320, 180],
};

fn main() -> ExitCode {
    let folder = std::env::args()
        .nth(1)
        .ok_or("give the folder to write to".to_owned());
    let written = folder.and_then(|folder| write_all(&folder).map_err(|error| error.to_string()));
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn write_all(folder: &str) -> Result<(), HostError> {
    let gpu = Gpu::open()?;
    for (name, text) in graphs::ALL {
        write_one(&gpu, &Path::new(folder).join(name), text)?;
    }
    Ok(())
}

fn write_one(gpu: &Gpu, folder: &Path, text: &str) -> Result<(), HostError> {
    let world = World::default();
    let plan = graphs::compile(text, SIZES)?;
    fs::create_dir_all(folder).map_err(|error| failed(folder.into(), error))?;
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        fs::write(&path, bytes).map_err(|error| failed(path, error))
    };
    write("plan.json", &serde_json::to_vec(&plan)?)?;
    write("parameters", &world.parameters(&plan, SIZES)?)?;
    for import in &plan.imports {
        let of = plan.resources[import.value].desc.texture();
        let (layers, samples) = of.map_or((0, 0), |of| (of.array_layers(), of.samples));
        for layer in 0..layers {
            let depths = world.depth(&import.name, layer, samples, SIZES);
            let bytes: Vec<u8> = depths
                .iter()
                .flat_map(|depth| depth.to_le_bytes())
                .collect();
            write(&format!("{}.{layer}.depth", import.name), &bytes)?;
        }
    }
    let pipelines = Pipelines::of_plan(&gpu.device, &plan)?;
    // Once with maps that are kept from frame to frame, as far as layers are left out, and once with all drawn anew.
    for (keeps, ending) in [(true, "keeping"), (false, "frame_graph")] {
        let options = Options {
            leaves_out_layers: keeps,
            ..Options::default()
        };
        let mut frame = Frame::new(gpu, &plan, &pipelines, SIZES, &options)?;
        let drawn = frame.draw_world(gpu, &world)?;
        for (output, texels) in &drawn.pictures {
            write(&format!("{output}.{ending}"), texels)?;
        }
        write(
            &format!("order.{ending}"),
            drawn.order.join("\n").as_bytes(),
        )?;
        write(
            &format!("bytes.{ending}"),
            frame.bytes().to_string().as_bytes(),
        )?;
    }
    Ok(())
}

fn failed(path: PathBuf, source: std::io::Error) -> HostError {
    let path = path.display().to_string();
    HostError::File { path, source }
}
