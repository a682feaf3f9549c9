//! The map that a graph shades with, once the graph has run.

use moment_shadows::{MapEncoding, Storage, Technique};
use moment_shadows_graph::{ResourceDesc, TextureDesc};

use super::Evaluation;
use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::{GraphFrame, imports};
use crate::surface_error::fitted::FittedRange;
use crate::surface_error::placed::PlacedLayers;

/// A graph that has run, and gives out its map.
pub struct MapRun {
    /// The graph as run: its shadow intensity is in single precision.
    pub file: GraphFile,
    /// The graph after its run.
    pub graph: GraphFrame,
    /// How `shade_hard` evaluates.
    pub shading: Evaluation,
    /// The output of the filtered map; none where the plain depth map is read.
    output: Option<String>,
    technique: Option<Technique>,
    placed: Option<PlacedLayers>,
    fitted: Option<FittedRange>,
}

/// A map, and how it is evaluated.
pub struct JudgedMap<'a> {
    /// The graph file, for errors.
    pub name: String,
    /// The texture.
    pub texture: &'a wgpu::Texture,
    /// What the texture holds.
    pub desc: TextureDesc,
    /// The technique that `shade_hard` evaluates; otherwise it is that of the map.
    pub technique: Option<Technique>,
    /// The technique as the graph has it; layers that the device placed are given ones in the others.
    asked: Technique,
}

impl MapRun {
    /// Runs a graph on a frame. Techniques that read the plain depth map need a frame with one sample per texel of it.
    pub fn new(gpu: &Gpu, frame: &Frame, file: &GraphFile) -> Result<Self, LabError> {
        let file = file.in_single_precision()?;
        let technique = file.technique();
        let reads_depth = technique.as_ref().is_some_and(Technique::reads_depth);
        let (file, output) = if reads_depth {
            (file, None)
        } else {
            let (file, output) = file.with_filtered_map()?;
            (file, Some(output))
        };
        let (file, placed) = PlacedLayers::of(file)?;
        let (file, fitted) = FittedRange::of(file)?;
        let mut run = Self {
            graph: GraphFrame::new(gpu, frame, &file)?,
            shading: Evaluation::shading(frame, &file)?,
            file,
            output,
            technique,
            placed,
            fitted,
        };
        run.run(gpu)?;
        Ok(run)
    }

    /// Runs the graph on another frame with textures of the same sizes and formats.
    pub fn rerun(&mut self, gpu: &Gpu, frame: &Frame) -> Result<(), LabError> {
        self.graph.rebind(gpu, frame, &self.file)?;
        self.shading = Evaluation::shading(frame, &self.file)?;
        self.run(gpu)
    }

    /// Runs the graph, and reads what the device has found out about the map.
    fn run(&mut self, gpu: &Gpu) -> Result<(), LabError> {
        self.graph.run(gpu)?;
        if let Some(placed) = &mut self.placed {
            placed.read(gpu, &self.graph)?;
        }
        if let Some(fitted) = &self.fitted {
            self.shading.range = fitted.read(gpu, &self.graph)?;
        }
        Ok(())
    }

    /// The map that was shaded with on this frame.
    pub fn map<'a>(&'a self, frame: &'a Frame) -> Result<JudgedMap<'a>, LabError> {
        let found = match &self.output {
            Some(output) => self.filtered(output),
            None => {
                let [(_, light_depth), _] = imports(&frame.desc)?;
                let desc = light_depth.texture().cloned();
                desc.map(|desc| (&frame.light_map.texture, desc))
            }
        };
        let (texture, mut desc) = found.ok_or_else(|| {
            LabError::unsuitable(
                &self.file.name,
                "the input of its shade_hard node is no map",
            )
        })?;
        let mut technique = self.technique.clone();
        let made_for = desc.encoding.as_ref().map(MapEncoding::technique);
        let asked = (technique.as_ref())
            .or(made_for)
            .cloned()
            .unwrap_or_default();
        if let (Some(placed), Some(map)) = (&self.placed, &mut desc.encoding) {
            let unsuitable = |error| LabError::unsuitable(&self.file.name, error);
            let known = placed.technique(map.technique()).map_err(unsuitable)?;
            *map = MapEncoding::new(known.clone(), map.storage()).map_err(unsuitable)?;
            technique = Some(known);
        }
        Ok(JudgedMap {
            name: self.file.name.clone(),
            texture,
            desc,
            technique,
            asked,
        })
    }

    fn filtered(&self, output: &str) -> Option<(&wgpu::Texture, TextureDesc)> {
        let planned = self.graph.plan.outputs.iter();
        let resource = planned.clone().find(|planned| planned.name == output)?;
        let ResourceDesc::Texture(desc) = &self.graph.plan.resources.get(resource.value)?.desc
        else {
            return None;
        };
        Some((self.graph.bindings.output(output)?, desc.clone()))
    }
}

impl JudgedMap<'_> {
    /// The technique as the graph has it.
    #[must_use]
    pub fn technique(&self) -> Technique {
        self.asked.clone()
    }

    /// The technique that it is evaluated with: where the device has placed layers, with these.
    #[must_use]
    pub fn evaluated(&self) -> Technique {
        self.technique.clone().unwrap_or_else(|| self.technique())
    }

    /// The storage of a filterable map.
    #[must_use]
    pub fn storage(&self) -> Option<Storage> {
        match &self.desc.encoding {
            Some(encoding) => Some(encoding.storage()),
            None => Storage::of_format(self.desc.format),
        }
    }

    /// Bits of a texel, all planes.
    #[must_use]
    pub fn bits_per_texel(&self) -> u32 {
        8 * self.desc.format.bytes_per_texel() * self.desc.planes
    }
}
