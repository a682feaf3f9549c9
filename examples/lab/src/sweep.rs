//! How techniques scale: their whole time over the size of the map, that of the picture and the width of the filter, all techniques in
//! the same rounds (the axes of Figure 7 in Peters and Klein, "Moment Shadow Mapping", i3D 2015).

mod report;

use moment_shadows::{MapEncoding, PcfTaps, Profile, Technique};
use moment_shadows_graph::{Stage, TextureDesc};
use serde::Serialize;
use serde_json::json;

use crate::candidate::Candidate;
use crate::command::render::RenderOptions;
use crate::compare;
use crate::cost::clock::{Clock, ClockKind, FEATURES};
use crate::cost::copies::{Copies, CopyWork};
use crate::cost::protocol::{Rounds, Subject};
use crate::cost::report::Conditions;
use crate::cost::statistics::Distribution;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;
use crate::scene;
use crate::techniques::described;
use crate::trade::Trade;

/// What is held while an axis is swept, and what the axes are.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The scene.
    pub scene: String,
    /// What the device offers.
    pub profile: Profile,
    /// Texels per side of maps.
    pub maps: Vec<u32>,
    /// Sizes of pictures.
    pub pictures: Vec<[u32; 2]>,
    /// Texels along a side of the filter: odd.
    pub filters: Vec<u32>,
    /// The map, the picture and the filter where another axis is swept.
    pub held: Point,
    /// The picture where the filter is swept, since wide ones take minutes for many pixels.
    pub picture_of_filters: [u32; 2],
    /// Rounds of times, at least 9.
    pub rounds: u32,
}

/// A place on all axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Point {
    /// Texels per side of the map.
    pub map: u32,
    /// The size of the picture.
    pub picture: [u32; 2],
    /// Texels along a side of the filter.
    pub filter: u32,
}

/// What a sweep gives.
#[derive(Clone, Debug, Serialize)]
pub struct Swept {
    /// Where and how it was measured.
    pub conditions: Conditions,
    /// The scene.
    pub scene: String,
    /// Techniques with their storages, in the order of all rows.
    pub techniques: Vec<String>,
    /// The three axes.
    pub axes: Vec<Axis>,
}

/// A swept axis.
#[derive(Clone, Debug, Serialize)]
pub struct Axis {
    /// What is along it.
    pub name: &'static str,
    /// Its places, ascending.
    pub points: Vec<Times>,
}

/// All techniques at a place.
#[derive(Clone, Debug, Serialize)]
pub struct Times {
    /// The place.
    pub at: Point,
    /// Times of map and picture together, in copies of the map as 64 bits per texel by a compute shader.
    pub copies: Vec<Distribution>,
    /// The same times as ratios to percentage-closer filtering in the shader.
    pub of_percentage_closer: Vec<Distribution>,
}

impl Sweep {
    /// What is compared with a filter of so many texels along a side.
    fn candidates(&self, filter: u32) -> Result<Vec<Candidate>, LabError> {
        let hardware = Technique::Pcf(PcfTaps::Hardware {
            radius: filter / 2,
            reversed: false,
        });
        let mut all = vec![
            Candidate::PercentageCloser,
            Candidate::ReadingDepth(hardware),
        ];
        let mut names = Vec::new();
        for technique in Technique::examples() {
            let is_new = !names.contains(&technique.name());
            names.push(technique.name());
            if let Some(storage) = technique.best_storage(self.profile).filter(|_| is_new) {
                all.push(Candidate::Filterable(MapEncoding::new(technique, storage)?));
            }
        }
        Ok(all)
    }

    /// Steps of progress.
    #[must_use]
    pub fn steps(&self) -> u64 {
        let points = self.maps.len() + self.pictures.len() + self.filters.len();
        points as u64 * u64::from(self.rounds)
    }

