//! Reading glTF accessors with every offset checked: the iterators of crate `gltf` trust the file.

use std::cell::Cell;

use gltf::json;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::validation::Checked;

/// No scene for this host has more of anything; what asks for more is broken or hostile.
pub(super) const MOST_ELEMENTS: u64 = 1 << 23;

/// The most elements that are read over all uses of all accessors: positions, normals, coordinates and indices of as many
/// vertices as there may be, and some more. An accessor without data takes no room in a file, and may be used many times.
const MOST_READ: u64 = 8 * MOST_ELEMENTS;

/// The document and the bytes of its buffers.
pub(super) struct Reader<'a> {
    pub(super) root: &'a json::Root,
    pub(super) buffers: &'a [Vec<u8>],
    /// Elements read so far.
    read: Cell<u64>,
}

/// `count` elements of equal size in a buffer, known to lie within it.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    component: ComponentType,
    normalized: bool,
}

impl Elements<'_> {
    /// Component `number` of element `element` as a float, normalised integers mapped to [0, 1] or [-1, 1].
    fn float(&self, element: usize, number: usize) -> f32 {
        let at = element * self.stride + number * self.component.size();
        let byte = |offset: usize| self.bytes[at + offset];
        let scale = |value: f32, most: f32| {
            if self.normalized {
                (value / most).max(-1.0)
            } else {
                value
            }
        };
        match self.component {
            ComponentType::I8 => scale(f32::from(byte(0) as i8), 127.0),
            ComponentType::U8 => scale(f32::from(byte(0)), 255.0),
            ComponentType::I16 => scale(f32::from(i16::from_le_bytes([byte(0), byte(1)])), 32767.0),
            ComponentType::U16 => scale(f32::from(u16::from_le_bytes([byte(0), byte(1)])), 65535.0),
            ComponentType::U32 => u32::from_le_bytes([byte(0), byte(1), byte(2), byte(3)]) as f32,
            ComponentType::F32 => f32::from_le_bytes([byte(0), byte(1), byte(2), byte(3)]),
        }
    }

    /// Element `element` as an index; `None` if the component type cannot be one.
    fn index(&self, element: usize) -> Option<u32> {
        let at = element * self.stride;
        let byte = |offset: usize| self.bytes[at + offset];
        match self.component {
            ComponentType::U8 => Some(u32::from(byte(0))),
            ComponentType::U16 => Some(u32::from(u16::from_le_bytes([byte(0), byte(1)]))),
            ComponentType::U32 => Some(u32::from_le_bytes([byte(0), byte(1), byte(2), byte(3)])),
            ComponentType::I8 | ComponentType::I16 | ComponentType::F32 => None,
        }
    }
}

impl<'a> Reader<'a> {
    pub(super) fn new(root: &'a json::Root, buffers: &'a [Vec<u8>]) -> Self {
        Self {
            root,
            buffers,
            read: Cell::new(0),
        }
    }

