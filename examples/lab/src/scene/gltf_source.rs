//! What a glTF file is made of: vectors and indices in buffers, images, and files beside it.

use std::io::Cursor;
use std::path::Path;

use gltf::accessor::{Accessor, DataType, Item, Iter};
use gltf::buffer::{self, Data};
use gltf::image::Source as ImageSource;
use image::ImageReader;

use super::Image;

/// The most bytes of a file, and of all that is read from accessors and images, counted once per use: an accessor may
/// claim millions of zeros that take no room in the file, and instances multiply what is small by itself.
const MOST_BYTES: u64 = 1 << 30;

/// The buffers of a file, and where it lies.
pub(super) struct Source<'a> {
    folder: &'a Path,
    buffers: &'a [Data],
    /// Bytes read so far.
    taken: u64,
}

impl<'a> Source<'a> {
    pub(super) fn new(folder: &'a Path, buffers: &'a [Data]) -> Self {
        Self {
            folder,
            buffers,
            taken: 0,
        }
    }

    /// Counts what is about to be read.
    pub(super) fn take(&mut self, count: usize, size: usize) -> Result<(), String> {
        let bytes = (count as u64).saturating_mul(size as u64);
        self.taken = self.taken.saturating_add(bytes);
        if self.taken > MOST_BYTES {
            return Err(format!(
                "the scene up to here takes more than the limit of {MOST_BYTES} bytes"
            ));
        }
        Ok(())
    }

    /// The accessor's elements, as they are stored. Where it has no data, they are zero.
    fn read<T: Item + Clone>(&self, accessor: &Accessor<'_>) -> Result<Vec<T>, String> {
        let count = accessor.count();
        if count == 0 || accessor.view().is_none() && accessor.sparse().is_none() {
            return Ok(vec![T::zero(); count]);
        }
        let buffers = self.buffers;
        let bytes = |buffer: buffer::Buffer<'_>| buffers.get(buffer.index()).map(|data| &data[..]);
        Iter::<T>::new(accessor.clone(), bytes)
            .map(Vec::from_iter)
            .filter(|values| values.len() == count)
            .ok_or_else(|| format!("its {count} elements reach beyond the buffer view or buffer"))
    }

    /// An accessor's vectors as floats, which have to be finite. Messages call it `name`.
    pub(super) fn floats<const N: usize>(
        &mut self,
        accessor: &Accessor<'_>,
        name: &str,
    ) -> Result<Vec<[f32; N]>, String>
    where
        [i8; N]: Item,
        [u8; N]: Item,
        [i16; N]: Item,
        [u16; N]: Item,
        [f32; N]: Item,
    {
        let failed = |reason| format!("{name} (accessor {}): {reason}", accessor.index());
        self.take(accessor.count(), size_of::<[f32; N]>())
            .map_err(failed)?;
        let most = |most: f32| accessor.normalized().then_some(most);
        let size = accessor.dimensions().multiplicity();
        let values = match accessor.data_type() {
            _ if size != N => Err(format!("it has {size} components, not {N}")),
            DataType::F32 => self.read(accessor),
            DataType::I8 => self.read::<[i8; N]>(accessor).map(floats(most(127.0))),
            DataType::U8 => self.read::<[u8; N]>(accessor).map(floats(most(255.0))),
            DataType::I16 => self.read::<[i16; N]>(accessor).map(floats(most(32767.0))),
            DataType::U16 => self.read::<[u16; N]>(accessor).map(floats(most(65535.0))),
            DataType::U32 => Err("its components are of type U32".to_owned()),
        };
        let values = values.map_err(failed)?;
        check(name, &values, f32::MAX)?;
        Ok(values)
    }