    /// Sweeps all axes; `step` is called [`steps`](Self::steps) times.
    pub fn run(&self, step: impl Fn()) -> Result<Swept, LabError> {
        let gpu = Gpu::open_with(self.profile, FEATURES)?;
        let clock = Clock::new(&gpu, ClockKind::for_device(&gpu));
        let held = self.held;
        let maps = self.maps.iter().map(|&map| Point { map, ..held });
        let pictures = self
            .pictures
            .iter()
            .map(|&picture| Point { picture, ..held });
        let filters = self.filters.iter().map(|&filter| Point {
            filter,
            picture: self.picture_of_filters,
            ..held
        });
        let along = |points: Vec<Point>| -> Result<Vec<Times>, LabError> {
            let times = |at| self.times(&gpu, &clock, at, &step);
            points.into_iter().map(times).collect()
        };
        Ok(Swept {
            conditions: Conditions::of(&clock, self.rounds),
            scene: self.scene.clone(),
            techniques: self.names(held.filter)?,
            axes: vec![
                Axis {
                    name: "texels per side of the map",
                    points: along(maps.collect())?,
                },
                Axis {
                    name: "pixels of the picture",
                    points: along(pictures.collect())?,
                },
                Axis {
                    name: "texels per side of the filter",
                    points: along(filters.collect())?,
                },
            ],
        })
    }

    fn names(&self, filter: u32) -> Result<Vec<String>, LabError> {
        let candidates = self.candidates(filter)?;
        let name = |candidate: &Candidate| match candidate {
            Candidate::ReadingDepth(_) => "pcf, comparison samplers".to_owned(),
            Candidate::PercentageCloser => "pcf".to_owned(),
            Candidate::Storage(storage) => storage.to_string(),
            Candidate::Filterable(encoding) => {
                format!("{} {}", described(encoding.technique()), encoding.storage())
            }
        };
        Ok(candidates.iter().map(name).collect())
    }

    /// Times all techniques at a place.
    fn times(
        &self,
        gpu: &Gpu,
        clock: &Clock<'_>,
        at: Point,
        step: &impl Fn(),
    ) -> Result<Times, LabError> {
        let radius = (at.filter / 2).max(1);
        let file = Trade::graph()?;
        let file =
            file.with_kernel(&json!({ "radius": radius, "sigma": 0.6 * f64::from(radius) }))?;
        let scene = scene::load(&self.scene)?;
        let options = RenderOptions {
            map: Some(at.map),
            size: Some(at.picture),
            ..RenderOptions::default()
        };
        let drawn = options.drawn(&file)?;
        let frames = options.frames(gpu, &scene, &drawn, radius)?;
        let mut graphs = Vec::new();
        for candidate in self.candidates(at.filter)? {
            let graph: GraphFile = candidate.graph(&file)?;
            let frame = &frames[usize::from(candidate.reads_depth())];
            let bound = GraphFrame::new(gpu, frame, &graph)?;
            bound.run(gpu)?;
            graphs.push(bound);
        }
        let copied = TextureDesc::new(moment_shadows::TextureFormat::Rgba16Float, [at.map; 2]);
        let copy = Copies::new(gpu, &[copied], CopyWork::Compute)?;
        let mut subjects = vec![Subject {
            name: "copy".to_owned(),
            record: copy.by_shader(),
        }];
        subjects.extend(
            graphs
                .iter()
                .zip(self.names(at.filter)?)
                .map(|(graph, name)| Subject {
                    name,
                    record: Box::new(move |encoder| {
                        let mut stages = Stage::ALL.into_iter();
                        stages
                            .try_for_each(|stage| compare::Technique::record(graph, stage, encoder))
                    }),
                }),
        );
        let times = Rounds::run(clock, &subjects, self.rounds, step)?;
        let ratios = |to: usize| -> Vec<Distribution> {
            (1..subjects.len())
                .map(|number| times.ratio(&[number], &[to]))
                .collect()
        };
        Ok(Times {
            at,
            copies: ratios(0),
            of_percentage_closer: ratios(1),
        })
    }
}
