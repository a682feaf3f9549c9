//! A node's passes: shaders, what their variables hold, and the work that is recorded.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::Access;

/// One dispatch or draw per layer (or per frame).
#[must_use]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pass {
    /// The name, unique within the node.
    pub label: String,
    /// Linked WGSL; empty for a host's pass.
    pub wgsl: String,
    /// The compute or fragment entry point. A fullscreen pass also has a vertex entry point named `fullscreen`.
    pub entry_point: String,
    /// What the variables hold that the entry point uses.
    pub bindings: Vec<Binding>,
    /// Values of the shader's `override` constants.
    pub constants: BTreeMap<String, f64>,
    /// The plane that bindings of a single layer mean, where a map has several.
    #[serde(default)]
    pub plane: u32,
    /// Once per dirty layer of what is covered or drawn to; otherwise once.
    #[serde(default)]
    pub each_layer: bool,
    /// What is recorded.
    pub work: Work,
}

/// What a variable of a shader holds: in a node's description by slots, in a plan by indices.
#[must_use]
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Binding<V = String, R = BindingResource> {
    /// The WGSL variable: its name, from whose declaration the compiler takes bind group and number; in a plan its number.
    #[serde(rename = "binding")]
    pub variable: V,
    /// What the variable holds.
    pub resource: R,
}

/// What a binding holds.
#[must_use]
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BindingResource {
    /// The node's uniform data.
    Parameters,
    /// The regions of a slot's map in the layer that the pass is recorded for: a uniform array of `MapRegion`, which all
    /// nodes share that work on maps with those regions.
    Regions {
        /// The slot.
        slot: String,
        /// The fewest texels that a region can have along each side.
        smallest: u32,
    },
    /// A mip level of one layer of a texture, loaded or sampled: the layer that the pass is recorded for.
    Level {
        /// The slot.
        slot: String,
        /// The mip level.
        level: u32,
    },
    /// All layers of a texture, with all their planes, loaded or sampled.
    Layers(String),
    /// A mip level of one layer of a texture, written.
    StorageLevel {
        /// The slot.
        slot: String,
        /// The mip level.
        level: u32,
        /// The plane, where it is not the pass's.
        plane: Option<u32>,
    },
    /// A storage buffer.
    Buffer(String),
    /// A sampler that clamps to the edge.
    Sampler {
        /// Linear within and between mip levels; otherwise nearest.
        filtering: bool,
        /// The most probes of an anisotropic lookup, 1 to 16. More than one needs `filtering`.
        anisotropy: u16,
    },
    /// A comparison sampler that clamps to the edge and filters linearly.
    ComparisonSampler {
        /// Passes references that are less than the texel, for maps that store 1 at the near plane; otherwise those that are
        /// greater.
        reversed: bool,
    },
}

/// What a pass records.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Work {
    /// A dispatch that covers a mip level of a texture.
    Compute {
        /// The slot that is covered.
        covers: String,
        /// The mip level that is covered.
        level: u32,
        /// Texels that one workgroup covers.
        texels_per_workgroup: [u32; 2],
        /// Only the regions of each layer. Where a layer can have one region, workgroups lie in a grid from its origin on.
        /// Where it can have more, they are numbered through the regions, row by row of each; there are enough of them for
        /// any regions that do not overlap.
        regions: bool,
    },
    /// A triangle over the whole of a mip level of a target, which need not be cleared.
    Fullscreen {
        /// The slot that is drawn to; of a map with planes the pass's plane.
        target: String,
        /// The mip level that is drawn to.
        level: u32,
        /// The shader discards what lies in no region; the target keeps its contents there.
        regions: bool,
    },
    /// A hole in the plan where the host draws.
    Host {
        /// The colour targets; of maps with planes all of those.
        targets: Vec<String>,
        /// Whether the host blends into them.
        blend: bool,
        /// The depth target.
        depth: Option<String>,
    },
}

/// Uniform data that a host fills in for each view.
#[must_use]
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ParameterBlock {
    /// The WGSL struct's name.
    pub name: String,
    /// The struct's size in bytes.
    pub size: u32,
    /// How many structs a binding holds: more than one are a uniform array.
    pub elements: u32,
    /// Whether there is one struct (or array) per layer of this slot; otherwise one.
    pub each_layer_of: Option<String>,
    /// What each struct holds until the host writes something else; zeros where empty.
    pub initial: Vec<u8>,
}

impl Pass {
    /// A pass without a shader: a host's, or one that [`shader`](Self::shader) completes.
    pub fn new(label: impl Into<String>, work: Work) -> Self {
        Self {
            label: label.into(),
            wgsl: String::new(),
            entry_point: String::new(),
            bindings: Vec::new(),
            constants: BTreeMap::new(),
            plane: 0,
            each_layer: false,
            work,
        }
    }

    /// A dispatch that covers a slot's texture, once.
    pub fn compute(label: impl Into<String>, covers: &str, texels_per_workgroup: [u32; 2]) -> Self {
        Self::new(
            label,
            Work::Compute {
                covers: covers.to_owned(),
                level: 0,
                texels_per_workgroup,
                regions: false,
            },
        )
    }

    /// A triangle over the whole of a slot's texture, drawn once.
    pub fn fullscreen(label: impl Into<String>, target: &str) -> Self {
        Self::new(
            label,
            Work::Fullscreen {
                target: target.to_owned(),
                level: 0,
                regions: false,
            },
        )
    }