    /// The bytes of buffer view `index`.
    pub(super) fn view(&self, index: usize) -> Result<&'a [u8], String> {
        let view = self
            .root
            .buffer_views
            .get(index)
            .ok_or_else(|| format!("there is no buffer view {index}"))?;
        let number = view.buffer.value();
        let buffer = self.buffers.get(number).ok_or_else(|| {
            format!("buffer view {index} names buffer {number}, which does not exist")
        })?;
        let start = view.byte_offset.map_or(0, |offset| offset.0);
        let length = view.byte_length.0;
        start
            .checked_add(length)
            .and_then(|end| buffer.get(usize::try_from(start).ok()?..usize::try_from(end).ok()?))
            .ok_or_else(|| {
                format!(
                    "buffer view {index} takes {length} bytes from {start}, but buffer {number} has {}",
                    buffer.len()
                )
            })
    }

    /// `count` elements from `offset` in buffer view `view`, each of `components` components.
    fn elements(
        &self,
        view: usize,
        offset: u64,
        count: u64,
        component: ComponentType,
        components: usize,
        normalized: bool,
    ) -> Result<Elements<'a>, String> {
        let bytes = self.view(view)?;
        let size = component.size() * components;
        let stride = self.root.buffer_views[view]
            .byte_stride
            .map_or(size, |stride| stride.0);
        if stride < size {
            return Err(format!(
                "buffer view {view} has a stride of {stride} bytes, but an element has {size}"
            ));
        }
        // Both factors are far below 2^32, so only adding the offset can overflow.
        let needed = if count == 0 {
            0
        } else {
            (count - 1) * stride as u64 + size as u64
        };
        let tail = usize::try_from(offset)
            .ok()
            .and_then(|offset| bytes.get(offset..))
            .filter(|tail| tail.len() as u64 >= needed)
            .ok_or_else(|| {
                format!(
                    "{count} elements of stride {stride} from {offset} need {needed} bytes, but buffer view {view} has {}",
                    bytes.len()
                )
            })?;
        Ok(Elements {
            bytes: tail,
            stride,
            component,
            normalized,
        })
    }

    /// The accessor's header, with its type checked.
    fn accessor(
        &self,
        index: usize,
        kind: Type,
    ) -> Result<(&'a json::Accessor, ComponentType), String> {
        let accessor = self
            .root
            .accessors
            .get(index)
            .ok_or_else(|| "it does not exist".to_owned())?;
        if accessor.count.0 > MOST_ELEMENTS {
            return Err(format!(
                "it has {} elements, more than the limit of {MOST_ELEMENTS}",
                accessor.count.0
            ));
        }
        self.read.set(self.read.get() + accessor.count.0);
        if self.read.get() > MOST_READ {
            return Err(format!(
                "the accessors up to this one have more than {MOST_READ} elements together, counted once per use"
            ));
        }
        match (accessor.component_type, accessor.type_) {
            (Checked::Valid(component), Checked::Valid(found)) if found == kind => {
                Ok((accessor, component.0))
            }
            (_, found) => Err(format!("it is of type {found:?}, not {kind:?}")),
        }
    }

    /// Accessor `index` as vectors of `N` floats.
    pub(super) fn vectors<const N: usize>(
        &self,
        index: usize,
        kind: Type,
    ) -> Result<Vec<[f32; N]>, String> {
        let (accessor, component) = self.accessor(index, kind)?;
        let count = accessor.count.0;
        let read = |elements: &Elements<'_>, element: usize| -> [f32; N] {
            std::array::from_fn(|number| elements.float(element, number))
        };
        let mut values = match accessor.buffer_view {
            Some(view) => {
                let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
                let elements = self.elements(
                    view.value(),
                    offset,
                    count,
                    component,
                    N,
                    accessor.normalized,
                )?;
                (0..count as usize)
                    .map(|element| read(&elements, element))
                    .collect()
            }
            None => vec![[0.0; N]; count as usize],
        };
        if let Some(sparse) = &accessor.sparse {
            let Checked::Valid(index_type) = sparse.indices.component_type else {
                return Err("its sparse indices have an unknown component type".to_owned());
            };
            if sparse.count.0 > count {
                return Err(format!(
                    "it replaces {} of {count} elements",
                    sparse.count.0
                ));
            }
            let indices = self.elements(
                sparse.indices.buffer_view.value(),
                sparse.indices.byte_offset.0,
                sparse.count.0,
                index_type.0,
                1,
                false,
            )?;
            let replacements = self.elements(
                sparse.values.buffer_view.value(),
                sparse.values.byte_offset.0,
                sparse.count.0,
                component,
                N,
                accessor.normalized,
            )?;
            for element in 0..sparse.count.0 as usize {
                let target = indices
                    .index(element)
                    .and_then(|index| values.get_mut(index as usize))
                    .ok_or_else(|| format!("sparse entry {element} names no element"))?;
                *target = read(&replacements, element);
            }
        }
        Ok(values)
    }

    /// Accessor `index` as vertex indices.
    pub(super) fn indices(&self, index: usize) -> Result<Vec<u32>, String> {
        let (accessor, component) = self.accessor(index, Type::Scalar)?;
        let view = accessor
            .buffer_view
            .filter(|_| accessor.sparse.is_none())
            .ok_or_else(|| "indices must lie in a buffer view, and not be sparse".to_owned())?;
        let offset = accessor.byte_offset.map_or(0, |offset| offset.0);
        let elements =
            self.elements(view.value(), offset, accessor.count.0, component, 1, false)?;
        (0..accessor.count.0 as usize)
            .map(|element| {
                elements
                    .index(element)
                    .ok_or_else(|| format!("indices cannot be of type {component:?}"))
            })
            .collect()
    }
}
