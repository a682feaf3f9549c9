//! Errors alone, without times and a folder.

use super::stage::Stage;
use super::{Trade, measure, results::Errors};
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::progress;

/// A technique in a storage, judged on all views of a scene.
#[derive(Clone, Debug)]
pub struct Judged {
    /// The scene as it was named.
    pub scene: String,
    /// The radius of the filter.
    pub radius: u32,
    /// The technique's name with its storage.
    pub name: String,
    /// Errors, view by view.
    pub views: Vec<Errors>,
}

impl Trade {
    /// Judges all combinations on all scenes; with the adapter's name.
    pub fn judge(&self) -> Result<(String, Vec<Judged>), LabError> {
        let file = Self::graph()?;
        let gpu = Gpu::open(self.profile)?;
        let setting = self.setting(&gpu)?;
        let cells = self.axes.cells();
        let mut found = Vec::new();
        let bar = progress::bar((self.scenes.len() * cells.len()) as u64, "judging");
        for name in &self.scenes {
            bar.set_message(name.clone());
            let (scene, setups) = self.load(name)?;
            let source = (&file, &self.axes);
            let stage = Stage::of(&gpu, source, &setting, &scene).with_views(&setups)?;
            let size = |cell: &super::axes::Cell| (cell.map, cell.samples);
            for alike in cells.chunk_by(|one, other| size(one) == size(other)) {
                let frames = stage.frames(alike[0].map, alike[0].samples)?;
                for &cell in alike {
                    let graph = self.axes.graph(&file, cell)?;
                    let (views, technique, (storage, _), _) =
                        measure::errors(&stage, &frames, cell, &graph)?;
                    let storage = storage.map_or(String::new(), |it| format!(" {it}"));
                    found.push(Judged {
                        scene: name.clone(),
                        radius: cell.radius,
                        name: format!("{}{storage}", technique.name()),
                        views,
                    });
                    bar.inc(1);
                }
            }
        }
        bar.finish_and_clear();
        Ok((setting.adapter, found))
    }
}
