//! Draws the scene of the folder, in a window or into a picture.

use std::error::Error;

use bevy::app::AppExit;
use moment_shadows_bevy::demo::{Fog, Look, Stage, show};

const USAGE: &str = "usage: moment-shadows-bevy [PICTURE] [OPTION]...
  PICTURE          the file to write; without it a window opens, where the space bar switches the graph off and on
  --graph FILE     shadows by a graph file; without it Bevy's own
  --cascades N     cascades of the sun, 1 to 4; 0 for no sun
  --spot           a spot light, too
  --soft DEGREES   the sun's diameter, for graphs that end in a summed-area table
  --air            fog by the graph's output 'scattering'
  --fog STEPS      fog by Bevy, which marches so many steps
  --map TEXELS     width and height of shadow maps, a power of two";

fn main() -> AppExit {
    run().unwrap_or_else(|error| {
        eprintln!("{error}");
        AppExit::error()
    })
}

fn run() -> Result<AppExit, Box<dyn Error>> {
    let mut look = Look::default();
    let mut picture = None;
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || {
            arguments
                .next()
                .ok_or(format!("{argument} needs a value\n{USAGE}"))
        };
        match argument.as_str() {
            "--graph" => {
                let file = value()?;
                let text = std::fs::read_to_string(&file);
                look.graph = Some(text.map_err(|error| format!("{file}: {error}"))?);
            }
            "--cascades" => look.cascades = value()?.parse()?,
            "--spot" => look.spot = true,
            "--soft" => look.sun = value()?.parse::<f64>()?.to_radians(),
            "--air" => look.fog = Fog::Filtered,
            "--fog" => look.fog = Fog::Bevys(value()?.parse()?),
            "--map" => look.map = value()?.parse()?,
            option if option.starts_with('-') => {
                Err(format!("there is no option {option}\n{USAGE}"))?
            }
            _ => picture = Some(argument),
        }
    }
    let Some(file) = picture else {
        return Ok(show(&look));
    };
    let mut stage = Stage::new(&look, [1280, 720]);
    // Bevy needs a few frames to find out how much room spot lights take in its clusters.
    let time = stage.frame_time(5)?.as_secs_f64() * 1e3;
    for picture in stage.pictures()? {
        picture.try_into_dynamic()?.to_rgb8().save(&file)?;
    }
    println!("{file}: {time:.0} ms a frame");
    Ok(AppExit::Success)
}
