//! `moment-shadows-plan-recorder FOLDER`: draws the plans in the folders there with the recorder of moment-shadows, and says how the
//! frame graph's pictures, order and memory differ. Fails where a picture differs by more than 1/255.

mod compare;
mod error;
mod input;
mod record;

use std::process::ExitCode;

use compare::Seen;
use error::RecorderError;
use input::Input;
use record::Recorder;

/// The largest difference that is one of rounding to 8 bits.
const LARGEST: f32 = 1.0 / 255.0;

fn main() -> ExitCode {
    let folder = std::env::args().nth(1).ok_or(RecorderError::NoFolder);
    match folder.and_then(|folder| compare_all(&folder)) {
        Ok(worst) if worst <= LARGEST => ExitCode::SUCCESS,
        Ok(worst) => {
            eprintln!("a picture differs by {worst}, which is more than 1/255");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// The worst difference of all pictures.
fn compare_all(folder: &str) -> Result<f32, RecorderError> {
    let recorder = Recorder::open()?;
    let mut worst: f32 = 0.0;
    for input in Input::all(folder)? {
        let plan = &input.plan;
        println!("{}", input.name);
        let order: Vec<String> = plan.passes.iter().map(|pass| pass.name()).collect();
        let others = input.text("order.frame_graph")?;
        println!("  recorder:    {}", order.join(", "));
        println!("  frame graph: {}", others.replace('\n', ", "));
        let (shared, kept) = (
            input.text("bytes.frame_graph")?,
            input.text("bytes.keeping")?,
        );
        println!("  bytes of the recorder: {}", plan.bytes_resident());
        println!("  of the frame graph: {shared}; where it keeps maps for the next frame: {kept}");
        for (output, drawn) in recorder.draw(&input)? {
            for ending in ["frame_graph", "keeping"] {
                let others = input.bytes(&format!("{output}.{ending}"))?;
                let seen = compare::pictures(plan.output_texture(&output), &drawn, &others)?;
                let (
                    Seen {
                        values, difference, ..
                    },
                    [least, most],
                ) = (&seen, seen.range);
                println!(
                    "  {output}, {ending}: {values} values from {least} to {most}, worst difference {difference}"
                );
                worst = worst.max(seen.difference);
            }
        }
    }
    Ok(worst)
}
