//! Arguments that are values of the library, by their own names.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use glam::DVec3;
use moment_shadows::{Profile, Storage};

use crate::techniques::STORAGES;

/// A storage of a map.
pub(super) fn storage() -> impl TypedValueParser<Value = Storage> {
    named(STORAGES, Storage::name)
}

/// A profile.
pub(super) fn profile() -> impl TypedValueParser<Value = Profile> {
    named(Profile::ALL, Profile::name)
}

/// A direction of any length but zero, as X,Y,Z.
pub(super) fn direction(text: &str) -> Result<DVec3, String> {
    let direction = DVec3::from_array(numbers(text)?);
    // Scaled first: the square of a length may be beyond all numbers.
    let scaled = direction / direction.abs().max_element();
    let unit = scaled.try_normalize();
    unit.ok_or_else(|| "a light without a direction shines nowhere".to_owned())
}

/// Where a camera stands and what it looks at, as EX,EY,EZ,TX,TY,TZ.
pub(super) fn camera(text: &str) -> Result<[DVec3; 2], String> {
    let [eye_x, eye_y, eye_z, x, y, z] = numbers(text)?;
    let [eye, target] = [DVec3::new(eye_x, eye_y, eye_z), DVec3::new(x, y, z)];
    if eye == target {
        return Err("the camera stands where it looks".to_owned());
    }
    Ok([eye, target])
}

/// Numbers between commas, as large as places in a scene may be.
fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let number = |part: &str| part.trim().parse().ok();
    let all: Option<Vec<f64>> = text.split(',').map(number).collect();
    all.filter(|all| all.iter().all(|number| number.abs() <= 1e15))
        .and_then(|all| all.try_into().ok())
        .ok_or_else(|| format!("give {N} numbers from -1e15 to 1e15, with commas between them"))
}

/// What a command takes where nothing is given.
pub(crate) fn defaults<A: clap::Args>() -> A {
    let command = A::augment_args(clap::Command::new("defaults"));
    let matches = command.get_matches_from(["defaults"]);
    A::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
}

fn named<T: Copy + Send + Sync + 'static, const COUNT: usize>(
    all: [T; COUNT],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(all.map(name)).try_map(move |text| {
        let found = all.into_iter().find(|&value| name(value) == text);
        found.ok_or("there is no such name")
    })
}
