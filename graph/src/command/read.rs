//! Reading text files of a bounded length.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::CommandError;

/// The text of a file. Reads no more than is needed to see that it has more bytes than `longest`.
pub(super) fn read(path: &Path, longest: usize) -> Result<String, CommandError> {
    bounded(path, longest).map_err(|source| CommandError::Read {
        path: path.display().to_string(),
        source,
    })
}

fn bounded(path: &Path, longest: usize) -> io::Result<String> {
    let mut bytes = Vec::new();
    File::open(path)?
        .take(longest as u64 + 1)
        .read_to_end(&mut bytes)?;
    if bytes.len() > longest {
        let message = format!("it is longer than {longest} bytes");
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
    }
    String::from_utf8(bytes)
        .map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "it is not UTF-8 text"))
}
