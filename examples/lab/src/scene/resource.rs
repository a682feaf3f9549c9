//! What a glTF file refers to: buffers and images, beside it, in it, or as data URIs.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use gltf::json;

use super::accessor::Reader;
use super::{Image, SceneError};

/// Files larger than this are refused before they are read.
pub(super) const MOST_BYTES: u64 = 1 << 30;
/// The largest image edge that every device takes as a texture.
const MOST_TEXELS: u32 = 8192;

/// Reads a file, refusing absurd sizes.
pub(super) fn read_file(file: &Path) -> Result<Vec<u8>, SceneError> {
    let failed = |source| SceneError::Read {
        file: file.to_owned(),
        source,
    };
    let metadata = std::fs::metadata(file).map_err(failed)?;
    // A device or a pipe may never end.
    if !metadata.is_file() {
        let reason = "it is no regular file";
        return Err(failed(std::io::Error::new(
            std::io::ErrorKind::InvalidInput,
            reason,
        )));
    }
    let length = metadata.len();
    if length > MOST_BYTES {
        return Err(SceneError::TooLarge {
            file: file.to_owned(),
            item: "the file".to_owned(),
            count: length,
            unit: "bytes",
            limit: MOST_BYTES,
        });
    }
    std::fs::read(file).map_err(failed)
}

/// The bytes that `uri` stands for: a data URI, or a path relative to the folder of `file`.
fn fetch(file: &Path, uri: &str) -> Result<Vec<u8>, String> {
    if uri.starts_with("data:") {
        return gltf::buffer::Data::from_source(gltf::buffer::Source::Uri(uri), None)
            .map(|data| data.0)
            .map_err(|error| format!("its data URI cannot be decoded: {error}"));
    }
    if uri.contains(':') {
        return Err(format!(
            "its URI '{uri}' is neither a data URI nor a relative path"
        ));
    }
    let relative = percent_decoded(uri)
        .ok_or_else(|| format!("its URI '{uri}' is not a percent-encoded path"))?;
    let path: PathBuf = file.parent().unwrap_or(Path::new("")).join(relative);
    read_file(&path).map_err(|error| error.to_string())
}

/// A URI's path with `%XX` replaced; `None` if that is not UTF-8 or an escape is broken.
fn percent_decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        if first == b'%' {
            let digits = std::str::from_utf8(after.get(..2)?).ok()?;
            bytes.push(u8::from_str_radix(digits, 16).ok()?);
            rest = &after[2..];
        } else {
            bytes.push(first);
            rest = after;
        }
    }
    String::from_utf8(bytes).ok()
}

/// The bytes of all buffers; `blob` is the binary chunk of a GLB.
pub(super) fn buffers(
    file: &Path,
    root: &json::Root,
    mut blob: Option<Vec<u8>>,
) -> Result<Vec<Vec<u8>>, SceneError> {
    let load = |(index, buffer): (usize, &json::Buffer)| {
        let failed = |reason| SceneError::Buffer {
            file: file.to_owned(),
            buffer: index,
            reason,
        };
        let bytes = match &buffer.uri {
            Some(uri) => fetch(file, uri).map_err(failed)?,
            None => blob.take().ok_or_else(|| {
                failed("it has no URI and the file no binary chunk for it".into())
            })?,
        };
        if (bytes.len() as u64) < buffer.byte_length.0 {
            return Err(failed(format!(
                "it should have {} bytes, but has {}",
                buffer.byte_length.0,
                bytes.len()
            )));
        }
        Ok(bytes)
    };
    root.buffers.iter().enumerate().map(load).collect()
}

/// Image `index`, decoded to eight bits per channel.
pub(super) fn image(file: &Path, reader: &Reader<'_>, index: usize) -> Result<Image, SceneError> {
    let failed = |reason| SceneError::Image {
        file: file.to_owned(),
        image: index,
        reason,
    };
    let image = reader
        .root
        .images
        .get(index)
        .ok_or_else(|| failed("it does not exist".to_owned()))?;
    let fetched;
    let bytes = match (&image.uri, image.buffer_view) {
        (Some(uri), _) => {
            fetched = fetch(file, uri).map_err(failed)?;
            &fetched[..]
        }
        (None, Some(view)) => reader.view(view.value()).map_err(failed)?,
        (None, None) => return Err(failed("it has neither a URI nor a buffer view".to_owned())),
    };
    let mut decoder = image::ImageReader::new(Cursor::new(bytes))
        .with_guessed_format()
        .map_err(|error| failed(error.to_string()))?;
    let mut limits = image::Limits::default();
    limits.max_image_width = Some(MOST_TEXELS);
    limits.max_image_height = Some(MOST_TEXELS);
    decoder.limits(limits);
    let decoded = decoder
        .decode()
        .map_err(|error| failed(error.to_string()))?
        .into_rgba8();
    Ok(Image {
        width: decoded.width(),
        height: decoded.height(),
        rgba: decoded.into_raw(),
    })
}
