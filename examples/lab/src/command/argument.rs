//! Arguments that are values of the library, by their own names.

use clap::builder::TypedValueParser;
use glam::DVec3;
use moment_shadows::Storage;
use moment_shadows_graph::command::argument::named;

use crate::techniques::STORAGES;

/// A storage of a map.
pub(super) fn storage() -> impl TypedValueParser<Value = Storage> {
    named(STORAGES, Storage::name)
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

/// How many times as long, up to which single precision has digits left.
pub(super) fn times(text: &str) -> Result<f64, String> {
    let [times] = numbers(text)?;
    (1.0..=1000.0)
        .contains(&times)
        .then_some(times)
        .ok_or_else(|| format!("{times} is not from 1 to 1000"))
}

/// Numbers between commas, as large as places in a scene may be.
fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let number = |part: &str| part.trim().parse().ok();
    let all: Option<Vec<f64>> = text.split(',').map(number).collect();
    all.filter(|all| all.iter().all(|number| number.abs() <= 1e15))
        .and_then(|all| all.try_into().ok())
        .ok_or_else(|| format!("give {N} numbers from -1e15 to 1e15, with commas between them"))
}

/// What a command takes where nothing is given but these arguments.
pub(crate) fn defaults<A: clap::Args>(given: &[&str]) -> A {
    let command = A::augment_args(clap::Command::new("defaults"));
    let matches = command.get_matches_from(["defaults"].iter().chain(given));
    A::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
}

#[cfg(test)]
mod tests {
    use super::{camera, direction, times};
    use glam::DVec3;

    #[test]
    fn directions_have_a_length_cameras_look_somewhere_and_ranges_are_not_too_short() {
        let is_right = |found: DVec3| (found - DVec3::new(0.6, 0.0, -0.8)).length() < 1e-15;
        for text in ["3e-200,0,-4e-200", "+0.75, 0,-1", "6e14,0,-8e14"] {
            assert!(direction(text).is_ok_and(is_right), "{text}");
        }
        for text in [
            "0,-0,0", "1,2", "1,2,3,4", "nan,1,1", "1,inf,1", "1,,2", "", "1e16,0,0",
        ] {
            assert!(direction(text).is_err(), "{text}");
        }
        assert_eq!([times("1"), times("1e3")], [Ok(1.0), Ok(1000.0)]);
        assert!(
            ["0.9", "1001", "nan", "", "1,1"]
                .map(times)
                .iter()
                .all(Result::is_err)
        );
        let [eye, target] = [DVec3::new(-1.0, 2.0, -3.0), DVec3::new(4.0, -5.0, 6.0)];
        assert_eq!(camera("-1,2,-3,4,-5,6"), Ok([eye, target]));
        for text in ["1,2,3,1,2,3", "1,2,3", "1,2,3,4,5,nan"] {
            assert!(camera(text).is_err(), "{text}");
        }
    }
}