    /// A hole where the host draws, without blending, to colour targets and perhaps to a depth target.
    pub fn host(label: impl Into<String>, targets: &[&str], depth: Option<&str>) -> Self {
        Self::new(
            label,
            Work::Host {
                targets: targets.iter().map(|&target| target.to_owned()).collect(),
                blend: false,
                depth: depth.map(str::to_owned),
            },
        )
    }

    /// Drawn by a host that blends into the colour targets.
    pub fn blended(mut self) -> Self {
        if let Work::Host { blend, .. } = &mut self.work {
            *blend = true;
        }
        self
    }

    /// Once per dirty layer.
    pub fn each_layer(self) -> Self {
        Self {
            each_layer: true,
            ..self
        }
    }

    /// Once per dirty layer, over the regions of a mip level.
    pub fn over_regions(mut self, of_level: u32) -> Self {
        if let Work::Compute { level, regions, .. } | Work::Fullscreen { level, regions, .. } =
            &mut self.work
        {
            (*level, *regions) = (of_level, true);
        }
        self.each_layer()
    }

    /// Linked WGSL, and its compute or fragment entry point.
    pub fn shader(self, wgsl: impl Into<String>, entry_point: &str) -> Self {
        Self {
            wgsl: wgsl.into(),
            entry_point: entry_point.to_owned(),
            ..self
        }
    }

    /// What a variable of the shader holds.
    pub fn bind(mut self, variable: &str, resource: BindingResource) -> Self {
        self.bindings.push(Binding::new(variable, resource));
        self
    }

    /// The value of an `override` of the shader.
    pub fn constant(mut self, name: &str, value: impl Into<f64>) -> Self {
        self.constants.insert(name.to_owned(), value.into());
        self
    }

    /// The plane that bindings of one layer mean.
    pub fn plane(self, plane: u32) -> Self {
        Self { plane, ..self }
    }

    /// The same with another slot in place of one.
    pub(crate) fn with_slot(mut self, old: &str, new: &str) -> Self {
        let held = self
            .bindings
            .iter_mut()
            .filter_map(|binding| match &mut binding.resource {
                BindingResource::Regions { slot, .. }
                | BindingResource::Level { slot, .. }
                | BindingResource::Layers(slot)
                | BindingResource::StorageLevel { slot, .. }
                | BindingResource::Buffer(slot) => Some(slot),
                BindingResource::Parameters
                | BindingResource::Sampler { .. }
                | BindingResource::ComparisonSampler { .. } => None,
            });
        let drawn: Vec<&mut String> = match &mut self.work {
            Work::Compute { covers, .. } => vec![covers],
            Work::Fullscreen { target, .. } => vec![target],
            Work::Host { targets, depth, .. } => targets.iter_mut().chain(depth).collect(),
        };
        for slot in held.chain(drawn).filter(|slot| *slot == old) {
            new.clone_into(slot);
        }
        self
    }

    /// The slots that the pass touches, and how. Whether a buffer is written is its slot's to say.
    pub(crate) fn touched(&self) -> Vec<(&str, Access)> {
        let mut touched: Vec<(&str, Access)> = Vec::new();
        for binding in &self.bindings {
            match &binding.resource {
                BindingResource::Level { slot, .. }
                | BindingResource::Layers(slot)
                | BindingResource::Buffer(slot) => touched.push((slot, Access::READ)),
                BindingResource::StorageLevel { slot, .. } => {
                    touched.push((slot, Access::STORAGE_WRITE));
                }
                BindingResource::Parameters
                | BindingResource::Regions { .. }
                | BindingResource::Sampler { .. }
                | BindingResource::ComparisonSampler { .. } => {}
            }
        }
        let drawn: Vec<&String> = match &self.work {
            Work::Compute { .. } => Vec::new(),
            Work::Fullscreen { target, .. } => vec![target],
            Work::Host { targets, depth, .. } => targets.iter().chain(depth).collect(),
        };
        touched.extend(
            drawn
                .into_iter()
                .map(|slot| (slot.as_str(), Access::RENDER_TARGET)),
        );
        touched
    }
}

impl Binding {
    /// What a variable holds.
    pub fn new(variable: &str, resource: BindingResource) -> Self {
        Self {
            variable: variable.to_owned(),
            resource,
        }
    }
}

impl ParameterBlock {
    /// One struct of this size and name, zeros at first.
    pub fn of<P: bytemuck::NoUninit>(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            // The compiler refuses a struct of 4 GiB as uniform data.
            size: u32::try_from(size_of::<P>()).unwrap_or(u32::MAX),
            elements: 1,
            each_layer_of: None,
            initial: Vec::new(),
        }
    }

    /// A uniform array of so many structs.
    pub fn elements(self, elements: u32) -> Self {
        Self { elements, ..self }
    }

    /// One struct or array per layer of a slot.
    pub fn each_layer_of(mut self, slot: &str) -> Self {
        self.each_layer_of = Some(slot.to_owned());
        self
    }

    /// What each struct holds until the host writes something else.
    pub fn initial<P: bytemuck::NoUninit>(mut self, parameters: &P) -> Self {
        self.initial = bytemuck::bytes_of(parameters).to_vec();
        self
    }
}