    /// The vertex indices of a primitive that has them.
    pub(super) fn indices(
        &mut self,
        primitive: &gltf::Primitive<'_>,
    ) -> Result<Option<Vec<u32>>, String> {
        let Some(accessor) = primitive.indices() else {
            return Ok(None);
        };
        let failed = |reason| format!("indices (accessor {}): {reason}", accessor.index());
        // A strip becomes a list of up to three times as many.
        self.take(accessor.count(), size_of::<[u32; 3]>())
            .map_err(failed)?;
        let indices = match accessor.data_type() {
            DataType::U8 => self.read::<u8>(&accessor).map(widened),
            DataType::U16 => self.read::<u16>(&accessor).map(widened),
            DataType::U32 => self.read(&accessor),
            other => Err(format!("they cannot be of type {other:?}")),
        };
        indices.map(Some).map_err(failed)
    }

    /// An image, decoded to eight bits per channel.
    pub(super) fn image(&mut self, image: &gltf::Image<'_>) -> Result<Image, String> {
        let fetched;
        let bytes = match image.source() {
            ImageSource::View { view, .. } => self.buffers[view.buffer().index()]
                .get(view.offset()..view.offset().saturating_add(view.length()))
                .ok_or("its buffer view reaches beyond the buffer")?,
            ImageSource::Uri { uri, .. } => {
                check_uri(self.folder, uri)?;
                fetched = Data::from_source(buffer::Source::Uri(uri), Some(self.folder))
                    .map_err(|error| error.to_string())?;
                &fetched[..]
            }
        };
        // A few bytes may claim millions of texels, whether or not they can be decoded.
        let text = |error: image::ImageError| error.to_string();
        let reader = || ImageReader::new(Cursor::new(bytes)).with_guessed_format();
        let opened = reader().map_err(|error| error.to_string())?;
        let (width, height) = opened.into_dimensions().map_err(text)?;
        let texels = (width as usize).saturating_mul(height as usize);
        self.take(texels, size_of::<[u8; 4]>())?;
        let opened = reader().map_err(|error| error.to_string())?;
        let decoded = opened.decode().map_err(text)?.into_rgba8();
        Ok(Image {
            width: decoded.width(),
            height: decoded.height(),
            rgba: decoded.into_raw(),
        })
    }
}

fn widened<T: Into<u32>>(indices: Vec<T>) -> Vec<u32> {
    indices.into_iter().map(Into::into).collect()
}

/// From integers to floats; `most` is what becomes 1 where they are normalised.
fn floats<T: Into<f32>, const N: usize>(
    most: Option<f32>,
) -> impl Fn(Vec<[T; N]>) -> Vec<[f32; N]> {
    let float = move |component: T| match most {
        None => component.into(),
        Some(most) => (component.into() / most).max(-1.0),
    };
    move |values| values.into_iter().map(|value| value.map(float)).collect()
}

/// Refuses the first value with a component that is NaN, or further than `limit` from zero.
pub(super) fn check<const N: usize>(
    name: &str,
    values: &[[f32; N]],
    limit: f32,
) -> Result<(), String> {
    let is_within = |value: &[f32; N]| value.iter().all(|component| component.abs() <= limit);
    match values.iter().position(|value| !is_within(value)) {
        None => Ok(()),
        Some(vertex) => Err(format!(
            "vertex {vertex}: {name} is {:?}, which is not finite or beyond {limit:e}",
            values[vertex]
        )),
    }
}

/// Refuses what is too large or never ends, as a device or a pipe.
pub(super) fn check_file(path: &Path) -> Result<(), String> {
    match std::fs::metadata(path) {
        Err(error) => Err(error.to_string()),
        Ok(metadata) if !metadata.is_file() => Err("it is no regular file".to_owned()),
        Ok(metadata) if metadata.len() > MOST_BYTES => {
            Err(format!("it is larger than the limit of {MOST_BYTES} bytes"))
        }
        Ok(_) => Ok(()),
    }
}

/// Checks the file that a URI names, relative to `folder`, before the library reads it.
pub(super) fn check_uri(folder: &Path, uri: &str) -> Result<(), String> {
    if uri.starts_with("data:") {
        return Ok(());
    }
    if uri.contains(':') {
        return Err(format!("'{uri}' is neither a data URI nor a relative path"));
    }
    let path = urlencoding::decode(uri).map_err(|error| format!("'{uri}': {error}"))?;
    check_file(&folder.join(&*path)).map_err(|reason| format!("'{uri}': {reason}"))
}
