//! Pictures as files.

use std::io::{Error, ErrorKind, Write};

use moment_shadows_lab::picture;

#[test]
fn a_picture_is_saved_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("result.png");
    picture::save_grey(&path, 2, 1, &[0, 255]).unwrap();
    let before = std::fs::read(&path).unwrap();
    assert!(before.starts_with(b"\x89PNG"));
    type Failing = fn(&mut dyn Write) -> std::io::Result<()>;
    let rows: [(Failing, &str); 2] = [
        (
            |file| {
                file.write_all(b"half of it")?;
                Err(Error::from(ErrorKind::StorageFull))
            },
            "disk is full",
        ),
        (
            |_| Err(Error::from(ErrorKind::PermissionDenied)),
            "permission denied",
        ),
    ];
    for (write, culprit) in rows {
        let error = picture::save_atomically(&path, write).unwrap_err();
        let text = error.to_string();
        assert!(
            text.contains(culprit) && text.contains("result.png"),
            "{text}"
        );
    }
    let error = picture::save_rgba(&path, 2, 2, &[0; 4]).unwrap_err();
    assert!(error.to_string().contains("4 values"), "{error}");
    assert_eq!(std::fs::read(&path).unwrap(), before);
    assert_eq!(
        std::fs::read_dir(folder.path()).unwrap().count(),
        1,
        "a part was left behind"
    );

    let error = picture::save_grey(&folder.path().join("absent/a.png"), 1, 1, &[0]).unwrap_err();
    assert!(
        error.to_string().contains("absent' does not exist"),
        "{error}"
    );
    // Neither a file as a folder nor a folder as a file.
    for target in [path.join("a.png"), folder.path().to_owned()] {
        let error = picture::save_grey(&target, 1, 1, &[0]).unwrap_err();
        assert!(
            error.to_string().contains(&target.display().to_string()),
            "{error}"
        );
    }
    assert_eq!(std::fs::read(&path).unwrap(), before);
    // Replacing is possible.
    picture::save_rgba(&path, 1, 1, &[1, 2, 3, 255]).unwrap();
    assert_ne!(std::fs::read(&path).unwrap(), before);
}

#[test]
fn differences_are_red_where_too_dark_and_blue_where_too_light() {
    let found = [0.5, 1.0, 0.0, 0.6, f32::NAN];
    let truth = [0.5, 0.0, 1.0, 0.5, 0.5];
    let colours = picture::signed_difference(&found, &truth, 0.2);
    let expected = [
        [255, 255, 255, 255],
        [255, 0, 0, 255],
        [0, 0, 255, 255],
        [255, 128, 128, 255],
        [0, 0, 0, 255],
    ];
    for (index, (colour, expected)) in colours.chunks(4).zip(expected).enumerate() {
        // 0.6 - 0.5 in f32 may round the half step either way.
        let distance = colour
            .iter()
            .zip(expected)
            .map(|(a, b): (&u8, u8)| a.abs_diff(b))
            .max();
        assert!(distance <= Some(1), "{index}: {colour:?}");
    }
    assert_eq!(
        picture::grey(&[0.0, 0.5, 1.0, 2.0, -1.0, f32::NAN]),
        [0, 128, 255, 255, 0, 0]
    );
}
