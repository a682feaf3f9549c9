//! Draws the scene without a window: `moment-shadows-bevy PICTURE [--graph FILE] [--spot] [--cascades N] [--fog STEPS] [--soft DEGREES]`.

use std::error::Error;

use moment_shadows_bevy::demo::{Fog, Look, draw};

fn main() -> Result<(), Box<dyn Error>> {
    let mut look = Look::default();
    let mut out = None;
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
        match argument.as_str() {
            "--graph" => look.graph = Some(std::fs::read_to_string(value()?)?),
            "--off" => look.enabled = false,
            "--spot" => look.spot = true,
            "--cascades" => look.cascades = value()?.parse()?,
            "--map" => look.map = value()?.parse()?,
            "--soft" => look.sun = value()?.parse::<f64>()?.to_radians(),
            "--fog" => look.fog = Fog::Bevys(value()?.parse()?),
            "--air" => look.fog = Fog::Filtered,
            _ => out = Some(argument),
        }
    }
    let out = out.ok_or("name the picture to be written")?;
    let drawn = draw(&look, [640, 360], 5)?;
    for picture in drawn.pictures {
        picture.try_into_dynamic()?.to_rgb8().save(&out)?;
    }
    println!("{out}: {:.1} ms a frame", drawn.frame.as_secs_f64() * 1e3);
    Ok(())
}
